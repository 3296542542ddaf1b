"""`tmm-gen demo`: an arm in motion, and words that agree with its table."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.report import arm_demo

pytestmark = pytest.mark.compiler


def test_the_demonstration(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    assert main(["demo", "--out", "shown"]) == 0
    told = capsys.readouterr().out
    assert {path.name for path in tmp_path.iterdir()} == {"shown"}
    out = tmp_path / "shown"
    assert (out / "arm.png").read_bytes().startswith(b"\x89PNG")
    for path in ("__init__.py", "kernel.py", "casadi_model.py", "c/elbow.c", "c/elbow.h"):
        assert (out / "generated" / "elbow" / path).is_file()

    with (out / "arm.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == sum(len(steps) for steps in arm_demo.STEPS.values())
    takes = {name: float(time) for time, name in re.findall(r"([\d.]+) ms with (\w+)", told)}
    assert set(takes) == set(arm_demo.STEPS)
    assert list(takes.values()) == sorted(takes.values())
    for name, order in (("newmark", 2), ("sdirk4", 4), ("radau3", 4)):
        own = [row for row in rows if row["integrator"] == name]
        steps, errors, times = (
            np.array([float(row[key]) for row in own]) for key in ("step", "error", "time")
        )
        slope = np.polyfit(np.log(steps[-3:]), np.log(errors[-3:]), 1)[0]
        assert slope == pytest.approx(order, abs=0.25)
        # what the words say lies between the rows that they come from; clocks need not agree with the order of steps
        closer = np.argsort(errors)
        near = times[closer][np.searchsorted(errors[closer], 0.01) + np.array([-1, 0])]
        assert near.min() - 0.01 <= takes[name] <= near.max() + 0.01
