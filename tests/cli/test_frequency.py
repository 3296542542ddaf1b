"""`tmm-gen frequency`: responses, files, and how few links a scene requires; and what it refuses."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import main

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS2 = str(SCENES / "thesis2.toml")
ELBOW = str(SCENES / "elbow.toml")
DRIVE = str(SCENES / "drivetrain.toml")

ARM = """
name = "arm"
title = "Arm"
[model]
kind = "planar"
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
    """Run in an empty folder with an arm."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.toml").write_text(ARM)
    return tmp_path


def succeed(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["frequency", *words]) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    return shown.out


def refuse(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["frequency", *words]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "Traceback" not in shown.err
    return shown.err


def thesis2_tip(s: complex) -> complex:
    """Tip angle over tip torque of two stations I = 5, k = 20, c = 5."""
    joint = 20 + 5 * s
    return (5 * s**2 + 2 * joint) / ((5 * s**2 + 2 * joint) * (5 * s**2 + joint) - joint**2)


def test_csv_of_the_thesis_sample(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--low", "0.01", "--high", "10", "--points", "50", "--csv", "deep/out.csv"]
    assert "wrote deep/out.csv" in succeed(THESIS2, *words, capsys=capsys)
    with (folder / "deep" / "out.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["frequency_hz", "tip_magnitude", "tip_phase_deg", "tip_real", "tip_imaginary"]
    values = np.array(rows, dtype=float)
    np.testing.assert_allclose(values[:, 0], np.geomspace(0.01, 10, 50))
    exact = np.array([thesis2_tip(2j * np.pi * hertz) for hertz in values[:, 0]])
    np.testing.assert_allclose(values[:, 3] + 1j * values[:, 4], exact, rtol=1e-12)
    np.testing.assert_allclose(values[:, 1], np.abs(exact), rtol=1e-12)
    np.testing.assert_allclose(values[:, 2], np.degrees(np.angle(exact)), rtol=1e-12)


def test_json_has_resonances_and_the_response(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--from", "load_torque", "--to", "encoder", "--points", "20", "--json"]
    found = json.loads(succeed(DRIVE, *words, capsys=capsys))
    assert (found["input"], found["output"], found["unit"]) == ("load_torque", "encoder", "rad per N m")
    assert len(found["frequency_hz"]) == len(found["response"][0]["magnitude"]) == 20
    assert found["rows"][0]["frequency_hz"] == pytest.approx(88.2, abs=0.1)
    assert all(row["magnitude"] > 0 for row in found["rows"])


def test_the_picture_shows_the_beam_too(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("one.svg", "other.svg"):
        assert f"wrote {name}" in succeed("arm.toml", "--plot", name, capsys=capsys)
    assert (folder / "one.svg").read_bytes() == (folder / "other.svg").read_bytes()
    assert "wrote arm-frequency.png" in succeed("arm.toml", "--plot", capsys=capsys)
    assert (folder / "arm-frequency.png").read_bytes().startswith(b"\x89PNG")


def test_undamped_resonances_have_no_bound(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    (folder / "arm.toml").write_text(ARM.replace("damping_time = 0.001\n", ""))
    found = json.loads(succeed("arm.toml", "--json", "--points", "10", capsys=capsys))
    assert found["rows"][0]["magnitude_y"] is None
    assert "inf" in succeed("arm.toml", "--points", "10", capsys=capsys)


def test_how_few_links(capsys: pytest.CaptureFixture[str]) -> None:
    found = json.loads(succeed("arm.toml", "--links-for", "0.01", "--band", "20", "--json", capsys=capsys))
    assert found["links"] > found["links_now"]
    assert found["worst_error"] <= 0.01
    assert max(row["one_less_percent"] for row in found["rows"]) > 1.0
    shown = succeed("arm.toml", "--links-for", "0.01", "--band", "20", capsys=capsys)
    assert f"{found['links']} links keep every natural frequency up to 20 Hz within 1 %" in shown


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nothing.toml"], "no such file"),
        ([THESIS2, "--from", "wind"], "--from wind: no such name; choose from tip_torque"),
        ([THESIS2, "--to", "heat"], "--to heat: no such name; choose from tip, base_torque"),
        ([THESIS2, "--low", "3", "--high", "2"], "must be less than"),
        ([THESIS2, "--low", "-1"], "positive"),
        ([THESIS2, "--low", "1e9"], "is empty"),
        ([THESIS2, "--links-for", "0.01"], "belong together"),
        ([THESIS2, "--links-for", "0.01", "--band", "5"], "has no [beam]"),
        ([ELBOW, "--links-for", "0.01", "--band", "5"], "is an arm by parts"),
        (["arm.toml", "--links-for", "1e-12", "--band", "5"], "are not enough"),
        ([THESIS2, "--csv", "."], "is a directory"),
    ],
)
def test_it_refuses(words: list[str], said: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert said in refuse(*words, capsys=capsys)
    assert [path.name for path in folder.iterdir()] == ["arm.toml"]


def test_a_scene_without_inputs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = ARM.replace('[[input]]\nname = "push"\nat = "tip"\nacts = "force_y"\n', "")
    (folder / "arm.toml").write_text(text)
    assert "arm.toml: has no [[input]]" in refuse("arm.toml", capsys=capsys)
