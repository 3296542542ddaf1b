"""What the sweep of an arm in space hands from joint to joint, whose bounds square from one to the next."""

from __future__ import annotations

from functools import lru_cache

from tmm_gen.derive.space.inward import BIAS
from tmm_gen.program.statements import Assign, Loop, Order, Require, Routine
from tmm_gen.program.variables import Role, Variable, refs_in

_FORCES = tuple(symbol.name for symbol in BIAS)
"""Ends of their names: a fork's have its number in front."""


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
    return frozenset(v for v in read & left if v.role is Role.LOCAL and not v.name.endswith(_FORCES))


def handed_at(loop: Loop, scalars: frozenset[Variable]) -> dict[int, tuple[Variable, ...]]:
    """Return what of some scalars a loop's joints leave, by the place in its body at which all of it is there.

    Parameters
    ----------
    loop : Loop
        Any.
    scalars : frozenset of Variable
        As :func:`handed_on` returns them.
    """
    if not _eliminates(loop):
        return {}
    found: dict[int, tuple[Variable, ...]] = {}
    since: dict[Variable, int] = {}
    pivots = 0
    for place, inner in enumerate(loop.body):
        if isinstance(inner, Require):
            found |= _all_there(since)
            since, pivots = {}, pivots + 1
        elif pivots and inner.target.variable in scalars:
            since[inner.target.variable] = place
    return found | _all_there(since)


def _all_there(since: dict[Variable, int]) -> dict[int, tuple[Variable, ...]]:
    return {max(since.values()): tuple(since)} if since else {}


def _eliminates(statement: object) -> bool:
    return (
        isinstance(statement, Loop)
        and statement.order is Order.INWARD
        and any(isinstance(inner, Require) for inner in statement.body)
    )
