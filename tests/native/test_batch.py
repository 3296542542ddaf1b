"""Many arms side by side: each gets the bits that a kernel of its own would give it, and none harms another."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.emit.numpy.batch import STATUSES
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.batch import NativeBatch, compile_batch
from tmm_gen.package.texts import emit_package
from tmm_gen.package.write import write_package
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene, parse_scene

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[2]
PRESCRIBED = [{"name": "base_angle", "at": "base", "acts": "angle"}]
OWN_SINES = {"emit.trigonometry": "own", "emit.batch": 8}
BOX = {"angles": [-3.2, 3.2], "rates": [-6.0, 6.0], "accelerations": [-2e3, 2e3]}
BOX |= {"torque": [-2.0, 2.0]}
IN_SPACE = """
name = "turret"
model = { kind = "spatial", gravity = [0, 0, -9.81] }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 2e-5
gear = 100
damping = 0.5
[[link]]
name = "column"
on = "yaw"
end = [0.1, 0, 0.3]
mass = 2.0
inertia = [2e-2, 2e-2, 5e-3]
[[joint]]
name = "elbow"
on = "column"
axis = "y"
stiffness = 300.0
damping = 0.4
[[link]]
name = "forearm"
on = "elbow"
length = 0.4
mass = 0.8
inertia = [1e-3, 1e-2, 1e-2]
[[input]]
name = "torque"
at = "yaw"
acts = "torque"
[[output]]
name = "tip"
at = "forearm"
of = "position"
"""
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "start-up steps, a chain": ("scenes/thesis10", {"integrator": {"name": "mixed", "step": 0.002}, "emit.batch": 8}),
    "stages": ("scenes/arm2", {**OWN_SINES, "integrator": {"name": "sdirk4", "step": 0.002}}),
    "four lanes, branches": ("scenes/gripper", {**OWN_SINES, "emit.batch": 4}),
    "a free base": ("scenes/cube", OWN_SINES),
    "floats, no inputs": ("scenes/fall10", {"emit.trigonometry": "own", "emit.batch": 16, "emit.real": "float32"}),
    "a motor with gears": ("scenes/drivetrain", {"emit.batch": 8}),
    "a prescribed angle": ("scenes/thesis2", {"base": {"kind": "prescribed"}, "input": PRESCRIBED, "emit.batch": 4}),
    "space, within a box": ("", {**OWN_SINES, "emit.box": BOX}),
}  # fmt: skip
ARMS = 21  # not a multiple of any number side by side


@cache
def compiled(case: str) -> tuple[Scene, NativeBatch, NativeKernel]:
    name, changes = CASES[case]
    plain = load_scene(ROOT / f"{name}.toml") if name else parse_scene(IN_SPACE)
    scene = plain.replace(**{"emit.parameters": "free", **changes})
    program = build_program(scene)
    return scene, compile_batch(program, scene), compile_kernel(program, scene)


@pytest.fixture(params=list(CASES))
def case(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


def drawn(batch: NativeBatch, seed: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Inputs and parameters of many arms: constants of each, the same function for all, functions of each."""
    draw = np.random.default_rng(seed)
    inputs: dict[str, Any] = {}
    amounts = 0.02 * draw.standard_normal(ARMS)
    for number, variable in enumerate(batch.program.inputs):
        kinds = [amounts, lambda t: 0.01 * np.sin(3.0 * t), lambda t: amounts * np.cos(5.0 * t)]
        inputs[variable.name] = kinds[number % 3]
    params = {
        v.name: np.asarray(v.default)[..., None] * draw.uniform(0.99, 1.01, ARMS)
        if v.length
        else float(v.default or 0.0) * draw.uniform(0.99, 1.01, ARMS)  # type: ignore[arg-type]
        for v in batch.program.parameters[:5]
    }
    return inputs, params


def of_arm(values: dict[str, Any], arm: int) -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if callable(value):
            yield name, lambda t, value=value: np.broadcast_to(value(t), ARMS)[arm]
        else:
            yield name, value[..., arm]


def test_every_arm_has_the_bits_of_its_own_kernel(case: str) -> None:
    scene, batch, kernel = compiled(case)
    inputs, params = drawn(batch, 3)
    duration = 40 * scene.integrator.step
    run = batch.simulate(duration, inputs, params, threads=2, arms=ARMS)
    assert not run.status.any()
    assert np.ptp(run.outputs[batch.program.outputs[0].name][-1]) > 0.0
    for arm in range(ARMS):
        times, outputs = kernel.simulate(duration, dict(of_arm(inputs, arm)), dict(of_arm(params, arm)))
        np.testing.assert_array_equal(run.times, times)
        for name, values in outputs.items():
            np.testing.assert_array_equal(run.outputs[name][:, arm], values, err_msg=name)


def test_a_spoilt_arm_is_refused_alone(case: str) -> None:
    """Parameters, start and steps may each be refused; what their own kernel says is what the batch says."""
    scene, batch, kernel = compiled(case)
    inputs, params = drawn(batch, 4)
    duration = 40 * scene.integrator.step
    sound = batch.simulate(duration, inputs, params, arms=ARMS)
    spoilt = {name: value.copy() for name, value in params.items()}
    name = next(iter(spoilt))
    spoilt[name][..., 2], spoilt[name][..., 9] = np.nan, -1e6
    given = batch.program.given[0]
    start = np.repeat(np.asarray(given.default or [0.0] * (given.length or 1))[:, None], ARMS, axis=1)
    start[:, ARMS - 1] = 1e30
    run = batch.simulate(duration, inputs, spoilt, arms=ARMS, **{given.name: start})
    hurt = [2, 9, ARMS - 1]
    for arm in range(ARMS):
        own = dict(of_arm(inputs, arm)), dict(of_arm(spoilt, arm))
        if arm not in hurt:
            assert run.status[arm] == 0
            for output, values in run.outputs.items():
                np.testing.assert_array_equal(values[:, arm], sound.outputs[output][:, arm])
        elif run.status[arm]:
            with pytest.raises((ArithmeticError, ValueError)):
                kernel.simulate(duration, *own, **{given.name: start[:, arm]})
            assert all(np.isnan(values[-1, arm]) for values in run.outputs.values())
        else:  # a chain takes any angle
            _, outputs = kernel.simulate(duration, *own, **{given.name: start[:, arm]})
            for output, values in run.outputs.items():
                np.testing.assert_array_equal(values[:, arm], outputs[output])
    assert run.status[2] == STATUSES.index("an argument is not finite")


def test_an_arm_that_fails_on_the_way_stops_there_and_the_others_go_on() -> None:
    scene, batch, _ = compiled("stages")
    steps = 30
    torque = np.zeros((steps, ARMS))
    torque[10:, 3] = np.nan
    torque[20:, 20] = 1e300
    run = batch.simulate(steps * scene.integrator.step, {"hub_torque": torque})
    still = batch.simulate(steps * scene.integrator.step, arms=1)
    assert np.flatnonzero(run.status).tolist() == [3, 20]
    assert run.status[3] == STATUSES.index("an argument is not finite")
    for name, values in run.outputs.items():
        assert np.isnan(values[11:, 3]).all()
        assert np.isfinite(values[:11, 3]).all()
        assert np.isfinite(values[:21, 20]).all()
        for arm in set(range(ARMS)) - {3, 20}:
            np.testing.assert_array_equal(values[:, arm], still.outputs[name][:, 0])


def test_when_one_of_two_batches_fails_the_other_goes_on_alone() -> None:
    """Batches are stepped two at once; that one of them ends changes no bit of the other."""
    scene, batch, _ = compiled("stages")
    draw = np.random.default_rng(9)
    steps, torque = 20, draw.standard_normal((20, 16))
    sound = batch.simulate(steps * scene.integrator.step, {"hub_torque": torque})
    spoilt = torque.copy()
    spoilt[10:, 8:] = np.nan
    run = batch.simulate(steps * scene.integrator.step, {"hub_torque": spoilt}, every=3)
    assert np.flatnonzero(run.status).tolist() == list(range(8, 16))
    for name, values in sound.outputs.items():
        np.testing.assert_array_equal(run.outputs[name][:, :8], values[::3, :8])
        np.testing.assert_array_equal(run.outputs[name][:4, 8:], values[:12:3, 8:])
        assert np.isnan(run.outputs[name][4:, 8:]).all()


def test_when_all_arms_fail_none_is_left() -> None:
    scene, batch, _ = compiled("stages")
    run = batch.simulate(20 * scene.integrator.step, {"hub_torque": np.full(9, np.inf)})
    assert (run.status == STATUSES.index("an argument is not finite")).all()
    assert "9 refused" in repr(run)


def test_threads_and_what_is_kept_change_no_bit() -> None:
    scene, batch, _ = compiled("stages")
    draw = np.random.default_rng(8)
    torque = draw.standard_normal((30, 300))
    runs = [
        batch.simulate(30 * scene.integrator.step, {"hub_torque": torque}, threads=threads, every=every)
        for threads, every in ((1, 1), (2, 1), (3, 7))
    ]
    for name, values in runs[0].outputs.items():
        np.testing.assert_array_equal(values, runs[1].outputs[name])
        np.testing.assert_array_equal(values[::7], runs[2].outputs[name])
    np.testing.assert_allclose(runs[2].times, runs[0].times[::7], rtol=1e-15)


def test_what_cannot_start_harms_nobody_in_any_thread() -> None:
    """One in a share, and all of the last one; zeros keep their sign where all arms have the same input."""
    scene, batch, _ = compiled("stages")
    count, duration, name = 200, 5 * scene.integrator.step, batch.program.parameters[0].name
    value = np.asarray(batch.program.parameters[0].default)[..., None] * np.linspace(0.9, 1.1, count)
    sound = batch.simulate(duration, {"hub_torque": np.full((5, count), -0.0)}, {name: value}, threads=1)
    spoilt = value.copy()
    lost = np.r_[70, 192:200]
    spoilt[..., lost] = np.nan
    for threads in (1, 3):
        run = batch.simulate(duration, {"hub_torque": np.full((5, 1), -0.0)}, {name: spoilt}, threads=threads)
        assert np.flatnonzero(run.status).tolist() == lost.tolist()
        for output, values in run.outputs.items():
            assert np.isnan(values[:, lost]).all()
            kept, own = (np.delete(found, lost, axis=1) for found in (values, sound.outputs[output]))
            np.testing.assert_array_equal(kept.view(np.int64), own.view(np.int64))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"inputs": {"torque": 1.0}}, "no inputs named torque; there are: hub_torque"),
        ({"params": {"weight": 1.0}}, "no parameters named weight"),
        ({"initial_places": 0.0}, "no arguments of the start named initial_places"),
        ({"params": {"gravity": np.ones((2, 3))}}, "gravity has the shape (2, 3)"),
        ({"params": {"gravity": np.ones(3)}, "arms": 4}, "how many arms? gravity is for 3, arms = 4"),
        ({"params": {"stiffness": np.ones(5)}}, "fits neither 2 values nor 1 arms"),
        ({"inputs": {"hub_torque": np.ones((7, 3))}}, "7 rows for 50 steps"),
        ({"inputs": {"hub_torque": np.ones((7, 3, 1))}}, "3 dimensions"),
        ({"duration": -1.0}, "duration and step"),
        ({"inputs": {"hub_torque": []}}, "hub_torque has the shape (0,)"),
        ({"inputs": {"hub_torque": np.zeros((0, 3))}, "duration": 0.0}, "hub_torque has rows"),
        ({"inputs": {"hub_torque": "much"}}, "hub_torque must be a real number"),
        ({"inputs": {"hub_torque": [[1.0], [1.0, 2.0]]}}, "hub_torque must be a real number"),
        ({"inputs": {"hub_torque": lambda t: None}}, "s must be a real number"),
        ({"inputs": {"hub_torque": lambda t: np.ones((2, 3))}}, "hub_torque gives the shape (2, 3)"),
        ({"inputs": {"hub_torque": lambda t: np.ones(3 if t < 0.01 else 4)}}, "for 3 and for 4 arms"),
        (
            {"inputs": {"hub_torque": lambda t: np.ones(3 if t == 0.0 else 4)}, "arms": 4},
            "hub_torque is for 3",
        ),
        ({"inputs": {"hub_torque": np.ones(50)}, "arms": 4}, "has rows, the shape (steps, 1)"),
        ({"params": {"gravity": 1.0j}}, "gravity must be a real number"),
        ({"params": {"gravity": []}}, "gravity has the shape (0,)"),
        ({"initial_angle": "up"}, "initial_angle must be a real number"),
        ({"step": np.inf}, "duration and step"),
        ({"every": 0}, "every must be a whole number, 1 or more"),
        ({"every": 1.5}, "every must be a whole number, 1 or more"),
        ({"arms": 0}, "arms must be a whole number, 1 or more"),
        ({"arms": 2.5}, "arms must be a whole number, 1 or more"),
        ({"threads": 0}, "threads must be a whole number, 1 or more"),
    ],
)
def test_what_does_not_fit_is_said(arguments: dict[str, Any], said: str) -> None:
    scene, batch, _ = compiled("stages")
    with pytest.raises(ValueError, match=re.escape(said)):
        batch.simulate(**{"duration": 50 * scene.integrator.step, **arguments})


def test_inputs_may_lie_anywhere_in_memory() -> None:
    """Records, columns, reversed, of another byte order, of integers: the numbers count, not how they are kept."""
    scene, batch, _ = compiled("stages")
    rows = np.random.default_rng(5).integers(-9, 9, (20, ARMS)).astype(float)
    records = np.zeros((20, ARMS), dtype=[("torque", "f8"), ("count", "i4")])  # 12 bytes from one to the next
    records["torque"] = rows
    kept = [
        rows,
        records["torque"],
        np.asfortranarray(rows),
        rows[::-1].copy()[::-1],
        rows.astype(">f8"),
        rows.astype(int),
    ]
    runs = [batch.simulate(20 * scene.integrator.step, {"hub_torque": torque}) for torque in kept]
    for run in runs[1:]:
        for name, values in run.outputs.items():
            np.testing.assert_array_equal(values, runs[0].outputs[name])


def test_a_function_may_give_one_number_and_later_one_for_each_arm() -> None:
    scene, batch, _ = compiled("stages")
    step = scene.integrator.step
    amounts = np.linspace(0.0, 1.0, 5)
    told = batch.simulate(10 * step, {"hub_torque": lambda t: 0.0 if t < 4.5 * step else amounts})
    same = batch.simulate(10 * step, {"hub_torque": lambda t: amounts * (t >= 4.5 * step)})
    assert told.status.shape == (5,)
    for name, values in told.outputs.items():
        np.testing.assert_array_equal(values, same.outputs[name])


@pytest.mark.filterwarnings("error")
def test_what_floats_are_too_small_for_is_refused_without_a_warning() -> None:
    _, batch, _ = compiled("floats, no inputs")
    name = batch.program.parameters[0].name
    shape = np.shape(batch.parameters[name])
    run = batch.simulate(0.0, params={name: np.broadcast_to([1e300, 1.0], (*shape, 2))})
    assert run.status.tolist() == [STATUSES.index("an argument is not finite"), 0]


@pytest.mark.parametrize("name", ["batch", "harness", "batch_harness", "kernel_harness"])
def test_a_scene_may_be_called_as_our_own_sources(name: str) -> None:
    scene = load_scene(ROOT / "scenes" / "thesis2.toml").replace(**{"name": name, "emit.batch": 4})
    program = build_program(scene)
    step, pushed = scene.integrator.step, {program.inputs[0].name: 1.0}
    times, outputs = compile_kernel(program, scene).simulate(step, pushed)
    run = compile_batch(program, scene).simulate(step, pushed)
    assert any(values[-1] for values in outputs.values())
    np.testing.assert_array_equal(run.times, times)
    assert all(run.outputs[output][-1, 0] == values[-1] for output, values in outputs.items())


@pytest.mark.parametrize("wrong", [None, "far", np.ones((2, 2))], ids=["none", "text", "rows"])
def test_a_wrong_function_of_a_prescribed_angle_is_told_by_its_name(wrong: Any) -> None:
    _, batch, _ = compiled("a prescribed angle")
    with pytest.raises(ValueError, match=r"^base_angle (at|gives)"):
        batch.simulate(0.01, {"base_angle": lambda _: wrong})


def test_a_scene_without_a_batch_has_none() -> None:
    scene = load_scene(ROOT / "scenes" / "arm2.toml")
    with pytest.raises(ValueError, match=r"emit\.batch is not set"):
        compile_batch(build_program(scene), scene)


@pytest.mark.parametrize("which", ["a prescribed angle", "start-up steps, a chain"])
def test_the_generated_package_gives_the_same_bits(
    which: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of arms that differ, of which one cannot start, by threads; what does not fit is said."""
    scene, batch, _ = compiled(which)
    write_package(emit_package(scene), tmp_path / f"arms_of_{scene.name}")
    monkeypatch.syspath_prepend(tmp_path)
    package = importlib.import_module(f"arms_of_{scene.name}")
    inputs, params = drawn(batch, 6)
    next(iter(params.values()))[..., 4] = np.inf
    duration = 12 * scene.integrator.step
    expected = batch.simulate(duration, inputs, params, every=3, arms=ARMS)
    given = replace(package.Params(), **params)
    found = package.simulate_batch(given, inputs, duration, every=3, arms=ARMS, n_threads=2)
    np.testing.assert_array_equal(found.status, expected.status)
    assert found.status[4] == STATUSES.index("an argument is not finite")
    np.testing.assert_array_equal(found.times, expected.times)
    for name, values in expected.outputs.items():
        np.testing.assert_array_equal(found.outputs[name], values)
    with pytest.raises(ValueError, match="no input is named nothing; there are: "):
        package.simulate_batch(given, {"nothing": 1.0}, duration)
    name = package.INPUT_NAMES[0]
    with pytest.raises(ValueError, match=rf"{name} has the shape \(2, 3\); .* a row for each of 12 steps"):
        package.simulate_batch(given, {name: np.zeros((2, 3))}, duration)
    with pytest.raises(ValueError, match=rf"how many arms\? {name} is for 3, "):
        package.simulate_batch(given, {name: np.zeros(3)}, duration)
