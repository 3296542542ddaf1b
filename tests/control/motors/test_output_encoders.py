"""Encoders behind gears that give way: what they show, and emitted controllers that look at them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.plant import Plant
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

STIFFNESS = 600.0
"""Of the shoulder's gear, N m/rad."""
ELASTIC = {"motor.shoulder.stiffness": STIFFNESS, "motor.shoulder.damping_time": 1e-3}
OUTPUT = {"motor.shoulder.encoder": "output", "motor.elbow.encoder": "output"}
"""The elbow's gear is rigid: there it makes no difference."""


@pytest.fixture(scope="module")
def behind(two: Bench) -> Bench:
    """With the shoulder's encoder at the output of a soft gear."""
    return Bench.of(two.scene.replace(**ELASTIC, **OUTPUT))


def test_the_rotor_is_ahead_by_what_winds_the_gear_up(two: Bench) -> None:
    """At rest under weight, by statics: torque over stiffness; the joint is where the encoder is."""
    reference = np.array([0.4, -0.9])
    found = {}
    for name, changes in (("rotor", {}), ("output", OUTPUT)):
        scene = two.scene.replace(**ELASTIC, **changes)
        target, motors = rest_with(scene, reference, "here"), motors_of(scene)
        assert_allclose(motors.hub @ target.angles, reference, atol=1e-9)
        found[name] = target
        twist = 100.0 * target.goal.torque[0] / STIFFNESS
        assert_allclose(target.angles[0] - target.angles[1], twist, rtol=1e-6)
        assert twist > 5e-3
    output = found["output"]
    assert_allclose(output.angles[1], reference[0], atol=1e-9)
    assert_allclose(found["rotor"].angles[0], reference[0], atol=1e-9)


def test_a_rigid_gear_has_one_side(two: Bench) -> None:
    """All of the controller's rows are the same, and so is its C."""
    rigid = two.scene.replace(**OUTPUT)
    for name in ("hub", "tip", "turned", "drive"):
        assert_allclose(getattr(motors_of(rigid), name), getattr(two.problem.motors, name), rtol=0.0)
    assert emit_controller(Bench.of(rigid), "rti-zero") == emit_controller(two, "rti-zero")


def test_the_finer_arm_shows_the_output(behind: Bench) -> None:
    """It starts at rest where its joints are said to be, by their encoders, to a count."""
    plant = Plant(behind.scene, behind.problem, CONDITIONS[0])
    assert_allclose(plant.measured()[:2], behind.problem.start, atol=2.0 * np.pi / 65536)
    state = plant.kernel.state["angle"]
    assert state[0] - state[1] > 1e-3


@pytest.mark.compiler
@pytest.mark.parametrize("kind", ["rti-zero", "rti", "mpc-links", "mpc-modes"])
def test_torques_are_those_of_python(kind: str, behind: Bench) -> None:
    """Told of another payload and another reference on the way, and without encoders for three samples."""
    name, files = emit_controller(behind, kind)
    flags = ("-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror")
    emitted = EmittedController(name, files, present_sensors(behind.problem), flags=flags, motors=2)
    python: LinearMpc | RealTimeIteration
    if kind.startswith("mpc"):
        model = behind.links if kind == "mpc-links" else behind.modes
        python = LinearMpc(model, behind.problem, behind.inertia)
    else:
        python = RealTimeIteration(behind.step, behind.links, behind.inertia, kind == "rti-zero")
        python.estimator = NonlinearFilter(behind.step, behind.links)
        python.reset()
    plant = Plant(behind.scene, behind.problem, CONDITIONS[1])
    for k in range(30):
        if k == 6:
            assert emitted.carry(0.4) is python.carry(0.4)
        if k == 12:
            reference = np.array([0.5, -0.8])
            assert emitted.aim(reference) is python.aim(reference)
        seen, valid = plant.measured(), np.full(6, not 15 <= k < 18)
        expected, found = python.command(seen, valid), emitted.command(seen, valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-9)
        assert found.status is expected.status
        plant.advance(expected.torque)


def arrived(scene: Scene) -> np.ndarray:
    """Return how far the encoders of the finer arm are from the reference in the end, rad."""
    bench = Bench.of(scene)
    plant = Plant(bench.scene, bench.problem, CONDITIONS[0])
    controller = LinearMpc(bench.links, bench.problem, bench.inertia)
    for _ in range(150):
        plant.advance(controller.command(plant.measured()).torque)
    return np.asarray(plant.measured()[:2] - bench.problem.reference)


def test_what_is_measured_comes_to_the_reference(firm_bench: Bench) -> None:
    """To a few counts, on either side of a gear."""
    for changes in ({}, OUTPUT):
        assert_allclose(arrived(firm_bench.scene.replace(**ELASTIC, **changes)), 0.0, atol=2e-3)
