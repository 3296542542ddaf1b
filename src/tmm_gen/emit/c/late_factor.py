"""Products of recursions whose last known factor is multiplied last.

``a = 1/p``, ``b = a u`` and then ``x - b y``: the chain from ``p`` to ``x`` is a quotient, two products and a sum.
With ``x - a (u y)`` it is one product shorter, and ``b``, which others need, is still there: one multiplication more.
So loops are written that way which then wait less for themselves, and no others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import sympy as sp

from tmm_gen.emit.c.clock import Clock, period, settled
from tmm_gen.program.passes.lifetimes import carried_scalars
from tmm_gen.program.statements import Assign, Loop, Require
from tmm_gen.program.variables import Ref, Variable, refs_in


def late_factors_last(loop: Loop, part_of: Callable[[Variable], Variable]) -> Loop:
    """Return a recursion whose products wait as little as they can.

    Parameters
    ----------
    loop : Loop
        Whose scalars are carried.
    part_of : callable
        Gives a new scalar for a product that goes into a variable.
    """
    found = _candidates(loop)
    body: list[Assign | Require] = []
    for place, line in enumerate(loop.body):
        if place in found and isinstance(line, Assign):
            term, late, early = found[place]
            part = part_of(line.target.variable).ref
            body.append(Assign(part, early))
            line = Assign(line.target, line.value - term + late * part)
        body.append(line)
    changed = replace(loop, body=tuple(body))
    return changed if period(changed) < period(loop) else loop


def _candidates(loop: Loop) -> dict[int, tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """Return places of sums, with a term, its last known factor and the product of the others."""
    clock = settled(loop)
    carried = {v.ref for v in carried_scalars(loop)}
    products: dict[Ref, tuple[sp.Expr, sp.Expr]] = {}
    """By what they are assigned to: last known factor, and the other, as long as neither is assigned anew."""
    found: dict[int, tuple[sp.Expr, sp.Expr, sp.Expr]] = {}
    for place, line in enumerate(loop.body):
        if not isinstance(line, Assign):
            continue
        if line.target in carried and line.value.is_Add and (split := _split(line.value, products, clock)):
            found[place] = split
        clock.set(line.target, line.value)
        products = {ref: both for ref, both in products.items() if line.target not in (ref, *both)}
        if (
            line.value.is_Mul
            and len(line.value.args) == 2
            and all(isinstance(f, Ref) for f in line.value.args)
        ):
            early, late = sorted(line.value.args, key=clock.of)
            if line.target not in (early, late):
                products[line.target] = late, early
    return found


def _split(
    value: sp.Expr, products: dict[Ref, tuple[sp.Expr, sp.Expr]], clock: Clock
) -> tuple[sp.Expr, sp.Expr, sp.Expr] | None:
    """Return the last known term of a sum, if it is a product of such a product, as late factor and the others."""
    term = max(value.args, key=clock.of)
    known = [f for f in sp.Mul.make_args(term) if f in products]
    if len(known) != 1 or not refs_in(term) - {known[0]}:
        return None
    late, early = products[known[0]]
    return term, late, early * (term / known[0])
