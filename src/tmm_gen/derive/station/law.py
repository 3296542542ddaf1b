"""An element's equations, solved: what moves its outer side, and what force its inner side needs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import sympy as sp

from tmm_gen.derive.elements.declaration import Element, Motion, Port
from tmm_gen.derive.partial import partial
from tmm_gen.errors import UserError

KINDS = ("q", "v", "a")


@dataclass(frozen=True)
class Law:
    """A solved element.

    Parameters
    ----------
    outer : dict from int to dict from "q", "v", "a" to sympy.Expr
        Motion of the outer side by that of the inner one, of each coordinate that has no motion of its own there.
    free : int or None
        The coordinate in which the element gives way: its outer motion is a new unknown.
    inner : tuple of sympy.Expr
        Forces at the inner side, by those at the outer side and by motions.
    own : sympy.Expr
        Force at the outer side in the free coordinate by the motion of both sides; zero where there is none.
    ratio : sympy.Expr
        How much of that force acts at the inner side; ``inner`` of the free coordinate is what acts there besides.
    """

    outer: dict[int, dict[str, sp.Expr]]
    free: int | None
    inner: tuple[sp.Expr, ...]
    own: sp.Expr
    ratio: sp.Expr


@cache
def law_of(element: Element) -> Law:
    """Solve an element's equations.

    Raises
    ------
    UserError
        If they do not determine outer motion and inner force, but for one coordinate.
    """
    inboard, outboard = element.inboard, element.outboard
    forces = {*inboard.forces, *outboard.forces}
    geometric = [e for e in element.equations if not e.free_symbols & forces]
    outer: dict[int, dict[str, sp.Expr]] = {}
    for i, motion in enumerate(outboard.motions):
        found = _outer_motion(motion, geometric, inboard)
        if found is not None:
            outer[i] = found
    free = [i for i in range(len(outboard.motions)) if i not in outer]
    if len(free) > 1 or len(geometric) != len(outer):
        raise UserError(
            f"element '{element.name}': its outer motion should be determined but for one coordinate. State the others "
            "by the inner motion, one equation each."
        )
    by_inner = {
        getattr(outboard.motions[i], kind): value for i, m in outer.items() for kind, value in m.items()
    }
    balance = [e.xreplace(by_inner) for e in element.equations if e.free_symbols & forces]
    unknown = [*inboard.forces, *(outboard.forces[i] for i in free)]
    solutions = list(sp.linsolve(balance, unknown))
    if len(solutions) != 1 or any(value.free_symbols & set(unknown) for value in solutions[0]):
        raise UserError(
            f"element '{element.name}': its equations do not determine its inner forces. State one balance of forces "
            "for each coordinate, and the own force of the one that gives way."
        )
    values = {force: sp.expand(value) for force, value in zip(unknown, solutions[0], strict=True)}
    inner = [values[force] for force in inboard.forces]
    own, ratio = sp.Integer(0), sp.Integer(1)
    if free:
        own = values[outboard.forces[free[0]]]
        quotient = sp.cancel(inner[free[0]] / own) if own != 0 else sp.Integer(1)
        moving = {s for port in (inboard, outboard) for m in port.motions for s in (m.q, m.v, m.a)}
        if not quotient.free_symbols & moving:
            ratio = quotient
        inner[free[0]] = sp.expand(inner[free[0]] - ratio * own)
    return Law(outer, free[0] if free else None, tuple(inner), own, ratio)


def _outer_motion(motion: Motion, geometric: list[sp.Expr], inboard: Port) -> dict[str, sp.Expr] | None:
    """Solve the equation that holds a coordinate of the outer side, and differentiate it by time."""
    for kind in KINDS:
        symbol = getattr(motion, kind)
        for equation in geometric:
            if equation.has(symbol):
                found = {kind: sp.expand(symbol - equation / partial(equation, symbol))}
                for lower, higher in pairwise(KINDS):
                    if lower in found:
                        found[higher] = sp.expand(by_time(found[lower], inboard))
                return found
    return None


def by_time(expression: sp.Expr, *ports: Port) -> sp.Expr:
    """Differentiate by time: displacements move by velocities, velocities by accelerations."""
    rates = {m.q: m.v for port in ports for m in port.motions} | {
        m.v: m.a for port in ports for m in port.motions
    }
    return sp.Add(*(partial(expression, s) * rate for s, rate in rates.items()))


@cache
def passes_on(element: Element) -> bool:
    """Return whether an element gives way by differences of motion alone, with one force at both sides."""
    law = law_of(element)
    if law.free is None or law.ratio != 1 or law.inner[law.free] != 0:
        return False
    inner, outer = (port.motions[law.free] for port in (element.inboard, element.outboard))
    pairs = [(getattr(inner, kind), getattr(outer, kind)) for kind in KINDS]
    return all(sp.expand(partial(law.own, a) + partial(law.own, b)) == 0 for a, b in pairs)


def impedance_law(element: Element) -> sp.Expr:
    """Return the force of an element that gives way per unknown of its outer side, by the symbols for gains."""
    law = law_of(element)
    assert law.free is not None
    motion = element.outboard.motions[law.free]
    gains = (sp.Symbol(f"P_{kind}", real=True) for kind in KINDS)
    return sp.expand(
        sp.Add(
            *(gain * partial(law.own, getattr(motion, kind)) for gain, kind in zip(gains, KINDS, strict=True))
        )
    )
