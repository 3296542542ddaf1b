"""Solved elements against Newton and Euler written by hand, and their energies against their forces."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive.elements import nodes, torsion
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.planar import LENGTH, LINK
from tmm_gen.derive.station.law import by_time, law_of
from tmm_gen.errors import UserError

RNG = np.random.default_rng(7)
L, M, INERTIA, KAPPA = 0.3, 0.7, 0.02, 0.35
ROWS = {
    "rod and point masses": (
        nodes.MASS_AT_NODE.with_values({nodes.POINT_MASS: sp.Float(M * (1 - KAPPA))}),
        nodes.ROD.with_values({LENGTH: L, nodes.BODY_INERTIA: INERTIA - M * KAPPA * (1 - KAPPA) * L**2}),
        nodes.MASS_AT_NODE.with_values({nodes.POINT_MASS: sp.Float(M * KAPPA)}),
    ),
    "rigid link": (
        nodes.RIGID_LINK.with_values(
            {
                LENGTH: L,
                nodes.MASS: M,
                nodes.CARRIED_MASS: KAPPA * M,
                nodes.PIN_INERTIA: INERTIA + KAPPA**2 * L**2 * M,
            }
        ),
    ),
    "link of the frequency domain": (
        LINK.with_values(dict(zip(LINK.parameters, (L, M, INERTIA, KAPPA), strict=True))),
    ),
}


def carried(elements: tuple[Element, ...], motion: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Carry forces inward over elements; motion is (angle, rate, acceleration, a_x, a_y) at the inner end."""
    angle, rate, acceleration, ax, ay = motion
    places = [(ax, ay)]
    for element in elements:
        at = _at(element, angle, rate, acceleration, places[-1])
        law = law_of(element)
        places.append(tuple(float(law.outer[i]["a"].subs(at)) for i in range(2)))  # type: ignore[arg-type]
    for element, place in reversed(list(zip(elements, places, strict=False))):
        at = _at(element, angle, rate, acceleration, place) | dict(
            zip(element.outboard.forces, forces, strict=True)
        )
        forces = np.array([float(sp.sympify(f).subs(at)) for f in law_of(element).inner])
    return forces


def _at(
    element: Element, angle: float, rate: float, acceleration: float, place: tuple[float, float]
) -> dict[sp.Symbol, float]:
    x, y, theta = element.inboard.motions
    return {theta.q: angle, theta.v: rate, theta.a: acceleration, x.a: place[0], y.a: place[1]}


def turned_by(arm: np.ndarray, force: np.ndarray) -> float:
    """Return the moment of a force in the plane."""
    return float(arm[0] * force[1] - arm[1] * force[0])


@pytest.mark.parametrize("name", ROWS)
def test_it_is_newton_and_euler(name: str) -> None:
    for _ in range(4):
        motion, forces = RNG.normal(size=5), RNG.normal(size=3)
        angle, rate, acceleration, *a = motion
        along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        inner = forces[:2] + M * (a + KAPPA * L * (acceleration * across - rate**2 * along))
        to_inner, to_outer = -KAPPA * L * along, (1 - KAPPA) * L * along
        # I alpha = M_in - M_out + r_in x F_in - r_out x F_out
        moment = INERTIA * acceleration + forces[2] - turned_by(to_inner, inner)
        moment += turned_by(to_outer, forces[:2])
        np.testing.assert_allclose(carried(ROWS[name], motion, forces), [*inner, moment], rtol=1e-11)


ELEMENTS = {
    e.name + e.source: e
    for e in (
        *(nodes.PIN, nodes.ROD, nodes.MASS_AT_NODE, nodes.BODY, nodes.BEARING),
        *(torsion.JOINT, torsion.LINK, torsion.GROUND_DAMPER),
    )
}


@pytest.mark.parametrize("name", ELEMENTS)
def test_power_through_an_element_is_what_it_holds_and_heats(name: str) -> None:
    """What enters at one side and does not leave at the other is stored or turned to heat: any sign would show."""
    element = ELEMENTS[name]
    law = law_of(element)
    inboard, outboard = element.inboard, element.outboard
    outer = {getattr(outboard.motions[i], k): v for i, m in law.outer.items() for k, v in m.items()}
    given = {outboard.forces[law.free]: law.own} if law.free is not None else {}
    inner = [f + (law.ratio * law.own if i == law.free else 0) for i, f in enumerate(law.inner)]
    enters = sum(f * m.v for f, m in zip(inner, inboard.motions, strict=True))
    leaves = sum(f * m.v for f, m in zip(outboard.forces, outboard.motions, strict=True))
    sign = 1 if len(inboard.motions) == 3 else -1
    power = sign * (enters - leaves)
    held = sum(element.energies.get(k, sp.Integer(0)) for k in ("kinetic", "elastic"))
    found = power - by_time(held, inboard, outboard) - element.energies.get("heat", sp.Integer(0))
    assert sp.simplify(sp.expand(found.subs(given).subs(outer).doit())) == 0


def test_an_element_that_leaves_two_motions_open_is_refused() -> None:
    open_pin = Element("open", "", nodes.PIN.inboard, nodes.PIN.outboard, nodes.PIN.equations[1:])
    with pytest.raises(UserError, match="State the others by the inner motion"):
        law_of(open_pin)
    law_of(nodes.PIN)


def test_an_element_without_a_balance_of_forces_is_refused() -> None:
    *balanced, _ = nodes.PIN.equations
    with pytest.raises(UserError, match="State one balance of forces"):
        law_of(Element("slack", "", nodes.PIN.inboard, nodes.PIN.outboard, tuple(balanced)))
