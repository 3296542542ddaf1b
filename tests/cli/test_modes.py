"""`tmm-gen modes`: tables, JSON, pictures; and what it refuses."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import main

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS2 = str(SCENES / "thesis2.toml")

ARM = """
name = "droop"
title = "Drooping arm"
[model]
kind = "planar"
gravity = {gravity}
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = 2.0
mass_per_length = 0.5
links = 6
damping_time = 0.001
[[input]]
name = "push"
at = "tip"
acts = "force_y"
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Run in an empty folder with two arms, one with gravity."""
    monkeypatch.chdir(tmp_path)
    for name, gravity in (("straight", 0.0), ("droop", 9.81)):
        (tmp_path / f"{name}.toml").write_text(ARM.format(gravity=gravity))
    return tmp_path


def succeed(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["modes", *words]) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    return shown.out


def refuse(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["modes", *words]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "Traceback" not in shown.err
    return shown.err


def test_the_thesis_sample(capsys: pytest.CaptureFixture[str]) -> None:
    """Two equal stations: w^2 = (3 -+ sqrt 5)/2 k/I."""
    found = json.loads(succeed(THESIS2, "--json", capsys=capsys))
    exact = np.sqrt((3 + np.array([-1, 1]) * np.sqrt(5)) / 2 * 4)
    assert [row["angular_frequency"] for row in found["rows"]] == pytest.approx(exact)
    assert [row["damping_ratio"] for row in found["rows"]] == pytest.approx(5 * exact / 40)
    assert found["stable"] is True
    assert "exact_hz" not in found["rows"][0]
    assert "--plot draws" in succeed(THESIS2, capsys=capsys)


def test_an_arm_beside_the_continuous_beam(capsys: pytest.CaptureFixture[str]) -> None:
    found = json.loads(succeed("straight.toml", "--json", "--count", "3", capsys=capsys))
    rows = found["rows"]
    assert len(rows) == 3
    beta = np.array([1.875104069, 4.694091133, 7.854757438])
    assert [row["exact_angular_frequency"] for row in rows] == pytest.approx(beta**2 * 2.0, rel=1e-8)
    for row in rows:
        assert row["frequency_hz"] / row["exact_hz"] - 1 == pytest.approx(row["error"])
        assert row["straight_hz"] == pytest.approx(row["frequency_hz"])
        assert row["exact_damping_ratio"] == pytest.approx(0.0005 * row["exact_angular_frequency"])
        assert -0.1 < row["error"] < 0
    assert "continuous beam (Hz)" in succeed("straight.toml", capsys=capsys)


def test_a_drooping_arm(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shown = succeed("droop.toml", "--plot", capsys=capsys)
    assert "about the static equilibrium: the last link rests at -" in shown
    assert "straight, weightless (Hz)" in shown
    assert (folder / "droop-modes.png").read_bytes().startswith(b"\x89PNG")
    found = json.loads(succeed("droop.toml", "--json", capsys=capsys))
    assert found["rest_angles"][-1] < -0.3
    pushed = json.loads(succeed("droop.toml", "--json", "--input", "push=2", capsys=capsys))
    assert pushed["rest_angles"][-1] > found["rest_angles"][-1]


@pytest.mark.parametrize("scene", [THESIS2, "straight.toml"])
def test_pictures_are_the_same_twice(scene: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("one.svg", "other.svg"):
        assert f"wrote {name}" in succeed(scene, "--plot", name, capsys=capsys)
    assert (folder / "one.svg").read_bytes() == (folder / "other.svg").read_bytes()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nothing.toml"], "no such file"),
        ([THESIS2, "--input", "tip_torque=1"], "a chain is linear"),
        (["droop.toml", "--input", "pull=1"], "inputs are push"),
        (["droop.toml", "--input", "push=hard"], "'hard' is not a number"),
        ([THESIS2, "--plot", "modes.txt"], "must end in .png"),
        ([THESIS2, "--count", "0"], "count"),
    ],
)
def test_it_refuses(words: list[str], said: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = sorted(path.name for path in folder.iterdir())
    assert said in refuse(*words, capsys=capsys)
    assert sorted(path.name for path in folder.iterdir()) == before


def test_it_does_not_write_over_a_folder(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "taken.png").mkdir()
    assert "is a directory" in refuse(THESIS2, "--plot", "taken.png", capsys=capsys)


def test_a_hub_that_a_damper_holds(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its modes are in order, and those that damping makes have no mode of the undamped continuous beam beside them."""
    text = ARM.format(gravity=0.0).replace(
        'kind = "clamp"', 'kind = "motor"\ninertia = 0.01\ndamping = 300.0'
    )
    (folder / "held.toml").write_text(text)
    shown = json.loads(succeed("held.toml", "--count", "5", "--plot", "held.png", "--json", capsys=capsys))
    rows = shown["rows"]
    assert rows[0]["motion"] == "turns freely"
    assert all(a["frequency_hz"] < b["frequency_hz"] for a, b in itertools.pairwise(rows))
    mixed = [row for row in rows if row["exact_hz"] is None]
    assert mixed[0] == rows[1]
    assert all(row["error_percent"] is None and row["straight_hz"] is None for row in mixed)
    assert (folder / "held.png").stat().st_size > 10_000
    clamped = json.loads(succeed("straight.toml", "--count", "4", "--json", capsys=capsys))["rows"]
    for held, still in zip(rows[1:], clamped, strict=True):
        assert held["frequency_hz"] == pytest.approx(still["frequency_hz"], rel=1e-4)
