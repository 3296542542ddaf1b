"""Encoders behind gears that give way, in space: what they show, and emitted controllers that look at them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import Scene

STIFFNESS = 500.0
"""Of the gear that lifts, N m/rad."""
ELASTIC = {"motor.lift.stiffness": STIFFNESS, "motor.lift.damping_time": 1e-3}
OUTPUT = {"motor.lift.encoder": "output"}


@pytest.fixture(scope="module")
def behind(reach: Scene) -> Bench:
    """With the encoder of the motor that lifts at the output of a soft gear."""
    return Bench.of(reach.replace(**ELASTIC, **OUTPUT))


def test_the_rotor_is_ahead_by_what_winds_the_gear_up(behind: Bench, reach: Scene) -> None:
    """By statics, torque over stiffness; a hub turned with all behind it turns its encoder alike."""
    reference = np.array([0.3, 0.1])
    target = rest_with(behind.scene, reference, "here")
    motors, rotors = behind.problem.motors, motors_of(reach.replace(**ELASTIC))
    twist = 50.0 * target.goal.torque[1] / STIFFNESS
    assert abs(twist) > 4e-3
    assert_allclose(motors.hub @ target.angles, reference, atol=1e-9)
    assert_allclose(rotors.hub @ target.angles, reference + np.array([0.0, twist]), atol=1e-9)
    assert_allclose(motors.hub @ motors.turned, np.eye(2), rtol=0.0)
    assert_allclose(motors.tip, rotors.tip, rtol=0.0)


@pytest.mark.compiler
@pytest.mark.parametrize("kind", ["rti-zero", "rti", "mpc-links"])
def test_torques_are_those_of_python(kind: str, behind: Bench) -> None:
    """Told of another payload, another reference and a way, and without encoders for three samples."""
    name, files = emit_controller(behind, kind)
    flags = ("-O0", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror")
    emitted = EmittedController(name, files, present_sensors(behind.problem), flags=flags, motors=2)
    python: LinearMpc | RealTimeIteration
    if kind == "mpc-links":
        python = LinearMpc(behind.links, behind.problem, behind.inertia)
    else:
        python = RealTimeIteration(behind.step, behind.links, behind.inertia, kind == "rti-zero")
        python.estimator = NonlinearFilter(behind.step, behind.links)
        python.reset()
    plant = plant_of(behind.scene, behind.problem, CONDITIONS[1])
    assert_allclose(plant.measured()[:2], behind.problem.start, atol=2.0 * np.pi / 65536)
    ahead = np.linspace([0.5, 0.0], [0.6, 0.1], behind.problem.horizon)
    for k in range(24):
        if k == 4:
            assert emitted.carry(0.5) is python.carry(0.5)
        if k == 8:
            assert emitted.aim(ahead[0]) is python.aim(ahead[0])
        if k == 16:
            assert emitted.follow(ahead) is python.follow(ahead)
        seen, valid = plant.measured(), np.full(6, not 11 <= k < 14)
        expected, found = python.command(seen, valid), emitted.command(seen, valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-9)
        assert found.status is expected.status
        plant.advance(expected.torque)
