"""What is in a unit's file: a valid description, sources that compile by themselves, no date and no path."""

from __future__ import annotations

import io
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.build import build_platform_binary
from fmpy.validation import validate_fmu

from tmm_gen.errors import UserError
from tmm_gen.export.fmu import FmiVersion, fmu
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import kernel_names

pytestmark = [pytest.mark.compiler, pytest.mark.xdist_group("fmu")]  # units are exported once

WARNINGS = [
    "-pedantic",
    "-Wall",
    "-Wextra",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Wfloat-equal",
    "-Wshadow",
]


@pytest.mark.parametrize("version", [2, 3])
def test_fmpy_finds_nothing_wrong(
    version: FmiVersion, servo: Scene, unit_of: Any, scene_named: Any, tmp_path: Path
) -> None:
    for scene in (scene_named("thesis10"), scene_named("arm10"), servo):
        path = unit_of(scene, version)
        assert validate_fmu(str(path)) == []
        described = fmpy.read_model_description(str(path))
        assert described.coSimulation.canGetAndSetFMUstate
        assert float(described.defaultExperiment.stepSize) == scene.integrator.step
        units = {v.name: v.unit for v in described.modelVariables}
        assert {
            name: units[name] for name in ("time", "parameters.mass", "parameters.inertia") if name in units
        } == (
            {"time": "s", "parameters.inertia": "kg m^2"}
            | ({"parameters.mass": "kg"} if scene.model.kind == "planar" else {})
        )
        inputs = [v.name for v in described.modelVariables if v.causality == "input"]
        assert inputs == [name for item in scene.inputs for name in kernel_names(item)]


def test_validation_can_fail(unit_of: Any, scene_named: Any, tmp_path: Path) -> None:
    spoilt = tmp_path / "spoilt.fmu"
    with zipfile.ZipFile(unit_of(scene_named("thesis10"), 2)) as good, zipfile.ZipFile(spoilt, "w") as bad:
        for entry in good.infolist():
            content = good.read(entry)
            if entry.filename == "modelDescription.xml":
                content = content.replace(b'unit="rad/s"', b'unit="furlong"')
            bad.writestr(entry, content)
    assert validate_fmu(str(spoilt))


@pytest.mark.parametrize("version", [2, 3])
def test_the_same_scene_gives_the_same_bytes(version: FmiVersion, unit_of: Any, scene_named: Any) -> None:
    scene = scene_named("thesis10")
    first = unit_of(scene, version).read_bytes()
    assert fmu(scene, version) == first
    with zipfile.ZipFile(io.BytesIO(first)) as packed:
        for entry in packed.infolist():
            assert entry.date_time == (1980, 1, 1, 0, 0, 0)
            assert str(Path(__file__).parents[3]).encode() not in packed.read(entry)
        licence = packed.read("documentation/licenses/fmi-headers.txt").decode()
    assert "Redistribution and use in source and binary forms" in licence
    other = fmpy.read_model_description(io.BytesIO(fmu(scene.replace(**{"integrator.step": 0.02}), version)))
    assert other.guid != fmpy.read_model_description(str(unit_of(scene, version))).guid


@pytest.mark.parametrize("real", ["float64", "float32"])
@pytest.mark.parametrize("version", [2, 3])
def test_the_sources_compile_without_a_warning(
    version: FmiVersion, real: str, servo: Scene, unit_of: Any, tmp_path: Path
) -> None:
    fmpy.extract(str(unit_of(servo.replace(**{"emit.real": real}), version)), str(tmp_path))
    sources = sorted(map(str, (tmp_path / "sources").glob("*.c")))
    command = ["gcc", "-std=c99", "-Werror", *WARNINGS, "-fPIC", "-shared", "-o", str(tmp_path / "unit.so")]
    done = subprocess.run([*command, *sources, "-lm"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("version", [2, 3])
def test_fmpy_builds_the_sources_and_the_result_is_the_same(
    version: FmiVersion, unit_of: Any, scene_named: Any, need_tool: Any, tmp_path: Path
) -> None:
    need_tool("cmake")  # fmpy calls it
    path = unit_of(scene_named("thesis10"), version)
    fmpy.extract(str(path), str(tmp_path))
    (binary,) = (p for p in (tmp_path / "binaries").rglob("*") if p.is_file())
    shipped = binary.read_bytes()
    binary.unlink()
    (tmp_path / "build").mkdir()
    build_platform_binary(tmp_path, build_dir=tmp_path / "build", configuration="Release")
    assert binary.read_bytes() != shipped  # it is another one
    one, other = (fmpy.simulate_fmu(str(each), start_values={"tip_torque": 1.0}) for each in (path, tmp_path))
    np.testing.assert_array_equal(one, other)
    assert one["tip"][-1] != 0.0


def test_only_functions_of_the_standard_are_visible(unit_of: Any, scene_named: Any, tmp_path: Path) -> None:
    fmpy.extract(str(unit_of(scene_named("thesis10"), 2)), str(tmp_path))
    (binary,) = (p for p in (tmp_path / "binaries").rglob("*") if p.is_file())
    listed = subprocess.run(
        ["nm", "-D", "--defined-only", binary], capture_output=True, text=True, check=True
    )
    names = {line.split()[-1] for line in listed.stdout.splitlines() if " T " in line}
    assert "fmi2DoStep" in names
    assert all(name.startswith("fmi2") for name in names)


def test_without_fmpy_the_user_is_told(scene_named: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "fmpy", None)
    with pytest.raises(UserError, match=r"needs FMPy, which is not installed: .*pip install"):
        fmu(scene_named("thesis10"))
