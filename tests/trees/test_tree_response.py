"""Frequency responses of branched arms against ``(K + s C + s^2 M)^-1`` and differences of the reference."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.situation import rest_of, resting_arm
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.planar_reference import read
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

POINTS = 2j * np.pi * np.array([0.4, 3.0, 19.0, 140.0])
BASES = ({"kind": "clamp"}, {"kind": "motor", "inertia": 0.02, "damping": 0.01})
SMALL = 1e-5
GEARS: tuple[dict[str, float], ...] = (
    {},
    {"motor.right.stiffness": 40.0, "motor.right.damping_time": 1e-3, "motor.right.motor_damping": 1e-5},
)
"""Of the motor: rigid, and elastic, which puts a shaft without mass between."""


def slopes_of_reading(scene: Scene, angles: Array) -> dict[str, list[Array]]:
    """How outputs answer angles, rates and accelerations, (d,) each, by differences."""
    arm = Arm(scene, {})
    found: dict[str, list[Array]] = {}
    for output in scene.outputs:
        for order in range(3):
            columns: dict[str, list[float]] = {}
            for k in range(len(angles)):
                both = []
                for sign in (1.0, -1.0):
                    motion = [angles[None].copy(), *np.zeros((2, 1, len(angles)))]
                    motion[order][0, k] += sign * SMALL
                    both.append(read(arm, output, np.zeros(1), *motion))
                for name in both[0]:
                    columns.setdefault(name, []).append(float((both[0][name] - both[1][name])[0]) / 2e-5)
            for name, column in columns.items():
                found.setdefault(name, []).append(np.array(column))
    return found


@pytest.mark.parametrize("gear", GEARS)
@pytest.mark.parametrize("gravity", [0.0, 9.81])
@pytest.mark.parametrize("base", BASES)
def test_response(
    base: dict[str, object], gravity: float, gear: dict[str, float], fork: Callable[..., Scene]
) -> None:
    scene = fork(**{"base": base, "model.gravity": gravity}, **gear)
    arm = resting_arm(scene)
    assert arm.rest is not None
    angles = arm.rest.free_angles
    found = frequency_response(arm, POINTS)
    still = np.zeros((1, len(angles)))
    stiffness, damping, mass = (x[0] for x in Arm(scene, {}).slopes(np.zeros(1), angles[None], still, still))
    reading = slopes_of_reading(scene, angles)
    assert set(found) == set(reading)
    for number, item in enumerate(scene.inputs):
        pushed = Arm(scene, {item.name: Constant(1.0)})
        at_rest = (np.zeros(1), angles[None], still, still)
        push = (Arm(scene, {}).residual(*at_rest) - pushed.residual(*at_rest))[0]
        for row, s in enumerate(POINTS):
            q = np.linalg.solve(stiffness + s * damping + s**2 * mass, push)
            for output in scene.outputs:
                direct = read(pushed, output, *at_rest)
                before = read(Arm(scene, {}), output, *at_rest)
                for name in direct:
                    by_q, by_v, by_a = reading[name]
                    right = (by_q + s * by_v + s**2 * by_a) @ q + (direct[name] - before[name])[0]
                    largest = np.abs(np.concatenate([by_q, s * by_v, s**2 * by_a])).max() * np.abs(q).max()
                    assert abs(found[name][row, number] - right) <= 1e-7 * max(abs(right), largest), name


def test_a_prescribed_base_moves_all_that_stands_on_it(fork: Callable[..., Scene]) -> None:
    turns = {"name": "base_angle", "at": "base", "acts": "angle"}
    scene = fork(**{"base": {"kind": "prescribed"}, "input": [turns]})
    rest = rest_of(scene)
    found = frequency_response(linear_arm(scene, rest), POINTS)
    still = np.zeros((1, scene.stations))
    arm = Arm(scene, {})
    stiffness, damping, mass = (x[0] for x in arm.slopes(np.zeros(1), rest.angles[None], still, still))
    on_base = [k for k in range(scene.stations) if scene.host(k + 1) == 0]
    assert len(on_base) == 2
    prop = next(part.last for part in scene.parts if part.name == "prop_arm")
    for row, s in enumerate(POINTS):
        push = np.zeros(scene.stations, complex)
        for k in on_base:
            push[k] = scene.joints[k].stiffness + s * scene.joints[k].damping
        q = np.linalg.solve(stiffness + s * damping + s**2 * mass, push)
        assert found["prop_arm"][row, 0] == pytest.approx(q[prop - 1], rel=1e-10)
