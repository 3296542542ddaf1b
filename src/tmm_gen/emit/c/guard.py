"""What of a step's new state to add up so that nothing infinite and no NaN stays in it unnoticed.

Infinities and NaN pass through every sum and product, so a sum of all numbers of the new state is finite only if all
of them are. Numbers that pass from station to station by sums and products (the unknown of a sweep outward) need not
be added up: they tell of those before, so the last will do.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.program.passes.lifetimes import carried_scalars
from tmm_gen.program.statements import Assign, Loop, Order, Routine
from tmm_gen.program.variables import Ref, Role, Variable


@dataclass(frozen=True)
class Sums:
    """What tells whether a new state is finite.

    Parameters
    ----------
    inside : dict from Loop to tuple of Assign
        What to add up at the end of a loop's body.
    behind : tuple of Assign
        Scalars to add at the end.
    ends : tuple of (Variable, int)
        Elements to add at the end, each of which tells of its whole array.
    """

    inside: dict[Loop, tuple[Assign, ...]]
    behind: tuple[Assign, ...]
    ends: tuple[tuple[Variable, int], ...]


def sums_of(routine: Routine) -> Sums:
    """Return what of the state that a routine writes to add up; of what is written over, the last counts."""
    inside: dict[Loop, tuple[Assign, ...]] = {}
    behind: list[Assign] = []
    ends: list[tuple[Variable, int]] = []
    written: set[tuple[Ref, int, int]] = set()
    for top in reversed(tuple(routine.statements())):
        for inner in reversed(top.body) if isinstance(top, Loop) else (top,):
            if not isinstance(inner, Assign) or inner.target.variable.role is not Role.STATE:
                continue
            place = (inner.target, top.start, top.stop) if isinstance(top, Loop) else (inner.target, 0, 0)
            if place in written:
                continue
            written.add(place)
            if not isinstance(top, Loop):
                behind.insert(0, inner)
            elif _tells_of_those_before(inner, top):
                last = top.start if top.order is Order.INWARD else top.last
                ends.insert(0, (inner.target.variable, last + (inner.target.offset or 0)))
            else:
                inside[top] = (inner, *inside.get(top, ()))
    return Sums(inside, tuple(behind), tuple(ends))


def _tells_of_those_before(assign: Assign, loop: Loop) -> bool:
    """Whether what a loop sets is a scalar that it carries along by sums and products of itself."""
    value = assign.value
    if not isinstance(value, Ref) or value.variable not in carried_scalars(loop):
        return False
    place = loop.body.index(assign)
    updates = [s for s in loop.body if isinstance(s, Assign) and s.target == value]
    if len(updates) != 1 or loop.body.index(updates[0]) > place:
        return False
    return any(_is_factor(term, value) for term in sp.Add.make_args(updates[0].value))


def _is_factor(term: sp.Expr, ref: Ref) -> bool:
    return any(factor == ref for factor in sp.Mul.make_args(term))
