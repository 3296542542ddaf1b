"""`tmm-gen check --compensated`: every backend against the others, numbers of the C kept as sums of two."""

from __future__ import annotations

import json

import pytest

from tmm_gen.cli import main
from tmm_gen.resources import scenes_dir


@pytest.mark.compiler
@pytest.mark.parametrize("name", ["thesis10", "drivetrain"])
def test_everything_holds(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(scenes_dir() / f"{name}.toml"), "--compensated", "--json"]) == 0
    rows = {row["check"]: row["value"] for row in json.loads(capsys.readouterr().out)["rows"]}
    assert rows["numpy_against_c"] < 2e-7  # outputs are rounded, nothing else is


def test_it_is_a_way_of_computing_in_single_precision(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["check", str(scenes_dir() / "thesis10.toml"), "--compensated", "--real", "float64"]
    assert main(words) == 2
    assert "--compensated" in capsys.readouterr().err
