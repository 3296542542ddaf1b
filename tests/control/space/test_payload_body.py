"""One of several bodies is the payload: conditions, models and emitted C mean the same one."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.space_plant import SpacePlant
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import EmittedController
from tmm_gen.onboard.unit import controller_content
from tmm_gen.scene import Scene, SceneError, parse_scene

WRIST = """
[[body]]
name = "hand"
on = "upper"
at = [0.02, 0.01, -0.03]
mass = 0.3
center = [0.0, 0.02, 0.01]
inertia = [3e-4, 2e-4, 4e-4, 1e-5, 0, 0]
[[body]]
name = "rotor"
on = "yaw"
mass = 0.2
center = [0.1, 0, 0]
[[body]]
name = "tool0"
on = "upper"
at = [0.1, 0, 0]
[[body]]
name = "pedestal"
on = "base"
mass = 3.0
[[input]]
name = "yaw_torque"
"""
"""Beside the payload: what else a URDF's arm has at its end, and what the payload cannot be."""


@pytest.fixture(scope="module")
def several(words: str) -> str:
    """The file of an arm with several bodies at its end."""
    return words.replace('[[input]]\nname = "yaw_torque"\n', WRIST)


@pytest.fixture(scope="module")
def told(several: str) -> Bench:
    """One of them is the payload."""
    return Bench.of(told_scene(several, "hand"))


def told_scene(several: str, name: str) -> Scene:
    """Return the scene of which one body is told to be the payload."""
    return parse_scene(
        several.replace("[control]\n", f'[control]\npayload_body = "{name}"\n'), "several.toml"
    )


def heavier(bench: Bench, mass: float) -> Scene:
    """Return the scene in which that body simply has another mass."""
    return bench.scene.replace(**{"body.hand.mass": mass})


@pytest.mark.parametrize(
    ("name", "fault", "remedy"),
    [
        ("hnd", "is not the name of a [[body]]", "Did you mean 'hand'?"),
        ("upper", "is not the name of a [[body]]", "Choose one of payload, hand, rotor."),
        ("pedestal", "is moved by no motor", "Choose one of payload, hand, rotor."),
        ("tool0", "is a body without a mass", "Write `mass` under [[body]] 'tool0', in kg"),
    ],
)
def test_what_cannot_be_the_payload_is_refused(several: str, name: str, fault: str, remedy: str) -> None:
    with pytest.raises(SceneError) as found:
        told_scene(several, name)
    text, line = str(found.value), several[: several.index("[control]\n")].count("\n") + 2
    assert text.startswith(f'several.toml:{line}: control.payload_body: {fault} (got "{name}"). {remedy}')


def test_remedies_serve(several: str) -> None:
    """A frame that is given a mass is one; any that is to be chosen can be."""
    weighed = several.replace('name = "tool0"\n', 'name = "tool0"\nmass = 0.1\n')
    for name in ("payload", "hand", "rotor", "tool0"):
        scene = told_scene(weighed, name)
        assert list(arm_of(scene).payloads()) == [f"body.{name}.mass"]


def test_without_it_there_is_no_payload_to_tell_of(several: str) -> None:
    """And what is said then names the key."""
    bench = Bench.of(parse_scene(several, "several.toml"))
    assert len(arm_of(bench.scene).payloads()) == 2
    assert not bench.step.carries
    with pytest.raises(UserError, match=r"Of several say which: `payload_body = \"...\"` in \[control\]"):
        RealTimeIteration(bench.step, bench.links, bench.inertia, zero_order=True).carry(0.1)


def test_a_model_told_of_a_payload_is_that_of_the_arm_that_has_it(told: Bench) -> None:
    """Its parameters, the step of its kernel and what holds it up; other bodies stay as they are."""
    other = Bench.of(heavier(told, 0.4))
    carrying = told.step.carrying(0.4)
    assert_allclose(carrying.parameters, other.step.parameters, rtol=1e-14, atol=1e-16)
    random = np.random.default_rng(3)
    state, torque = random.normal(0.0, 0.1, told.step.size), random.normal(0.0, 0.1, 2)
    assert_allclose(
        carrying.step_slopes(state, torque)[0], other.step.step_slopes(state, torque)[0], rtol=1e-12
    )
    lift = told.links.lift
    assert lift.payload == 0.3
    for hub in random.uniform(-2.0, 2.0, (4, 2)):
        assert_allclose(lift.weight(hub, 0.1), other.links.lift.weight(hub), rtol=0.0, atol=1e-12)


def test_conditions_and_the_assumed_payload_are_of_that_body(told: Bench) -> None:
    """The arm it is tried on, and the one that controllers reckon with."""
    more = next(each for each in CONDITIONS if each.payload == 1.5)
    plant = SpacePlant(told.scene, told.problem, more)
    nominal = SpacePlant(heavier(told, 0.45), told.problem, CONDITIONS[0])
    assert_allclose(plant.resting, nominal.resting, rtol=0.0, atol=1e-12)
    for each in (plant, nominal):
        each.advance(np.array([0.3, 0.05]))
    assert_allclose(plant.kernel.state["rate"], nominal.kernel.state["rate"], rtol=1e-9)
    assumed = Bench.of(told.scene.replace(**{"control.payload": 1.5})).assumed
    assert assumed.spatial == heavier(told, 0.3 * 1.5).spatial


@pytest.mark.compiler
def test_emitted_code_carries_it_as_python_does(told: Bench) -> None:
    """Told before its first sample it holds the arm by the torques of a scene whose body has that mass."""
    name, files = emit_controller(told, "rti-zero")
    assert "mass of 'hand', not negative [kg]" in files[f"{name}.h"]
    flags = ("-O0", "-ffp-contract=off", "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wundef", "-Werror")
    emitted = EmittedController(name, files, present_sensors(told.problem), flags=flags, motors=2)
    python = RealTimeIteration(told.step, told.links, told.inertia, zero_order=True)
    python.estimator = NonlinearFilter(told.step, told.links)
    start = told.links.start_hub
    held = rest_with(heavier(told, 0.05), start, "here").goal.torque
    assert abs(told.links.start_torque[1]) > 1.2 * abs(held[1])
    seen = np.append(start, 4 * [np.nan])
    for each in (emitted, python):
        each.reset()
        assert each.aim(start) is each.carry(0.05) is Status.OK
    for _ in range(3):
        expected, found = python.command(seen).torque, emitted.command(seen).torque
        # the cost to go is of another payload, and trades a little torque
        assert_allclose(found, held, rtol=0.0, atol=0.01 * np.max(np.abs(held)))
        assert_allclose(found, expected, rtol=0.0, atol=1e-10)
    emitted.reset()
    python.reset()
    plant = SpacePlant(told.scene, told.problem, CONDITIONS[1])
    payloads = {2: 0.0, 6: 0.7, 9: -1.0}
    for k in range(12):
        if k in payloads:
            taken = Status.NOT_FINITE if payloads[k] < 0.0 else Status.OK
            assert emitted.carry(payloads[k]) is python.carry(payloads[k]) is taken
        measured = plant.measured()
        wanted, got = python.command(measured), emitted.command(measured)
        assert_allclose(got.torque, wanted.torque, rtol=0.0, atol=1e-10)
        assert got.status is wanted.status
        plant.advance(wanted.torque)


def test_linear_control_and_units_are_told_of_it(told: Bench) -> None:
    """By modes: what holds the arm up; the unit's input starts at that body's mass."""
    assert BY_NAME["mpc-modes"].make(told).carry(0.35) is Status.OK  # type: ignore[attr-defined]
    content = controller_content(told, "mpc-modes")
    (payload,) = (each for each in content.variables if each.name == "payload")
    assert (payload.start, payload.doc) == ((0.3,), "mass of 'hand'")


def test_what_the_kernel_has_no_number_for_is_said(several: str) -> None:
    """A payload of no mass, across: the centre's place is in the code of another joint alone. A little mass serves."""
    bare = (
        several[: several.index('[[body]]\nname = "hand"')]
        + several[several.index('[[body]]\nname = "rotor"') :]
    )
    bare = bare.replace("center = [0.1, 0, 0]", "center = [0.1, 0.02, 0]").replace(
        "at = [0.1, 0, 0]", "at = [0, 0.05, 0]"
    )
    text = bare.replace('name = "tool0"\n', 'name = "tool0"\nmass = 0.0\n')
    step = Bench.of(told_scene(text, "tool0")).step
    assert f"center_y_{step.scene.stations}" in step.module.PARAMETER_NAMES
    with pytest.raises(
        UserError, match=r'control.payload_body = "tool0": .*center_y_\d.*Change body.tool0.mass a little'
    ):
        _ = step.carries
    assert Bench.of(told_scene(text.replace("mass = 0.0", "mass = 1e-3"), "tool0")).step.carries
