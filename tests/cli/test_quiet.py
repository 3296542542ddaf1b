"""No warning of a library reaches the terminal, of worker processes neither: standard error stays empty."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.compiler

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS = str(SCENES / "thesis2.toml")
STEPS = "2,0.5,0.1,0.05,1e-3"  # some diverge, some have single precision's floor

COMMANDS = {
    "trade where little finishes": [
        "trade", THESIS, "--integrators", "zhai", "--steps", "2,0.001", "--until", "4", "--rounds", "1",
        "--report", "r.html", "--plot", "p.png",
    ],
    "trade": [
        "trade", THESIS, "--integrators", "newmark,zhai,fox_euler", "--steps", STEPS, "--until", "4",
        "--reals", "float64,float32", "--rounds", "2", "--workers", "1", "--store", "s.sqlite",
        "--report", "r.html", "--plot", "p.png",
    ],
    "tune": ["tune", THESIS, "--integrators", "newmark,zhai", "--max-error", "1e-3", "--max-time", "1s",
             "--until", "4", "--rounds", "1"],
    "calibrate": ["calibrate", THESIS, "made.csv", "--input", "tip_torque=1"],
    "errata": ["errata"],
}  # fmt: skip


@pytest.mark.parametrize("name", COMMANDS)
def test_standard_error_is_empty(name: str, tmp_path: Path) -> None:
    quiet = {
        **os.environ,
        "PYTHONWARNINGS": "default,ignore::DeprecationWarning,ignore::PendingDeprecationWarning",
    }
    tool = [sys.executable, "-m", "tmm_gen"]
    if name == "calibrate":  # without noise: nothing is left
        made = ["run", THESIS, "--input", "tip_torque=1", "--until", "3", "--csv", "made.csv"]
        subprocess.run([*tool, *made], cwd=tmp_path, capture_output=True, check=True)
    done = subprocess.run(
        [*tool, *COMMANDS[name]], cwd=tmp_path, env=quiet, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    warned = [
        line for line in done.stderr.splitlines() if not line.endswith(" s so far")
    ]  # on a slow machine
    assert not warned
