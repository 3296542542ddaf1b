"""Modes and equilibria of branched arms against matrices written apart, and against Lagrange's equations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh, eigvals

from tmm_gen.inputs.signals import Constant
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.equilibrium import equilibrium
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.situation import rest_of, resting_arm
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

BASES = ("clamp", "motor")


def on(base: str) -> dict[str, object]:
    return {"base": {"kind": base} | ({"inertia": 0.02, "damping": 0.01} if base == "motor" else {})}


def inner(scene: Scene) -> list[int]:
    """Coordinate that each joint stands on, -1 for a base that is none."""
    return [scene.host(j + 1) - 1 + scene.hub for j in range(scene.stations)]


def mass_and_stiffness(scene: Scene, angles: Array) -> tuple[Array, Array]:
    """Bodies by the ways to their centres, springs by the angles between both their sides."""
    size, hub = scene.stations + scene.hub, scene.hub
    mass, stiffness = np.zeros((2, size, size))
    if hub:
        mass[0, 0] = scene.base.inertia
    for k, link in enumerate(scene.links):
        across = np.zeros((2, size))  # what a unit of each angle moves the centre by
        host, length = k, link.center * link.length
        while True:
            turned = angles[host + hub]
            across[:, host + hub] = length * np.array([-np.sin(turned), np.cos(turned)])
            host = scene.host(host + 1) - 1
            if host < 0:
                break
            length = scene.links[host].length
        mass += link.mass * across.T @ across
        mass[k + hub, k + hub] += link.inertia
    for k, joint in enumerate(scene.joints):
        bend = np.zeros(size)
        bend[k + hub] = 1.0
        if inner(scene)[k] >= 0:
            bend[inner(scene)[k]] = -1.0
        stiffness += joint.stiffness * np.outer(bend, bend)
        mass += joint.armature * np.outer(bend, bend)
    return mass, stiffness


def linearised(scene: Scene, angles: Array, inputs: dict[str, float]) -> tuple[Array, Array, Array]:
    """Mass, damping and stiffness by differences of Lagrange's equations."""
    arm = Arm(scene, {name: Constant(value) for name, value in inputs.items()})
    found = []
    for order in (2, 1, 0):
        columns = []
        for k in range(len(angles)):
            both = []
            for sign in (1.0, -1.0):
                motion = [angles[None].copy(), *np.zeros((2, 1, len(angles)))]
                motion[order][0, k] += sign * 1e-5
                both.append(arm.residual(np.zeros(1), *motion)[0])
            columns.append((both[0] - both[1]) / 2e-5)
        found.append(np.array(columns).T)
    return found[0], found[1], found[2]


@pytest.mark.parametrize("gear", [{}, {"motor.right.stiffness": 40.0}])
@pytest.mark.parametrize("base", BASES)
def test_modes_without_gravity(base: str, gear: dict[str, float], fork: Callable[..., Scene]) -> None:
    scene = fork(**on(base), **gear)
    rest = rest_of(scene)
    assert np.abs(rest.unbalanced).max() <= 1e-12
    assert rest.angles == pytest.approx(np.array(scene.initial.angles), abs=1e-12)
    linear = matrices(resting_arm(scene))
    mass, stiffness = mass_and_stiffness(scene, rest.free_angles)
    assert linear.mass == pytest.approx(mass, abs=1e-12 * np.abs(mass).max())
    assert linear.stiffness == pytest.approx(stiffness, abs=1e-12 * np.abs(stiffness).max())
    assert linear.parts.diagonal == pytest.approx(np.diag(mass), rel=1e-12)
    right = eigh(stiffness, mass, eigvals_only=True)
    found = undamped_modes(linear)
    loose = 2 if base == "motor" else 1
    assert np.all(found.squares[:loose] == 0.0)
    assert found.squares[loose:] == pytest.approx(right[loose:], rel=1e-10)
    assert found.shapes.T @ mass @ found.shapes == pytest.approx(np.eye(len(mass)), abs=1e-9)


@pytest.mark.parametrize("inputs", [{}, {"push": 0.4, "turn": 0.005, "twist": -0.1}])
def test_modes_about_a_hanging_equilibrium(inputs: dict[str, float], fork: Callable[..., Scene]) -> None:
    scene = fork(**{"model.gravity": 9.81})
    angles = equilibrium(scene, inputs).free_angles
    still = np.zeros((1, len(angles)))
    arm = Arm(scene, {name: Constant(value) for name, value in inputs.items()})
    weights = 9.81 * sum(link.mass for link in scene.links) * scene.reach
    assert np.abs(arm.residual(np.zeros(1), angles[None], still, still)).max() <= 1e-11 * weights
    linear = matrices(resting_arm(scene, inputs))
    by_formula = [x[0] for x in arm.slopes(np.zeros(1), angles[None], still, still)][::-1]
    mass, damping, stiffness = linearised(scene, angles, inputs)
    found = (linear.mass, linear.damping, linear.stiffness)
    for made, formula, difference in zip(found, by_formula, (mass, damping, stiffness), strict=True):
        assert np.abs(made - formula).max() <= 1e-11 * np.abs(formula).max()
        assert np.abs(made - difference).max() <= 1e-7 * np.abs(difference).max()
    size = len(angles)
    system = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-np.linalg.solve(by_formula[0], np.hstack([by_formula[2], by_formula[1]]))],
        ]
    )
    right = eigvals(system)
    poles = np.array([pole for mode in find_modes(linear) for pole in mode.poles])
    assert np.sort_complex(poles) == pytest.approx(np.sort_complex(right), rel=1e-8)


@pytest.mark.parametrize("base", BASES)
def test_a_branched_arm_falls_to_its_equilibrium_from_far(base: str, fork: Callable[..., Scene]) -> None:
    """From upright the stiffness is convex nowhere near: the descent shifts it, walks down and ends where all hangs."""
    scene = fork(**on(base), **{"model.gravity": 9.81, "initial.angles": 1.5})
    rest = equilibrium(scene)
    linear = matrices(linear_arm(scene, rest))
    assert np.linalg.eigvalsh(linear.stiffness)[0] > 0.0
    arm, still = Arm(scene, {}), np.zeros((1, len(rest.free_angles)))
    assert np.abs(arm.residual(np.zeros(1), rest.free_angles[None], still, still)).max() <= 1e-10


def test_two_fingers_move_alike_or_against_each_other(hand: Callable[..., Scene]) -> None:
    """Against each other the palm stands still, exactly; alike it moves with them, the less the heavier it is."""
    one = [mode.frequency for mode in find_modes(matrices(resting_arm(hand(0.1, 1e-4, sides=("left",)))))]
    for mass, near in ((0.1, None), (1e7, 1e-6)):
        against, alike = [], []
        for mode in find_modes(matrices(resting_arm(hand(mass, mass * 1e-3)))):
            palm, *fingers = mode.shape
            left, right = np.array(fingers[:2]), np.array(fingers[2:])
            if np.abs(left + right).max() <= 1e-7:
                assert abs(palm) <= 1e-7
                against.append(mode.frequency)
            else:
                assert left == pytest.approx(right, abs=1e-7 + 1e-4 * (near is not None))
                alike.append(mode.frequency)
        assert against == pytest.approx(one, rel=1e-9)
        assert len(alike) == 3
        if near:
            assert alike[1:] == pytest.approx(one, rel=near)
        else:
            assert all(abs(here / alone - 1.0) > 1e-2 for here in alike for alone in one)
