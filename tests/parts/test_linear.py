"""Modes and frequency responses of arms by parts against matrices of Lagrange's equations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.linalg import eigvals
from scipy.optimize import brentq

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.rest import rest_at, straight
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene, parse_scene

EXACT = 1e-9
SEEDS = range(12)


def slopes(scene: Scene) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return mass, damping and stiffness about the scene's start."""
    arm = Arm(scene, {})
    angles = straight(scene)[None, :]
    still = np.zeros_like(angles)
    stiffness, damping, mass = (x[0] for x in arm.slopes(np.zeros(1), angles, still, still))
    return mass, damping, stiffness


def poles_of(mass: np.ndarray, damping: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    size = len(mass)
    system = np.zeros((2 * size, 2 * size))
    system[:size, size:] = np.eye(size)
    system[size:] = -np.linalg.solve(mass, np.hstack([stiffness, damping]))
    return eigvals(system)


@pytest.mark.parametrize("gravity", [0.0, 9.81])
@pytest.mark.parametrize("seed", SEEDS)
def test_matrices_and_poles(seed: int, gravity: float, drawn: Callable[..., Scene]) -> None:
    scene = drawn(seed, 2 + seed % 5).replace(**{"model.gravity": gravity})
    linear = matrices(linear_arm(scene, rest_at(scene, straight(scene))))
    mass, damping, stiffness = slopes(scene)
    for found, right in ((linear.mass, mass), (linear.damping, damping), (linear.stiffness, stiffness)):
        assert np.abs(found - right).max() <= 1e-11 * np.abs(right).max()
    right = poles_of(mass, damping, stiffness)
    found = np.array([pole for mode in find_modes(linear) for pole in mode.poles])
    assert len(found) == len(right)
    fast = np.abs(right).max()
    for pole in found:
        # what turns without resistance is exact here, and a double root there
        assert np.abs(right - pole).min() <= 1e-6 * max(abs(pole), 1e-2 * fast)
    loose = sum(joint.stiffness == 0.0 for joint in scene.joints) + (scene.base.kind == "motor")
    if gravity == 0.0:
        assert sum(mode.frequency == 0.0 for mode in find_modes(linear)) == loose


@pytest.mark.parametrize("seed", SEEDS)
def test_frequency_response(seed: int, drawn: Callable[..., Scene]) -> None:
    scene = drawn(seed, 2 + seed % 5)
    arm = linear_arm(scene, rest_at(scene, straight(scene)))
    s = 2j * np.pi * np.array([0.3, 2.0, 17.0])
    found = frequency_response(arm, s)
    mass, damping, stiffness = slopes(scene)
    exact = Arm(scene, {})
    for k, item in enumerate(scene.inputs):
        if item.acts != "drive":
            continue
        place = int(item.at) - 1 + exact.first
        push = np.zeros(len(mass))
        push[place] += scene.joints[int(item.at) - 1].gear
        if place:
            push[place - 1] -= scene.joints[int(item.at) - 1].gear
        for index, point in enumerate(s):
            answer = np.linalg.solve(mass * point**2 + damping * point + stiffness, push)
            inner = answer[place - 1] if place else 0.0
            name = item.name.removeprefix("torque_")
            assert found[f"angle_in_{name}"][index, k] == pytest.approx(answer[place] - inner, rel=EXACT)
            assert found[f"rate_in_{name}"][index, k] == pytest.approx(
                point * (answer[place] - inner), rel=EXACT
            )
            joint = scene.joints[int(item.at) - 1]
            law = joint.stiffness + joint.damping * point + joint.armature * point**2
            right = joint.gear - law * (answer[place] - inner)
            scale = joint.gear + abs(law * (answer[place] - inner))
            assert abs(found[f"torque_in_{name}"][index, k] - right) < EXACT * scale


def test_a_hanging_chain_swings_as_bessel_says(hanging: Callable[[int], Scene]) -> None:
    """Modes of n free links are those of a chain, j0/2 sqrt(g/L), to second order in 1/n."""
    from scipy.special import jn_zeros

    right = 0.5 * jn_zeros(0, 3) * np.sqrt(9.81 / 1.0)
    errors = []
    for n in (10, 20, 40):
        scene = hanging(n)
        linear = matrices(linear_arm(scene, rest_at(scene, straight(scene))))
        found = np.array([mode.frequency for mode in find_modes(linear)[:3]])
        errors.append(np.abs(found / right - 1.0))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(np.full(3, 2.0), abs=0.25)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(np.full(3, 2.0), abs=0.1)
    assert errors[2].max() < 5e-3


PINNED = """
name = "pinned"
model.kind = "planar"
integrator = {{ name = "newmark", step = 1e-3 }}
base.kind = "clamp"
{turning} = [{{ name = "pin" }}]
beam = [{{ name = "rod", on = "pin", length = 1.3, bending_stiffness = 2.0, mass_per_length = 0.4, links = {links} }}]
output = [{{ name = "tip", at = "rod", of = "position" }}]
"""


@pytest.mark.parametrize("turning", ["joint", "motor"])
def test_a_pinned_beam_without_a_hub_has_its_textbook_frequencies(turning: str) -> None:
    """Roots of tan b = tanh b beside turning as a whole: nothing at the pin needs an inertia of its own.

    Segments are of second order; where no end is held, what is left of it cancels.
    """
    roots = [brentq(lambda b: np.sin(b) - np.cos(b) * np.tanh(b), k, k + 1.0) for k in (3.5, 6.5, 9.7)]
    np.testing.assert_allclose(roots, [3.926602, 7.068583, 10.210176], atol=5e-7)
    exact = np.array(roots) ** 2 * np.sqrt(2.0 / 0.4 / 1.3**4)
    counts = [10, 20, 40]
    errors = []
    for links in counts:
        modes = find_modes(matrices(linear_arm(parse_scene(PINNED.format(turning=turning, links=links)))))
        assert modes[0].frequency == 0.0
        errors.append(
            [abs(mode.frequency / right - 1.0) for mode, right in zip(modes[1:], exact, strict=False)]
        )
    for each in np.array(errors).T:
        assert -np.polyfit(np.log(counts), np.log(each), 1)[0] == pytest.approx(4.0, abs=0.2)
    assert np.max(errors[-1]) < 1e-4
