"""Emitted controllers against those in Python, and what they do when things go wrong."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.estimators.credible import FARTHEST, JUMP, PATIENCE
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.safe import BRAKE_TIME
from tmm_gen.control.quadratic.iterations import iteration_limit
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import EMITTED, emit_controller
from tmm_gen.onboard.folder import EXAMPLE
from tmm_gen.onboard.native import EmittedController

pytestmark = pytest.mark.compiler

SAMPLES = {"mpc-links": 60, "mpc-modes": 60, "rti-zero": 25, "rti": 8}
WARNINGS = (
    *(
        "-std=c99",
        "-pedantic",
        "-Wall",
        "-Wextra",
        "-Wconversion",
        "-Wdouble-promotion",
        "-Wshadow",
        "-Wundef",
    ),
    *("-Wstrict-prototypes", "-Wmissing-prototypes", "-Werror", "-O1", "-fsyntax-only", "-I."),
)


@pytest.mark.parametrize("kind", EMITTED)
def test_torques_are_those_of_python(
    kind: str, emitted: Callable[..., EmittedController], recorded: Callable[..., object]
) -> None:
    loop = recorded(kind, SAMPLES[kind])
    controller = emitted(kind)
    controller.reset()
    found = controller.run(loop.measured)
    assert set(found.statuses) == {Status.OK}
    # both solve the same program to DAQP's tolerance
    assert np.abs(found.torques - loop.torques).max() < 1e-6


def test_torques_do_not_depend_on_how_many_directions_go_side_by_side(
    bench: Bench, emitted: Callable[..., EmittedController], recorded: Callable[..., object]
) -> None:
    """Compilers for registers of 512 bits get sixteen; three divide nothing."""
    measured = recorded("rti", SAMPLES["rti"]).measured
    usual = emitted("rti")
    usual.reset()
    expected = usual.run(measured).torques
    name, files = emit_controller(bench, "rti")
    for lanes in (3, 16):
        told = f"-D{name.upper()}_KERNEL_LANES={lanes}"
        other = EmittedController(name, files, [0, 1], flags=("-O1", "-ffp-contract=off", told))
        other.reset()
        assert np.abs(other.run(measured).torques - expected).max() < 1e-12


def test_a_rate_bound_and_a_long_delay_are_those_of_python(bench: Bench) -> None:
    """Two samples and a half of delay, a bound of the change of torque that binds."""
    scene = bench.scene.replace(**{"control.delay": 0.05, "control.bounds.torque_rate": 60.0})
    other = Bench.of(scene)
    name, files = emit_controller(other, "mpc-modes")
    controller = EmittedController(name, files, [0, 1], flags=("-O1", "-ffp-contract=off"))
    python, plant = (
        LinearMpc(other.modes, other.problem, other.inertia),
        Plant(scene, other.problem, CONDITIONS[0]),
    )
    torques = []
    for _ in range(60):
        seen = plant.measured()
        torques.append((controller.command(seen).torque, python.command(seen).torque))
        plant.advance(torques[-1][1])
    in_c, in_python = np.array(torques)[:, :, 0].T
    assert np.abs(in_c - in_python).max() < 1e-6
    assert np.abs(np.diff(in_c)).max() == pytest.approx(60.0 * 0.02)


@pytest.mark.parametrize("kind", EMITTED)
def test_without_an_encoder_torque_goes_to_zero_without_others_it_goes_on(
    kind: str, bench: Bench, emitted: Callable[..., EmittedController]
) -> None:
    controller = emitted(kind)
    controller.reset()
    for _ in range(3):
        controller.command(np.array([0.0, 0.0, np.nan]))
    command = controller.command(np.array([0.0, np.nan, np.nan]))
    assert command.status is Status.REDUCED
    assert command.torque > 0.0
    lost = controller.command(np.array([np.nan, np.nan, np.nan]))
    assert lost.status is Status.MEASUREMENT
    assert lost.torque == 0.0


def test_the_safe_law_brakes_by_the_encoder(bench: Bench, emitted: Callable[..., EmittedController]) -> None:
    """The encoder goes a hundred turns away by itself, a believable step at a time: that is how to ask for it."""
    controller = emitted("mpc-modes")
    controller.reset()
    hub = FARTHEST - 0.01
    for _ in range(2):
        controller.command(np.array([hub, 0.0, np.nan]))
    hub += 0.015
    command = controller.command(np.array([hub, 0.0, np.nan]))
    assert command.status is Status.MEASUREMENT
    rate = 0.015 / bench.problem.sample_time
    assert command.torque == pytest.approx(-bench.inertia / BRAKE_TIME * rate, rel=1e-9)


def test_the_safe_law_brakes_a_hub_that_whirls(
    bench: Bench, emitted: Callable[..., EmittedController]
) -> None:
    """It moves too far in a sample for the estimate to follow, but evenly: nobody brakes it otherwise."""
    kinds = (emitted("mpc-modes"), LinearMpc(bench.modes, bench.problem, bench.inertia))
    for controller in kinds:
        controller.reset()
        for k in range(PATIENCE + 4):
            command = controller.command(np.array([1.5 * JUMP * k, 0.0, np.nan]))
        assert command.status is Status.MEASUREMENT
        assert command.torque == pytest.approx(bench.problem.torque[0])
        jumped = controller.command(np.array([-20.0, 0.0, np.nan]))  # a jump tells nothing
        assert jumped.status is Status.MEASUREMENT
        assert jumped.torque == 0.0


@pytest.mark.parametrize("kind", ["mpc-links", "mpc-modes", "rti-zero", "rti"])
def test_torques_are_finite_and_within_bounds_whatever_is_measured(
    kind: str, bench: Bench, emitted: Callable[..., EmittedController]
) -> None:
    random = np.random.default_rng(17)
    count = 200 if kind != "rti" else 60
    measured = random.normal(size=(count, 3)) * 10.0 ** random.uniform(-3.0, 3.0, (count, 1))
    strange = random.choice([np.nan, np.inf, -np.inf, 1e308, 1e30, 0.0], size=measured.shape)
    measured = np.where(random.uniform(size=measured.shape) < 0.1, strange, measured)
    controller = emitted(kind)
    controller.reset()
    found = controller.run(measured)
    low, high = bench.problem.torque
    assert np.all(np.isfinite(found.torques))
    assert np.all((found.torques >= low) & (found.torques <= high))
    assert found.iterations.max() <= iteration_limit(bench.problem)
    assert len(set(found.statuses)) > 1  # some of it cannot be used, and it says so
    assert Status.MISSING not in found.statuses


@pytest.mark.parametrize("kind", ["mpc-modes", "rti-zero", "rti"])
def test_prepared_or_not_torques_are_the_same(
    kind: str, emitted: Callable[..., EmittedController], recorded: Callable[..., object]
) -> None:
    """To the last bit, with sensors that come and go, and one that lies for long enough to start anew."""
    random, controller = np.random.default_rng(23), emitted(kind)
    measured = np.tile(recorded("mpc-modes", 60).measured, (1 if kind == "rti" else 3, 1))
    measured[20:28, 0] += 0.5
    valid = random.random(measured.shape) < 0.9
    runs = []
    for prepare in (True, False):
        controller.reset()
        runs.append(controller.run(measured, valid, prepare))
    controller.reset()
    torques, statuses = [], []
    for seen, flags in zip(measured, valid, strict=True):
        for _ in range(random.integers(3)):
            controller.prepare()
        command = controller.command(seen, flags)
        torques.append(command.torque)
        statuses.append(command.status)
    assert np.array_equal(runs[0].torques, runs[1].torques)
    assert np.array_equal(runs[0].torques, np.array(torques))
    assert runs[0].statuses == runs[1].statuses == tuple(statuses)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} <= set(statuses)


def test_it_recovers_from_a_bad_measurement(bench: Bench, emitted: Callable[..., EmittedController]) -> None:
    controller = emitted("mpc-modes")
    controller.reset()
    plant = Plant(bench.scene, bench.problem, CONDITIONS[0])
    for sample in range(110):
        seen = plant.measured()
        if sample == 20:
            seen = np.full(3, np.nan)
        command = controller.command(seen)
        plant.advance(command.torque)
        assert (command.status is Status.OK) == (sample != 20)
    assert plant.angles()[0] == pytest.approx(bench.problem.reference, abs=5e-3)


def test_float32_controls_as_well(bench: Bench, emitted: Callable[..., EmittedController]) -> None:
    ends = {}
    for real in ("float64", "float32"):
        controller, plant = emitted("mpc-modes", real), Plant(bench.scene, bench.problem, CONDITIONS[0])
        controller.reset()
        for _ in range(90):
            plant.advance(controller.command(plant.measured()).torque)
        ends[real] = plant.angles()[0]
    assert ends["float32"] == pytest.approx(ends["float64"], abs=1e-3)


@pytest.mark.parametrize("real", ["float64", "float32"])
@pytest.mark.parametrize("kind", ["mpc-links", "rti-zero", "rti"])
def test_compilers_have_nothing_to_say(kind: str, real: str, bench: Bench, tmp_path: Path) -> None:
    name, files = emit_controller(bench, kind, real)
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    sources = [path for path in files if path.endswith(".c") and not path.startswith("daqp/")]
    done = subprocess.run(
        ["gcc", *WARNINGS, *sources], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.stderr == ""
    for path in set(sources) - {EXAMPLE}:
        assert not any(word in files[path] for word in ("malloc", "free(", "printf"))
    assert "daqp/LICENSE" in files
    assert any(path == f"{name}.h" for path in files)


def test_other_controllers_are_refused(bench: Bench) -> None:
    with pytest.raises(UserError, match="mpc-modes"):
        emit_controller(bench, "pd")


@pytest.mark.parametrize("kind", ["mpc-links", "mpc-modes"])
def test_the_first_sample_begins_where_it_ends(
    kind: str, bench: Bench, emitted: Callable[..., EmittedController], recorded: Callable[..., object]
) -> None:
    """What is active at the start is written into the C; Python's, which finds it, takes many iterations."""
    loop, controller = recorded(kind, 60), emitted(kind)
    for _ in range(2):  # also after a reset
        controller.reset()
        assert controller.run(loop.measured).iterations[0] <= 2
    cold = LinearMpc(getattr(bench, kind.removeprefix("mpc-")), bench.problem, bench.inertia)
    assert cold.command(loop.measured[0]).iterations >= 8
