"""Rounding in single precision does not add up: a million steps are as good as the first hundred thousand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from support.float32_error import SingleError, single_precision

from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene

pytestmark = pytest.mark.compiler

ULP = 2.0**-23


def committed(name: str, **changes: Any) -> Scene:
    scene = load_scene(scenes_dir() / f"{name}.toml")
    return scene.replace(**changes) if changes else scene


def tones(t: np.ndarray) -> np.ndarray:
    return 1.0 + np.sin(0.3 * t) + np.sin(0.7 * t)


@pytest.mark.parametrize("power", [0.0, 0.5, 1.0, -1.0])
def test_growth_is_the_exponent_of_time(power: float) -> None:
    times = np.linspace(1.0, 100.0, 20)
    noise = 1.0 + 0.01 * np.random.default_rng(0).normal(size=20)
    error = SingleError("y", 1.0, 1.0, times, 1e-6 * times**power * noise)
    assert error.growth == pytest.approx(power, abs=0.05)


def test_a_chain_over_a_million_steps() -> None:
    errors = single_precision(committed("thesis10"), {"tip_torque": tones}, 1_000_000)
    assert {error.output for error in errors} == {"tip", "base_torque"}
    for error in errors:
        assert abs(error.growth) < 0.05
        assert 2.0 * ULP < error.largest < 32.0 * ULP


def test_an_arm_over_many_steps() -> None:
    """Released from the horizontal, then kept swinging: the error dies with the swing, and stays with the load."""
    scene = committed("arm2", **{"base.damping": 0.5})
    load = {"hub_torque": lambda t: 0.5 * np.sin(2.0 * t)}
    for error in single_precision(scene, load, 300_000):
        assert error.growth < 0.05
        assert np.all(error.windows[-5:] < 2.0 * np.min(error.windows[-5:]))
        assert error.largest < 1e-3


def test_accelerations_as_unknowns_lose_least() -> None:
    found = {
        unknown: max(
            error.largest
            for error in single_precision(
                committed("thesis10", **{"model.unknown": unknown}), {"tip_torque": tones}, 50_000
            )
        )
        for unknown in ("acceleration", "increment", "displacement")
    }
    assert 2.0 * found["acceleration"] < found["increment"] < 0.1 * found["displacement"]


def test_a_vibration_that_does_not_die_lags_by_a_rounded_step() -> None:
    """Phase, and with it the error, drifts; by less than half a unit in the last place of the time that has passed."""
    scene = committed("hundred")
    for error in single_precision(scene, {"tip_torque": lambda t: np.sin(2.0 * t)}, 200_000):
        if error.output != "base_torque":  # it follows every wave along the shaft, and they are noisy
            assert error.growth == pytest.approx(1.0, abs=0.3)
            slowest = 0.5 * np.pi / 100.0 * np.sqrt(400.0 / 0.01)
            assert np.all(error.windows < ULP * slowest * np.maximum(error.times, 10.0))


def spun(kernel: NativeKernel, every: int) -> np.ndarray:
    """Return the torque in a shaft of a drive that turns on and on, its turns taken out now and then."""
    torques = []
    kernel.prepare()
    kernel.initialise()
    kernel.state = {"hub_rate": 500.0, "rate": 500.0}
    for k in range(10_000):
        kernel.step({"motor_torque": 5.0, "load_torque": -4.0})
        torques.append(kernel.output()["shaft_torque"])
        if every and (k + 1) % every == 0:
            state = kernel.state
            kernel.state = {"hub_angle": 0.0, "angle": state["angle"] - state["hub_angle"]}
    return np.array(torques)


def test_turns_of_a_free_drive_are_to_be_taken_out() -> None:
    scene = committed("drivetrain")
    program = build_program(scene)
    single, double = (
        compile_kernel(program, scene.replace(**{"emit.real": real})) for real in ("float32", "float64")
    )
    exact = spun(double, 0)
    np.testing.assert_allclose(spun(double, 10), exact, atol=1e-6 * np.max(np.abs(exact)))
    peak = np.max(np.abs(exact))
    assert np.max(np.abs(spun(single, 0) - exact)) > 0.1 * peak
    assert np.max(np.abs(spun(single, 10) - exact)) < 2e-3 * peak


# -- numbers kept as sums of two ----------------------------------------------------------------

SUMS = {"emit.real": "float32", "emit.compensated": True, "emit.trigonometry": "own"}
ENDLESS: dict[str, tuple[str, dict[str, Any], int]] = {
    "hundred": ("tip", {"tip_torque": lambda t: np.sin(2.0 * t)}, 100_000),
    "drivetrain": (
        "shaft_torque",
        {
            "motor_torque": lambda t: 5.0 * np.sin(2.0 * np.pi * t),
            "load_torque": lambda t: np.full_like(t, -0.5),
        },
        100_000,
    ),
    "swing": ("hub", {"hub_torque": lambda t: np.sin(2.0 * np.pi * t)}, 30_000),
}
"""Scenes whose error grows with time in plain single precision: the output, the load, and steps enough to see it."""


@pytest.mark.parametrize("name", ENDLESS)
def test_compensated_errors_do_not_grow(name: str) -> None:
    output, load, steps = ENDLESS[name]
    plain = {error.output: error for error in single_precision(committed(name), load, steps)}[output]
    assert plain.growth > 0.5
    assert plain.largest > 16.0 * ULP
    found = {error.output: error for error in single_precision(committed(name, **SUMS), load, steps)}
    assert found[output].growth < 0.3  # of a rounding that grows as the output does, before it has settled
    assert all(error.largest < ULP for error in found.values())  # what is left is the rounding of an output


@pytest.mark.parametrize("name", ENDLESS)
def test_below_the_rounding_of_outputs_the_state_is_right_too(name: str) -> None:
    """Outputs are rounded once more; the state shows what rounding has really added up to."""
    _, load, steps = ENDLESS[name]
    scene = committed(name, **SUMS)
    program, step = build_program(scene), scene.integrator.step
    rounded = {key: _in_single(signal) for key, signal in load.items()}
    states = []
    for changes in ({}, {"emit.compensated": False, "emit.real": "float64"}):
        kernel = compile_kernel(program, scene.replace(**changes))
        Series(kernel, rounded, steps, step).run()
        states.append(kernel.state)
    mine, right = states
    assert np.max(np.abs(mine["angle"] - right["angle"])) < 1e-10 * np.max(np.abs(right["angle"]))


def _in_single(signal: Any) -> Any:
    return lambda t: signal(t).astype(np.float32).astype(float)
