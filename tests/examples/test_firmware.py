"""The firmware example builds, runs on the emulated board, and computes what the NumPy and the native kernel do."""

from __future__ import annotations

import csv
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.emit.c import free_scene
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import load_scene

pytestmark = [pytest.mark.compiler, pytest.mark.xdist_group("firmware")]  # it is built once

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "firmware"


def cmake(program: str, *words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def tools(need_tool: Callable[[str, str], str]) -> dict[str, str]:
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi picolibc-arm-none-eabi")
    need_tool("qemu-system-arm", "qemu-system-arm")
    need_tool("make", "make")
    return {name: need_tool(name, "cmake") for name in ("cmake", "ctest")}


@pytest.fixture(scope="module")
def built(tools: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Configure a copy of the folder as the README says, somewhere else: it depends on nothing around it."""
    here = tmp_path_factory.mktemp("project")
    shutil.copytree(FOLDER, here / "firmware", ignore=shutil.ignore_patterns("__pycache__"))
    build = here / "build"
    done = cmake(
        tools["cmake"],
        *("-S", here / "firmware", "-B", build, "-D", "CMAKE_TOOLCHAIN_FILE=cmake/arm-none-eabi.cmake"),
        *("-D", f"Python3_EXECUTABLE={sys.executable}"),
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return build


@pytest.fixture(scope="module")
def compared(built: Path, tools: dict[str, str]) -> str:
    """Build, run and compare as the README says."""
    done = cmake(tools["cmake"], "--build", built, "--target", "compare")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "warning" not in done.stderr
    return done.stdout


def table(path: Path) -> dict[str, np.ndarray]:
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def test_single_precision_stays_with_the_numpy_kernel(compared: str) -> None:
    assert "300 messages of 3000 samples" in compared
    hub, *tip = (float(x) for x in re.findall(r"differs from NumPy by at most (\S+)", compared))
    assert 0.0 < hub < 1e-6  # zero would be double precision
    assert len(tip) == 2
    assert 0.0 < max(tip) < 1e-5


def test_the_observer_knows_what_the_model_alone_does_not(compared: str) -> None:
    """The tip, which the encoder does not see, is held against the arm that was recorded."""
    pattern = r": encoder less model (\S+) mrad RMS, tip (\S+) mm RMS off the true one, (\S+) mm at most"
    alone, observer = ([float(x) for x in found] for found in re.findall(pattern, compared))
    assert alone[0] > 40.0
    assert observer[0] < 0.2
    assert observer[1] < 0.25 * alone[1]
    assert observer[2] < 0.25 * alone[2]


def test_no_interrupt_is_missed(compared: str, built: Path) -> None:
    last = (built / "telemetry.csv").read_text().splitlines()[-1]
    found = re.fullmatch(
        r"# 3000 samples, 0 overruns, 0 messages dropped, longest interrupt (\d+) of 25000 ticks, status 0",
        last,
    )
    assert found is not None, last
    assert 0 < int(found[1]) < 2500


def test_the_board_computes_the_bits_of_the_pc(compared: str, built: Path) -> None:
    scene = free_scene(load_scene(FOLDER / "beam5.toml"))
    kernel = compile_kernel(build_program(scene), scene)
    kernel.prepare()
    kernel.initialise()
    recording, telemetry = table(FOLDER / "recording.csv"), table(built / "telemetry.csv")
    expected: dict[str, list[float]] = {name: [] for name in ("hub", "tip_x", "tip_y")}
    single, gain = np.float32, table(FOLDER / "gain.csv")
    for torque, angle in zip(recording["hub_torque"], recording["hub_angle"], strict=True):
        kernel.step({"hub_torque": float(torque)})
        residual = single(angle) - single(kernel.state["hub_angle"])
        kernel.state = {
            name: single(value)
            + (single(rows[0]) if name.startswith("hub") else rows[1:].astype(single)) * residual
            for name, value in kernel.state.items()
            for rows in [gain[name.removeprefix("hub_")]]
        }
        for name, value in kernel.output().items():
            expected[name].append(value)
    samples = telemetry["sample"].astype(int) - 1
    for name, values in expected.items():
        ours = np.array(values, dtype=np.float32)[samples]
        np.testing.assert_array_equal(telemetry[name].astype(np.float32), ours)  # nine digits tell all bits


def test_a_comparison_that_fails_says_so(compared: str, built: Path, tmp_path: Path) -> None:
    lines = (built / "telemetry.csv").read_text().splitlines()
    cells = lines[50].split(",")
    cells[1] = repr(float(cells[1]) + 1e-5)
    spoilt = tmp_path / "telemetry.csv"
    spoilt.write_text("\n".join([*lines[:50], ",".join(cells), *lines[51:]]))
    words = [sys.executable, FOLDER / "compare.py", spoilt, FOLDER / "recording.csv", FOLDER / "gain.csv"]
    assert subprocess.run(words, capture_output=True, check=False).returncode == 1


def test_the_generated_package_is_what_the_scene_gives(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(FOLDER)
    assert main(["build", "beam5.toml", "--out", "generated", "--check"]) == 0, capsys.readouterr().out


def test_the_recording_is_what_its_script_makes(tmp_path: Path) -> None:
    made = tmp_path / "recording.csv"
    subprocess.run([sys.executable, FOLDER / "record.py", made], check=True)
    again, committed = table(made), table(FOLDER / "recording.csv")
    np.testing.assert_array_equal(again["hub_torque"], committed["hub_torque"])
    # a sine of another C library may shift an angle across the edge between two counts of the encoder
    np.testing.assert_allclose(again["hub_angle"], committed["hub_angle"], atol=1.01 * 2.0 * np.pi / 2**16)
    for axis in ("tip_x", "tip_y"):
        np.testing.assert_allclose(again[axis], committed[axis], atol=1e-5)


def test_the_gain_is_what_its_script_computes(tmp_path: Path) -> None:
    made = tmp_path / "gain.csv"
    subprocess.run([sys.executable, FOLDER / "gain.py", made], check=True)
    again, committed = table(made), table(FOLDER / "gain.csv")
    for part, values in committed.items():
        np.testing.assert_allclose(again[part], values, rtol=1e-4, atol=1e-5 * np.max(np.abs(values)))


def test_a_kernels_own_test_passes_on_the_board(tools: dict[str, str], tmp_path: Path) -> None:
    source = FOLDER / "generated" / "beam5" / "c"
    toolchain = FOLDER / "cmake" / "arm-none-eabi.cmake"
    done = cmake(
        tools["cmake"], "-S", source, "-B", tmp_path / "build", "-D", f"CMAKE_TOOLCHAIN_FILE={toolchain}"
    )
    assert done.returncode == 0, done.stdout + done.stderr
    done = cmake(tools["cmake"], "--build", tmp_path / "build")
    assert done.returncode == 0, done.stdout + done.stderr
    done = cmake(tools["ctest"], "--test-dir", tmp_path / "build", "--output-on-failure")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100% tests passed" in done.stdout
