"""`tmm-gen rest` on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tmm_gen.cli import main

ELBOW = str(Path(__file__).resolve().parents[2] / "scenes" / "elbow.toml")
THESIS = str(Path(__file__).resolve().parents[2] / "scenes" / "thesis2.toml")


def test_the_table_says_what_holds_and_what_does_not(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rest", ELBOW]) == 0
    shown = capsys.readouterr()
    assert "4 equilibria" in shown.out
    assert shown.out.count("falls over") == 3
    assert "stable, reached from the start" in shown.out
    assert "shoulder, elbow turn freely: motors hold no torque but that of --input" in shown.out
    assert "e-1" not in shown.out  # rounding is none of the reader's business
    assert shown.err == ""


def test_json_has_every_node_angle_and_torque(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rest", ELBOW, "--json", "--input", "shoulder_torque=0.02"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["inputs"] == [{"name": "shoulder_torque", "value": 0.02}]
    assert shown["free_joints"] == ["shoulder", "elbow"]
    first = shown["rows"][0]
    assert first["stable"]
    assert first["from_start"]
    assert [joint["name"] for joint in first["joints"][:2]] == ["shoulder", "joint 2"]
    assert first["joints"][0]["torque"] == pytest.approx(100 * 0.02)
    assert len(first["nodes"]) == len(first["angles"]) + 1
    parts = {part["name"]: part for part in first["parts"]}
    assert [parts["payload"]["x"], parts["payload"]["y"]] == first["nodes"][-1]
    assert parts["upper"]["angle"] == first["angles"][5]


def test_the_outer_side_of_an_elastic_gear_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["rest", ELBOW, "--json", "--input", "shoulder_torque=0.02"]
    assert main(arguments) == 0
    rigid = json.loads(capsys.readouterr().out)["rows"][0]["joints"]
    assert main([*arguments, "--set", "motor.shoulder.stiffness=4000.0"]) == 0
    elastic = json.loads(capsys.readouterr().out)["rows"][0]["joints"]
    assert [joint["name"] for joint in elastic].count("shoulder") == 1
    assert len(elastic) == len(rigid)
    for one, other in zip(elastic, rigid, strict=True):  # the gear gives way under the torque, the arm stays
        assert one["angle"] == pytest.approx(other["angle"], abs=1e-9)
        assert one["torque"] == pytest.approx(other["torque"], abs=1e-9)


def test_keys_are_changed_and_pictures_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["rest", ELBOW, "--set", "model.gravity=0", "--plot", "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["files"] == ["elbow-rest.png"]
    assert Path("elbow-rest.png").read_bytes().startswith(b"\x89PNG")
    assert [(row["state"], row["idle"]) for row in shown["rows"]] == [
        ("stays anywhere, reached from the start", 2)
    ]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([THESIS], "a chain has no weight"),
        ([ELBOW, "--input", "shoulder_torque=1"], "no static equilibrium"),
        ([ELBOW, "--input", "wrist=1"], "inputs are shoulder_torque, elbow_torque"),
    ],
)
def test_what_has_no_rest_is_one_line(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["rest", *arguments]) == 2
    shown = capsys.readouterr()
    assert said in shown.err
    assert shown.err.count("\n") == 1
