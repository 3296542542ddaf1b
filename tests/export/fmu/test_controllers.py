"""Units of controllers: the same torques as the C called directly, references that change, and what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.export.fmu import FmiVersion
from tmm_gen.export.fmu.headers import fmi_headers
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.native import STATUSES, EmittedController
from tmm_gen.onboard.unit import controller_content, controller_unit
from tmm_gen.scene import load_scene

SCENES = Path(__file__).resolve().parents[3] / "scenes"
T = 0.02
NAMES = ("shoulder", "elbow")
UNITS: list[tuple[str, FmiVersion]] = [("rti-zero", 3), ("mpc-modes", 2)]
VERSIONS: tuple[FmiVersion, ...] = (2, 3)

pytestmark = pytest.mark.compiler


@pytest.fixture(scope="module")
def bench() -> Bench:
    """Two motors, two springs in each beam."""
    changes = {"beam.upper.links": 2, "beam.forearm.links": 2, "control.horizon": 12, "control.substeps": 2}
    return Bench.of(load_scene(SCENES / "elbow.toml").replace(**changes))


@pytest.fixture(scope="module")
def file_of(bench: Bench, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, FmiVersion], Path]:
    """Units of its controllers, each made once."""
    known: dict[str, Path] = {}

    def of(controller: str, version: FmiVersion) -> Path:
        if controller not in known:
            path = tmp_path_factory.mktemp(controller) / "unit.fmu"
            path.write_bytes(controller_unit(bench, controller, version))
            known[controller] = path
        return known[controller]

    return of


@pytest.fixture(scope="module")
def direct(bench: Bench) -> Callable[[str], EmittedController]:
    """The C itself, compiled as units are."""

    def of(controller: str) -> EmittedController:
        name, files = emit_controller(bench, controller)
        sensors = present_sensors(bench.problem)
        return EmittedController(name, files, sensors, flags=FLAGS, motors=bench.problem.count)

    return of


def set_all(unit: Any, group: str, values: Any) -> None:
    for name, value in zip(NAMES, values, strict=True):
        unit.set(f"{group}.{name}", value)


def torques(unit: Any) -> np.ndarray[Any, Any]:
    return np.array([unit.get(f"torque.{name}") for name in NAMES])


@pytest.mark.parametrize(("controller", "version"), UNITS)
def test_it_reaches_references_that_change(
    controller: str,
    version: FmiVersion,
    bench: Bench,
    file_of: Callable[[str, FmiVersion], Path],
    opened: Callable[[Path], Any],
    direct: Callable[[str], EmittedController],
) -> None:
    """On a finer arm, told of another reference, bounds and payload on the way; bits are those of the C."""
    unit, same = opened(file_of(controller, version)), direct(controller)
    plant = Plant(bench.scene, bench.problem, CONDITIONS[0])
    unit.begin()
    start, reached = bench.problem.reference, np.zeros(2)
    assert [unit.get(f"reference.{name}") for name in NAMES] == list(start)
    other = start + np.array([-0.3, 0.25])
    parts = 1 if version == 2 else 4  # communication steps in a sample
    for k in range(150):
        if k == 60:
            set_all(unit, "reference", other)
            assert same.aim(other) is STATUSES[0]
        if k == 70:
            lower, upper = (0.9 * each for each in bench.problem.torque)
            set_all(unit, "lower", lower)
            set_all(unit, "upper", upper)
            assert same.limit(lower, upper) is STATUSES[0]
        if k == 75:
            unit.set("payload", 0.31)
            assert same.carry(0.31) is STATUSES[0]
        measured = plant.measured()
        set_all(unit, "encoder", measured[:2])
        for part in range(parts):
            unit.step(k * T + part * T / parts, T / parts)
            if part == 0:
                found = torques(unit)
            assert np.array_equal(torques(unit), found)
            set_all(unit, "encoder", [np.nan, 9.0])  # looked at where a sample is due only
        command = same.command(measured)
        assert np.array_equal(found, command.torque)
        assert STATUSES[int(unit.get("status"))] is command.status
        assert unit.get("answer") == 0.0
        plant.advance(found)
        if k == 59:
            reached = plant.measured()[:2]
    assert reached == pytest.approx(start, abs=0.03)
    assert plant.measured()[:2] == pytest.approx(other, abs=0.03)


def test_what_cannot_be_is_answered(
    file_of: Callable[[str, FmiVersion], Path], opened: Callable[[Path], Any], bench: Bench
) -> None:
    """A reference that motors cannot hold is refused, and taken once they can; sensors may show nothing."""
    unit = opened(file_of("mpc-modes", 2))
    unit.begin(start=1.0)
    set_all(unit, "encoder", bench.problem.start)
    unit.step(1.0, T)
    assert (unit.get("status"), unit.get("answer")) == (0.0, 0.0)
    low, high = bench.problem.torque
    set_all(unit, "reference", [0.7, -1.0])
    for group, values in (("lower", low), ("upper", high)):
        set_all(unit, group, 0.01 * values)
    unit.step(1.0 + T, T)
    assert STATUSES[int(unit.get("answer"))].name == "INFEASIBLE"
    assert np.all(np.abs(torques(unit)) <= 0.01 * high)
    set_all(unit, "lower", low)
    set_all(unit, "upper", high)
    set_all(unit, "encoder", [np.nan, np.nan])
    unit.step(1.0 + 2 * T, T)
    assert unit.get("answer") == 0.0
    assert STATUSES[int(unit.get("status"))].name == "MEASUREMENT"


def test_steps_and_numbers_that_are_refused(
    file_of: Callable[[str, FmiVersion], Path], opened: Callable[[Path], Any], bench: Bench
) -> None:
    """No step goes past a sample; a reference that is no number stops the unit; a saved state goes on as it was."""
    unit = opened(file_of("mpc-modes", 2))
    unit.begin()
    set_all(unit, "encoder", bench.problem.start)
    with pytest.raises(fmpy.fmi1.FMICallException):
        unit.step(0.0, 1.5 * T)
    assert "beyond the next sample" in unit.logged[-1]
    unit.step(0.0, 0.25 * T)
    with pytest.raises(fmpy.fmi1.FMICallException):
        unit.step(0.25 * T, T)
    unit.step(0.25 * T, 0.75 * T)
    with pytest.raises(fmpy.fmi1.FMICallException):
        unit.set("reference.elbow", np.nan)
    with pytest.raises(fmpy.fmi1.FMICallException):
        unit.step(T, T)
    assert "not a number" in unit.logged[-1]
    unit.set("reference.elbow", -1.0)
    saved = unit.unit.getFMUstate()
    unit.step(T, T)
    first = torques(unit)
    unit.unit.setFMUstate(saved)
    unit.step(T, T)
    assert np.array_equal(torques(unit), first)
    unit.unit.freeFMUstate(saved)


@pytest.mark.parametrize("real", ["float64", "float32"])
def test_sources_are_free_of_warnings(real: str, bench: Bench) -> None:
    """What answers the functions of FMI, in both number types and both versions."""
    chosen = Bench.of(bench.scene.replace(**{"emit.real": real}))
    content = controller_content(chosen, "mpc-modes")
    flags = ("-O1", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-Wshadow", "-Werror")
    for version in VERSIONS:
        sources = {**fmi_headers(version), **content.filled(version)[0]}
        own = {k: text for k, text in sources.items() if k.endswith(".h") or k.startswith("fmi-")}
        compile_library(own, flags=flags)


def test_by_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["export", str(SCENES / "elbow.toml"), "--to", "fmu", "--controller", "mpc-modes"]
    assert main([*words, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (facts["file"], facts["controller"], facts["step"]) == ("elbow_mpc_modes.fmu", "mpc-modes", T)
    described = fmpy.read_model_description("elbow_mpc_modes.fmu")
    units = {v.name: v.unit for v in described.modelVariables}
    assert (units["encoder.elbow"], units["reference.elbow"], units["torque.elbow"]) == ("rad", "rad", "N m")
    assert len(fmpy.simulate_fmu("elbow_mpc_modes.fmu", stop_time=0.2)) == 11


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["swing", "--to", "fmu", "--controller", "rti"], "[[motor]]"),
        (["elbow", "--to", "fmu", "--controller", "pd"], "rti-zero"),
        (["elbow", "--to", "mjcf", "--controller", "rti"], "--to fmu only"),
    ],
)
def test_refusals(words: list[str], what: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(SCENES / f"{words[0]}.toml"), *words[1:]]) == 2
    shown = capsys.readouterr().err
    assert what in shown
    assert "Traceback" not in shown
