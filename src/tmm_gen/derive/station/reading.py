"""What is read off motion: places of nodes, exact forces, energies and the power turned to heat."""

from __future__ import annotations

from functools import cache

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.integrators.declaration import STEP
from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.frame import INNER, OUTER
from tmm_gen.derive.station.law import KINDS, by_time, law_of
from tmm_gen.derive.station.lets import Coordinate, Line, Update
from tmm_gen.derive.station.motion import Outward

TOTAL = sp.Symbol("total", real=True)
POWER_BEFORE, POWER_AFTER, SLOPE_BEFORE, SLOPE_AFTER = sp.symbols("P_0 P_1 dP_0 dP_1", real=True)


def place(coordinate: Coordinate, kind: str) -> sp.Symbol:
    """Return a node's displacement, velocity or acceleration in a coordinate that is not integrated."""
    return sp.Symbol(f"{kind}_{coordinate.name}", real=True)


@cache
def walk(
    elements: tuple[Element, ...],
    coordinates: tuple[Coordinate, ...],
    kinds: frozenset[str],
    energy: str | None,
    *,
    moved: bool = False,
) -> tuple[Line, ...]:
    """Return what walking out over some elements changes: the motion of the node, and an energy added up.

    Parameters
    ----------
    kinds : frozenset of str
        Which motion of the node is carried.
    energy : str or None
        A key of the elements' energies, or "slope": the derivative by time of the heat.
    moved : bool
        Whether the integrated coordinate is that of the outer side already.
    """
    own = OUTER if moved else INNER
    lines: list[Line] = []
    for element in elements:
        law = law_of(element)
        at: dict[sp.Symbol, sp.Expr] = {}
        for i, c in enumerate(coordinates):
            for kind in KINDS:
                inner, outer = (getattr(p.motions[i], kind) for p in (element.inboard, element.outboard))
                at[inner] = own[kind] if c.integrated else place(c, kind)
                if c.integrated:
                    at[outer] = OUTER[kind] if law.free == i else at[inner]
        added = _energy(element, energy)
        if added != 0:
            lines.append(Update({TOTAL: TOTAL + added.xreplace(at)}))
        moves: dict[sp.Symbol, sp.Expr] = {}
        for i, c in enumerate(coordinates):
            if c.integrated or law.free is not None:
                continue
            for kind in sorted(kinds):
                relative = sp.expand(law.outer[i][kind] - getattr(element.inboard.motions[i], kind))
                if relative != 0:
                    moves[place(c, kind)] = place(c, kind) + relative.xreplace(at)
        if moves:
            lines.append(Update(moves))
        if law.free is not None:
            own = OUTER
    return tuple(lines)


@cache
def _energy(element: Element, energy: str | None) -> sp.Expr:
    if energy is None:
        return sp.Integer(0)
    if energy == "slope":
        heat = element.energies.get("heat", sp.Integer(0))
        return sp.factor(by_time(heat, element.inboard, element.outboard))
    return element.energies.get(energy, sp.Integer(0))


def kinds_of(elements: tuple[Element, ...], energy: str) -> frozenset[str]:
    """Return which motion of nodes an energy depends on."""
    return frozenset(
        kind
        for element in elements
        if (read := _energy(element, energy).free_symbols)
        for kind in KINDS
        for port in (element.inboard, element.outboard)
        for motion in port.motions
        if getattr(motion, kind) in read
    )


def exact_forces(out: Outward, forces: tuple[sp.Symbol, ...]) -> list[Update]:
    """Return what walking in over some elements changes of the forces, at the motion of the way out."""
    lines: list[Update] = []
    for passed in reversed(out.passed):
        law, outside = passed.law, passed.element.outboard.forces
        values = dict(zip(outside, forces, strict=True))
        found: dict[sp.Symbol, sp.Expr] = {}
        for i, symbol in enumerate(forces):
            value = law.inner[i] + (law.ratio * law.own if law.free == i else 0)
            value = out.frame.settled(passed.at_point(value))
            written = out.values.written(value).xreplace(values)
            if written != symbol:
                found[symbol] = written
        if found:
            lines.append(Update(found))
    return lines


@cache
def energy_of_step() -> sp.Expr:
    """Return the integral over a step of the cubic through power and slope at both ends: fourth order."""
    tau = sp.Symbol("tau", real=True)
    powers = sp.Matrix([[tau**k for k in range(4)]])
    slopes = powers.applyfunc(lambda power: partial(power, tau))
    ends = sp.Matrix.vstack(*(row.subs(tau, at) for at in (0, STEP) for row in (powers, slopes)))
    found = ends.LUsolve(sp.Matrix([POWER_BEFORE, SLOPE_BEFORE, POWER_AFTER, SLOPE_AFTER]))
    return sp.expand(sum(c * STEP ** (k + 1) / (k + 1) for k, c in enumerate(found)))


__all__ = ["TOTAL", "energy_of_step", "exact_forces", "kinds_of", "place", "walk"]
