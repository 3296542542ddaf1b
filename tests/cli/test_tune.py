"""`tmm-gen tune`: writes a scene that does what it claims, or says why there is none."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import load_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS2 = str(SCENES / "thesis2.toml")
QUICK = ("--integrators", "newmark,sdirk4", "--until", "10", "--rounds", "2")


def test_tuned_scene_is_written_and_says_why(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    target = tmp_path / "tuned.toml"
    words = [
        "tune",
        THESIS2,
        "--max-error",
        "1e-5",
        "--max-time",
        "1ms",
        *QUICK,
        "--out",
        str(target),
        "--json",
    ]
    assert main(words) == 0
    found = json.loads(capsys.readouterr().out)
    chosen = found["chosen"]
    tuned = load_scene(target)
    assert found["found"] is True
    assert (tuned.integrator.name, tuned.integrator.step) == (chosen["integrator"], chosen["step"])
    assert 0.0 < chosen["error"] <= 1e-5
    assert chosen["error_in_unit"] == pytest.approx(chosen["error"] * found["travel"])
    assert 0.0 < chosen["seconds_per_simulated_second"] <= 1e-3
    assert target.read_text().startswith("# Tuned by `tmm-gen tune`")
    original = Path(THESIS2).read_text()
    comments = [line for line in original.splitlines() if line.startswith("#")]
    assert all(line in target.read_text() for line in comments)


def test_table_explains(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tune", THESIS2, "--max-error", "1mrad", "--max-time", "1", *QUICK]) == 0
    out = capsys.readouterr().out
    for part in ("run afresh", "The scene as it was (newmark, 0.01 s)", "--out FILE writes the tuned scene"):
        assert part in out


def test_impossible_bounds_end_with_one(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    target = tmp_path / "tuned.toml"
    words = ["tune", THESIS2, "--max-error", "1e-5", "--max-time", "1e-3ns", *QUICK, "--out", str(target)]
    assert main(words) == 1
    out = capsys.readouterr().out
    assert "Nothing keeps both" in out
    assert "Nearest: " in out
    assert not target.exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--max-error", "small", "--max-time", "1"), "--max-error small: is no positive number"),
        (("--max-error", "1mm", "--max-time", "1"), "the output is in rad"),
        (("--max-error", "1e-3", "--max-time", "1 week"), "unknown unit 'week'"),
        (("--max-error", "1e-3", "--max-time", "1", "--links", "auto"), "takes a [beam]"),
        (("--max-error", "1e-3", "--max-time", "1", "--links", "few"), "neither auto nor numbers of links"),
        (
            ("--max-error", "1e-3", "--max-time", "1", "--target", "z80"),
            "no such microcontroller; there are cortex",
        ),
        (
            ("--max-error", "1e-3", "--max-time", "1", "--tolerances", "--target", "cortex-m7"),
            "a controller's are all alike. Leave out --target, or --tolerances.",
        ),
        (("--max-time", "1"), "Missing option '--max-error'"),
    ],
)
def test_bad_usage(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], message: str) -> None:
    assert main(["tune", THESIS2, *words]) == 2
    assert message in " ".join(capsys.readouterr().err.split())
