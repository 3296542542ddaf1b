"""One of two bodies at the tip of an arm in a plane is the payload: conditions, models and emitted C mean that one."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.playground.payload import payload_of
from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.scene.template import template


@pytest.fixture(scope="module")
def told(two: Bench) -> Bench:
    """A gripper of 0.1 kg holds what was the payload, which weighs 0.2 kg now."""
    return Bench.of(with_gripper(two.scene, "payload"))


def with_gripper(scene: Scene, payload: str, mass: float = 0.2) -> Scene:
    """Return the arm with a gripper at its tip beside the payload."""
    bodies = [
        {"name": "payload", "on": "forearm", "mass": mass, "inertia": 1e-4},
        {"name": "gripper", "on": "forearm", "mass": 0.1, "inertia": 2e-4},
        {"name": "corner", "on": "upper", "mass": 0.05},
    ]
    return scene.replace(**{"body": bodies, "control.payload_body": payload})


def test_models_and_conditions_are_of_that_body(told: Bench) -> None:
    """As of scenes in which it simply has that mass."""
    heavier = Bench.of(with_gripper(told.scene, "payload", 0.3))
    assert told.links.lift.payload == 0.2
    assert_allclose(told.step.carrying(0.3).parameters, heavier.step.parameters, rtol=1e-14)
    hub = np.array([0.4, -0.7])
    assert_allclose(told.links.lift.weight(hub, 0.1), heavier.links.lift.weight(hub), rtol=1e-12)
    more = next(each for each in CONDITIONS if each.payload == 1.5)
    plant = Plant(told.scene, told.problem, more)
    nominal = Plant(heavier.scene, told.problem, CONDITIONS[0])
    assert_allclose(plant.goal, nominal.goal, rtol=1e-12)
    for each in (plant, nominal):
        each.advance(np.array([0.05, -0.02]))
    assert_allclose(plant.kernel.state["rate"], nominal.kernel.state["rate"], rtol=1e-9)


@pytest.mark.compiler
def test_emitted_code_carries_it_as_python_does(told: Bench) -> None:
    """With the gripper always."""
    name, files = emit_controller(told, "rti-zero")
    flags = ("-O0", "-ffp-contract=off", "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wundef", "-Werror")
    emitted = EmittedController(name, files, present_sensors(told.problem), flags=flags, motors=2)
    python = RealTimeIteration(told.step, told.links, told.inertia, zero_order=True)
    python.estimator = NonlinearFilter(told.step, told.links)
    emitted.reset()
    python.reset()
    plant = Plant(told.scene, told.problem, CONDITIONS[1])
    for k in range(10):
        if k in (0, 4, 7):
            mass = {0: 0.05, 4: 0.0, 7: 0.25}[k]
            assert emitted.carry(mass) is python.carry(mass) is Status.OK
        measured = plant.measured()
        expected, found = python.command(measured), emitted.command(measured)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status
        plant.advance(expected.torque)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("corner", "is not at the tip of the arm, where its payload is"),
        ("gripprr", "is not the name of a"),
    ],
)
def test_what_cannot_be_the_payload_is_refused(two: Bench, name: str, said: str) -> None:
    with pytest.raises(
        SceneError, match=rf'control.payload_body: {said}.*\(got "{name}"\)\. (Did you mean|Choose one)'
    ):
        with_gripper(two.scene, name)


def test_an_arm_on_a_hub_has_its_tip_alone() -> None:
    text = template("a", "planar", control=True).replace("[control]\n", '[control]\npayload_body = "tip"\n')
    with pytest.raises(
        SceneError, match=r'control.payload_body: is for arms by parts.*\(got "tip"\)\. Remove the key'
    ):
        parse_scene(text, "a.toml")


def test_the_playground_changes_that_body(two: Bench) -> None:
    for name in ("payload", "gripper"):
        payload = payload_of(with_gripper(two.scene, name))
        assert payload is not None
        assert payload.value == {"payload": 0.2, "gripper": 0.1}[name]
