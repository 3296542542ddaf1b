"""Modes and responses of floating arms against closed forms and matrices that have coordinates for the base."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.optimize import brentq

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.rest import rest_at
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.reference.planar_linear import vibration
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.model import FloatingBase

Array = NDArray[np.float64]

ROD = """\
name = "rod"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "free"
[[body]]
name = "end"
on = "base"
inertia = 1e-12
[[beam]]
name = "rod"
length = 2.0
bending_stiffness = 3.0
mass_per_length = 0.7
links = {links}
[[output]]
name = "tip"
at = "rod"
of = "position"
"""


def test_a_free_beam_has_its_textbook_frequencies() -> None:
    """Roots of ``cos(b) cosh(b) = 1``: 4.730041, 7.853205, 10.995608, to second order in the links or better."""
    roots = [brentq(lambda b: np.cos(b) - 1 / np.cosh(b), k, k + 1.5) for k in (4.0, 7.0, 10.3)]
    np.testing.assert_allclose(roots, [4.730041, 7.853205, 10.995608], atol=5e-7)
    exact = np.array(roots) ** 2 * np.sqrt(3.0 / 0.7 / 2.0**4)
    counts = [10, 20, 40]
    errors = []
    for links in counts:
        found = undamped_modes(matrices(linear_arm(parse_scene(ROD.format(links=links))))).squares
        assert found[0] == 0.0
        errors.append(np.abs(np.sqrt(found[1:4]) / exact - 1))
    for each in np.array(errors).T:
        assert -np.polyfit(np.log(counts), np.log(each), 1)[0] > 1.9
    assert np.max(errors[-1]) < 1e-5


def with_base(scene: Scene, angles: Array) -> tuple[Array, Array, Array]:
    """Mass, damping and stiffness with the base's x and y first, then all angles, the hub's first."""
    base = scene.base
    assert isinstance(base, FloatingBase)
    size = scene.stations + 3
    mass, damping, stiffness = np.zeros((3, size, size))
    mass[0, 0] = mass[1, 1] = base.mass
    mass[2, 2] = base.inertia
    ends = {0: np.concatenate([np.eye(2), np.zeros((2, size - 2))], axis=1)}
    for number, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True), start=1):
        turning = np.zeros((2, size))
        turning[:, number + 2] = [-np.sin(angles[number]), np.cos(angles[number])]
        inner = ends[scene.host(number)]
        center = inner + link.center * link.length * turning
        ends[number] = inner + link.length * turning
        mass += link.mass * center.T @ center
        mass[number + 2, number + 2] += link.inertia
        bend = np.zeros(size)
        bend[[number + 2, scene.host(number) + 2]] = [1.0, -1.0]
        stiffness += joint.stiffness * np.outer(bend, bend)
        damping += joint.damping * np.outer(bend, bend)
    return mass, damping, stiffness


ANGLES = np.array([0.2, 2.5, 0.4, -0.7])


def test_squares_are_those_of_matrices_with_the_base(drifter: Callable[..., Scene]) -> None:
    """Three of them are zero there, of which moves without turning have no coordinate here."""
    scene = drifter(gravity=9.81)  # it falls, and no joint feels that
    found = undamped_modes(matrices(linear_arm(scene, rest_at(scene, ANGLES)))).squares
    mass, _, stiffness = with_base(scene, ANGLES)
    exact = eigh(stiffness, mass, eigvals_only=True)
    np.testing.assert_allclose(exact[:3], 0.0, atol=1e-9)
    assert found[0] == 0.0
    np.testing.assert_allclose(found[1:], exact[3:], rtol=1e-11)


def test_the_references_frequencies_are_these(cube: Scene) -> None:
    """Straight arms: the one list is made of compliances, the other is not."""
    straight = np.zeros(cube.stations + 1)
    found = np.sqrt(undamped_modes(matrices(linear_arm(cube, rest_at(cube, straight)))).squares)
    np.testing.assert_allclose(vibration(cube).frequencies[1:], found[1:], rtol=1e-9)


@pytest.mark.parametrize("frequency", [0.3, 2.0, 11.0])
def test_responses(frequency: float, drifter: Callable[..., Scene]) -> None:
    scene = drifter()
    mass, damping, stiffness = with_base(scene, ANGLES)
    s = 2j * np.pi * frequency
    found = frequency_response(linear_arm(scene, rest_at(scene, ANGLES)), np.array([s]))
    pushes = {"wheel": np.eye(6)[2], "thruster": np.eye(6)[0]}
    end = np.zeros((2, 6))
    end[:, :2] = np.eye(2)
    for length, k in ((0.5, 2), (0.4, 3)):
        end[:, 2 + k] = length * np.array([-np.sin(ANGLES[k]), np.cos(ANGLES[k])])
    pushes["push"] = end[1]
    for number, item in enumerate(scene.inputs):
        q = np.linalg.solve(stiffness + s * damping + s**2 * mass, pushes[item.name])
        right = {"hub_x": q[0], "hub_y": q[1], "attitude": q[2], "end_x": end[0] @ q, "end_y": end[1] @ q}
        right |= {"drift_x": s * q[0], "jerk_y": s**2 * q[1]}
        for name, value in right.items():
            assert found[name][0, number] == pytest.approx(value, rel=1e-9, abs=1e-9 * np.abs(q).max()), name
