"""Compiled kernels driven from Python."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.native import NativeKernel, NonFiniteStateError, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.reference import exact_response
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import load_scene

pytestmark = pytest.mark.compiler


def kernel_of(name: str, **changes: Any) -> NativeKernel:
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    scene = load_scene(scenes_dir() / f"{name}.toml").replace(**keys)
    return compile_kernel(build_program(scene), scene)


@pytest.fixture(scope="module")
def thesis() -> NativeKernel:
    return kernel_of("thesis10")


@pytest.fixture(scope="module")
def drive() -> NativeKernel:
    return kernel_of("drivetrain", integrator__name="sdirk2")


def test_simulation_is_right(thesis: NativeKernel) -> None:
    times, outputs = thesis.simulate(5.0, {"tip_torque": 1.0})
    scene = load_scene(scenes_dir() / "thesis10.toml")
    exact = exact_response(scene, {"tip_torque": Constant(1.0)}, times)
    assert (len(times), times[1], times[-1]) == (501, 0.01, 5.0)
    assert np.abs(outputs["tip"] - exact["tip"]).max() <= 1e-4 * np.abs(exact["tip"]).max()


def test_simulation_is_its_steps(drive: NativeKernel) -> None:
    """At the instants of the stages, from the given start, with other parameters and another step."""

    def torque(t: float) -> float:
        return float(np.sin(2000.0 * t))

    start = {"initial_angle": np.linspace(0.0, 0.1, 6), "initial_rate": 0.5}
    given = {"params": {"hub_inertia": 4e-3}, "step": 2e-4}
    times, outputs = drive.simulate(0.002, {"motor_torque": torque, "load_torque": -2.0}, **given, **start)
    drive.prepare(**given)  # type: ignore[arg-type]
    drive.initialise({"motor_torque": torque(0.0), "load_torque": -2.0}, **start)
    instants = drive.program.stage_instants[-1]
    rows = [drive.output()]
    for time in times[:-1]:
        sampled = [torque(time + instant * 2e-4) for instant in instants]
        drive.step({"motor_torque": sampled, "load_torque": -2.0})
        rows.append(drive.output())
    for name, series in outputs.items():
        assert np.allclose(series, [row[name] for row in rows], rtol=1e-12, atol=1e-15), name


def test_start_up_steps_are_counted() -> None:
    kernel = kernel_of("thesis2", integrator__name="houbolt")
    kernel.prepare()
    kernel.initialise()
    counts = []
    for _ in range(5):
        counts.append(kernel.state["start_steps_taken"])
        kernel.step({"tip_torque": 1.0})
    startup = len(kernel.program.startup)
    assert counts == [min(k, startup) for k in range(5)]


def test_state_can_be_read_and_set(thesis: NativeKernel) -> None:
    thesis.prepare()
    thesis.initialise(initial_angle=0.25)
    state = thesis.state
    assert np.array_equal(state["angle"], np.full(10, 0.25))
    thesis.step()
    thesis.state = state
    assert all(np.array_equal(thesis.state[name], state[name]) for name in state)
    assert thesis.output()["tip"] == 0.25


def test_default_start_and_parameters_are_the_scenes() -> None:
    kernel = kernel_of("thesis2", initial__angles=[0.1, -0.2], initial__rates=3.0)
    kernel.prepare()
    kernel.initialise()
    assert np.array_equal(kernel.state["angle"], [0.1, -0.2])
    assert np.array_equal(kernel.state["rate"], [3.0, 3.0])
    assert (kernel.model["stiffness"], kernel.model["step"]) == (20.0, 0.01)


def test_inputs_are_zero_unless_given(thesis: NativeKernel) -> None:
    thesis.prepare()
    thesis.initialise()
    thesis.step({"tip_torque": 1.0})
    pushed = thesis.output()["tip"]
    thesis.initialise()
    thesis.step()
    assert (thesis.output()["tip"], pushed > 0) == (0.0, True)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda k: k.step({"push": 1.0}), "inputs has no 'push'; it has: motor_torque, load_torque"),
        (lambda k: k.step({"motor_torque": [1.0, 2.0, 3.0]}), "motor_torque has 2 numbers"),
        (lambda k: k.prepare({"mass": 1.0}), "params has no 'mass'"),
        (lambda k: k.prepare({"stiffness": [1.0]}), "stiffness has 6 numbers"),
        (lambda k: k.prepare({"hub_inertia": [1.0]}), "hub_inertia is one number"),
        (
            lambda k: k.initialise(angle=0.0),
            "initialise takes no angle; it takes initial_angle, initial_rate",
        ),
        (
            lambda k: k.simulate(1.0, {"push": 1.0}),
            "no input is named push; there are: motor_torque, load_torque",
        ),
        (lambda k: k.simulate(-1.0), "duration must be a time"),
        (lambda k: k.simulate(float("nan")), "duration must be a time"),
    ],
)
def test_bad_usage(drive: NativeKernel, call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call(drive)


def test_a_motion_beyond_all_bounds_says_when() -> None:
    """An explicit method far beyond its stable step."""
    kernel = kernel_of("hundred", integrator__name="zhai")
    with pytest.raises(NonFiniteStateError, match=r"hundred, step \d+: the motion has outgrown"):
        kernel.simulate(200.0, {"tip_torque": 1.0}, step=0.1)


def test_time_of_a_step(thesis: NativeKernel) -> None:
    """Positive and not absurd; nothing more can be asked of a clock on a shared machine."""
    assert 1.0 < thesis.timer({"tip_torque": 1.0})() < 1e6
