"""`tmm-gen check`: a table that explains itself, JSON for scripts, and the exit code."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tmm_gen.cli import main

SCENES = Path(__file__).resolve().parents[2] / "scenes"

pytestmark = pytest.mark.compiler


@pytest.mark.parametrize("scene", ["thesis2", "thesis10", "drivetrain", "hundred"])
def test_every_example_scene_holds(scene: str, capsys: pytest.CaptureFixture[str]) -> None:
    code = main(["check", str(SCENES / f"{scene}.toml"), "--json"])
    found = json.loads(capsys.readouterr().out)
    assert (code, found["passed"], found["scene"]) == (0, True, scene)
    assert found["ns_per_step"] > 0.0
    assert {row["check"] for row in found["rows"]} >= {"numpy_against_c", "numpy_against_casadi"}
    for row in found["rows"]:
        assert row["value"] <= row["bound"]
        assert row["meaning"]


def test_the_table_explains_each_row(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["check", str(SCENES / "thesis2.toml")]) == 0
    shown = capsys.readouterr().out
    for words in (
        "compiles without a warning and passes its own test",
        "after one step from 20 random states",
        "RMS error of base_torque over 6 s under unit inputs",
        "derived: step^2",
        "ns in C on this machine",
        "everything holds",
    ):
        assert words in shown


def test_a_step_too_coarse_exits_with_1(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (SCENES / "thesis2.toml").read_text()
    scene = tmp_path / "coarse.toml"
    scene.write_text(text.replace("step = 0.01 ", "step = 1.5 "))
    assert main(["check", str(scene)]) == 1
    shown = capsys.readouterr()
    assert "NOT everything holds" in shown.out
    assert shown.err == ""


def test_without_a_compiler(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert main(["check", str(SCENES / "thesis2.toml")]) == 2
    assert "the C compiler 'gcc' was not found; install one" in capsys.readouterr().err


def test_the_unsafe_product_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (SCENES / "thesis10.toml").read_text()
    scene = tmp_path / "lossy.toml"
    scene.write_text(text.replace('kind = "chain"', 'kind = "chain"\nsweep = "product"'))
    assert main(["check", str(scene)]) == 2
    said = capsys.readouterr().err
    line = 1 + scene.read_text().splitlines().index('sweep = "product"')
    assert (
        f"{scene}:{line}: model.sweep: the plain product keeps 6 digits in float64 up to 5 stations" in said
    )
