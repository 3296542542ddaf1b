"""What the sweep of an arm in space hands from joint to joint, whose bounds square from one to the next."""

from __future__ import annotations

import re
from functools import lru_cache

from tmm_gen.derive.space.inward import BIAS
from tmm_gen.program.statements import Assign, Loop, Order, Require, Routine
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

_FORCES = re.compile(
    rf"({'|'.join(symbol.name.partition('_')[2] for symbol in BIAS)})(_\d+)*(_system\d+(_re|_im)?)?$"
)
"""Ends of their names: a fork's have its number in front, those of several joints in one body theirs behind, and those
of a system of stages that are solved at once its own behind that."""


@lru_cache(maxsize=16)
def handed_on(routine: Routine) -> frozenset[Variable]:
    """Return the scalars that one joint's elimination leaves and another's begins with, but for forces.

    Forces are handed on too, but only add up from joint to joint.

    Parameters
    ----------
    routine : Routine
        A step, or a start; joints are eliminated where it requires pivots.
    """
    read: set[Variable] = set()
    left: set[Variable] = set()
    for loop in routine.statements():
        if not _eliminates(loop):
            continue
        assert isinstance(loop, Loop)
        written: set[Variable] = set()
        behind = False
        for inner in loop.body:
            read |= {ref.variable for ref in refs_in(inner.value)} - written
            behind = behind or isinstance(inner, Require)
            if isinstance(inner, Assign):
                written.add(inner.target.variable)
                left |= {inner.target.variable} if behind else set()
    return frozenset(v for v in read & left if v.role is Role.LOCAL and not _FORCES.search(v.name))


def handed_at(loop: Loop, scalars: frozenset[Variable]) -> dict[int, tuple[Ref, ...]]:
    """Return what a loop's joints leave to the next ones, by the place in its body at which all of it is there.

    A body that eliminates several joints hands on under names of its own, which the rest of it reads.

    Parameters
    ----------
    loop : Loop
        Any.
    scalars : frozenset of Variable
        As :func:`handed_on` returns them: what one round of a loop leaves to another; none where nothing is checked.
    """
    if not (scalars and _eliminates(loop)):
        return {}
    found: dict[int, tuple[Ref, ...]] = {}
    pivots = [place for place, inner in enumerate(loop.body) if isinstance(inner, Require)]
    for begin, end in zip(pivots, [*pivots[1:], len(loop.body)], strict=True):
        written = {
            inner.target: place
            for place, inner in enumerate(loop.body[:end])
            if place > begin and isinstance(inner, Assign)
        }
        later = {ref for inner in loop.body[end:] for ref in refs_in(inner.value)}
        left = {
            ref: place
            for ref, place in written.items()
            if ref.variable in scalars or (ref in later and not _FORCES.search(ref.variable.name))
        }
        if left:
            found[max(left.values())] = tuple(left)
    return found


def _eliminates(statement: object) -> bool:
    return (
        isinstance(statement, Loop)
        and statement.order is Order.INWARD
        and any(isinstance(inner, Require) for inner in statement.body)
    )
