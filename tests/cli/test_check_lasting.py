"""`tmm-gen check` of motions that break off or err too much: one line says why, and what it says to try works."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import pytest

from tmm_gen.cli import main

SCENES = Path(__file__).resolve().parents[2] / "scenes"

pytestmark = pytest.mark.compiler

TINY = """
name = "tiny"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "motor"
inertia = 1e-6
[[joint]]
stiffness = 0.01
repeat = 2
[[link]]
mass = 0.001
length = 0.02
inertia = 1e-8
repeat = 2
[[input]]
name = "hub_torque"
at = "base"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


def explained(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """Return the one line between the table and the verdict of a check that does not hold."""
    assert main(["check", *words]) == 1
    shown = capsys.readouterr()
    assert shown.err == ""
    why, verdict = shown.out.rstrip().splitlines()[-2:]
    assert verdict.startswith("NOT everything holds")
    return why


@pytest.mark.parametrize(
    ("name", "changes", "cause"),
    [
        ("thesis2", ["integrator.name=zhai", "integrator.step=1.5"], r"beyond the limit [0-9.]+ of zhai"),
        ("thesis2", ["integrator.step=1.5"], r"Cause: a step of 1\.5 s is too coarse for this motion\."),
        (
            "arm2",
            ["integrator.step=0.5"],
            r"at t = 0\.5 s hub_pivot must be positive",
        ),
    ],
)
def test_the_step_it_names_lets_everything_hold(
    name: str, changes: list[str], cause: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [str(SCENES / f"{name}.toml"), *(word for change in changes for word in ("--set", change))]
    why = explained(words, capsys)
    assert re.search(cause, why), why
    found = re.search(r"With (--step \S+) everything holds\.$", why)
    assert found is not None, why
    assert main(["check", *words, *shlex.split(found[1])]) == 0


def test_an_arm_for_which_1_is_far_too_much(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "tiny.toml"
    scene.write_text(TINY)
    why = explained([str(scene)], capsys)
    found = re.search(r"with (--input hub_torque=\S+) everything holds\.$", why)
    assert found is not None, why
    assert main(["check", str(scene), *shlex.split(found[1])]) == 0
    assert "under the inputs given" in capsys.readouterr().out


def test_json_has_the_same_line(capsys: pytest.CaptureFixture[str]) -> None:
    words = [str(SCENES / "thesis2.toml"), "--step", "1.5"]
    why = explained(words, capsys)
    assert main(["check", *words, "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["why"] == why
    assert main(["check", words[0], "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["why"] is None


def test_inputs_are_those_of_the_comparison(capsys: pytest.CaptureFixture[str]) -> None:
    scene = str(SCENES / "thesis2.toml")
    assert main(["check", scene, "--input", "torque=2"]) == 2
    assert "has no input 'torque'. Did you mean tip_torque?" in capsys.readouterr().err
    assert main(["check", scene, "--input", "tip_torque=2", "--lint"]) == 2
    assert "--input is for the comparison of runs" in capsys.readouterr().err
