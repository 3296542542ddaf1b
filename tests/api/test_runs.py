"""Runs from Python are those of the command line, however their inputs are given."""

from __future__ import annotations

import json
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tmm_gen as tg
from tmm_gen.api.run import Run
from tmm_gen.cli import main

UNTIL = 0.06


@pytest.fixture(scope="module")
def run(rod: tg.Arm) -> Run:
    return rod.simulate(UNTIL, push="ramp:0:2:0.05", hub_torque=0.3)


def test_it_is_that_of_the_command_line(
    run: Run, rod: tg.Arm, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, table = rod.save(tmp_path / "rod.toml"), tmp_path / "rod.csv"
    words = ["--until", str(UNTIL), "--input", "push=ramp:0:2:0.05", "--input", "hub_torque=0.3"]
    assert main(["run", str(file), *words, "--csv", str(table), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert run.csv() == table.read_text()
    assert json.loads(json.dumps(run.figures)) == told["rows"]
    assert {key: told[key] for key in run.facts} == run.facts
    assert f"accurate to about {told['accuracy']:.0e} of the motion" in run.statement
    assert f"work, energy and heat balance to {run.energy_imbalance:.1e}" in run.statement


@pytest.mark.parametrize(
    "push",
    [
        tg.ramp(0, 2, 0.05),
        lambda now: min(40.0 * now, 2.0),
        ([0.0, 0.05], [0.0, 2.0]),
        (np.array([0.0, 0.05]), np.array([0, 2])),
        np.minimum(40.0 * 2e-3 * np.arange(31), 2.0),
        (40.0 * 2e-3 * np.arange(31)).clip(max=2.0).tolist(),
    ],
    ids=["profile", "function", "pair", "pair of arrays", "array", "list"],
)
def test_ways_to_give_an_input(push: Any, rod: tg.Arm, run: Run) -> None:
    same = rod.simulate(UNTIL, inputs={"push": push}, hub_torque=np.float64(0.3))
    for name, values in run.outputs.items():
        np.testing.assert_allclose(same[name], values, rtol=1e-10, atol=1e-10)


def test_a_function_moves_a_prescribed_base(shafts: tg.Arm) -> None:
    profile = tg.smooth(0.0, 0.5, 0.2)
    right = shafts.simulate(0.3, drive=profile)
    own = shafts.simulate(0.3, drive=lambda now: float(profile.at(now)))
    np.testing.assert_allclose(own.twist, right.twist, atol=1e-3 * np.max(np.abs(right.twist)))


def test_a_force_in_space_has_three_components(probe: tg.Arm) -> None:
    whole = probe.simulate(0.02, thrust=(0.0, 1.0, lambda now: now), step=1e-3)
    parts = probe.simulate(0.02, thrust_y=1.0, thrust_z=([0.0, 1.0], [0.0, 1.0]), step=1e-3)
    assert whole.weight.shape == (21, 3)
    assert whole["facing"].shape == (21, 4)
    np.testing.assert_allclose(whole.weight, parts.weight, rtol=1e-12)
    assert whole.units["weight_x"] == "m"


def test_what_is_read_off(run: Run) -> None:
    assert run.time[-1] == pytest.approx(UNTIL)
    assert run.tip.shape == (31, 2)
    np.testing.assert_array_equal(run.tip[:, 1], run["tip_y"])
    assert run.units == {
        "tip_x": "m",
        "tip_y": "m",
        "root": "N m",
        "moving": "J",
        "push": "N",
        "hub_torque": "N m",
    }
    assert run.final["moving"] == run.moving[-1] > 0.0
    assert run.inputs["push"].max() == pytest.approx(2.0)
    assert repr(run).startswith(
        "<Run of rod, 0.06 s in 30 steps by newmark: tip_x, tip_y, root, moving, accurate to "
    )
    assert {"tip", "tip_x", "plot"} <= set(dir(run))
    assert not hasattr(run, "tail")
    shown = run._repr_html_()
    assert shown.count("<tr>") == 5
    assert run.statement.splitlines()[0] in shown


def test_what_is_written(run: Run, tmp_path: Path) -> None:
    picture = run.plot(tmp_path / "new" / "run.svg")
    assert (tmp_path / "new" / "run.svg").read_text().startswith("<?xml")
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert len(picture.figure.axes) == 5
    run.csv(tmp_path / "run.csv")
    assert np.loadtxt(tmp_path / "run.csv", delimiter=",", skiprows=1).shape == (31, 5)
    assert "</script>" in run.animate(tmp_path / "run.html").read_text()


def test_pandas_where_it_is(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    pandas = pytest.importorskip("pandas")
    frame = run.to_pandas()
    assert list(frame.columns) == list(run.outputs)
    assert frame.index.name == "time"
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with pytest.raises(tg.UserError, match=r"needs pandas, which is not installed: .*pip install pandas"):
        run.to_pandas()
    assert pandas is not None


def _fails(now: float) -> float:
    return 1.0 / (now - now)


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda arm: arm.simulate(UNTIL, psh=1.0), "no input of this name. Did you mean push"),
        (lambda arm: arm.simulate(UNTIL, push=np.nan), "push: nan is not a finite number"),
        (lambda arm: arm.simulate(UNTIL, push=True), "push: True is not a finite number"),
        (
            lambda arm: arm.simulate(UNTIL, push=10**5000),
            "push: an integer of thousands of digits is not a finite",
        ),
        (
            lambda arm: arm.simulate(UNTIL, push=lambda now: 10**5000),
            "returns an integer of thousands of digits at t = 0 s",
        ),
        (lambda arm: arm.simulate(until=UNTIL, push=1j), "push: 1j is not a finite number"),
        (
            lambda arm: arm.simulate(UNTIL, push="fast"),
            'push="fast": .*for example push=1.5, push="file.csv" or push="smo',
        ),
        (lambda arm: arm.simulate(UNTIL, push="no.csv"), "no.csv: no such file"),
        (lambda arm: arm.simulate(UNTIL, push="step:1"), 'push="step:1": step does not take 1 numbers'),
        (
            lambda arm: arm.simulate(UNTIL, push=[1.0, 2.0]),
            "has 2 values, and the simulation 31 instants, from 0 to 0.06",
        ),
        (lambda arm: arm.simulate(UNTIL, push=np.ones((2, 31))), r"shape \(2, 31\)"),
        (lambda arm: arm.simulate(UNTIL, push=[[1], [1, 2]]), "not numbers. Give a list"),
        (lambda arm: arm.simulate(UNTIL, push=[0.0] * 30 + [np.inf]), r"values\[30\] is inf"),
        (lambda arm: arm.simulate(UNTIL, push=([[0], [0, 1]], [0, 1])), "times are .*, not numbers"),
        (lambda arm: arm.simulate(UNTIL, push=([0, 1], [0, 1, 2])), "2 times and 3 values"),
        (lambda arm: arm.simulate(UNTIL, push=([1, 0], [0, 1])), "time 0 does not follow 1"),
        (
            lambda arm: arm.simulate(UNTIL, push=([5, 6], [0, 1])),
            r"would see none of them.* simulate longer \(until\)",
        ),
        (lambda arm: arm.simulate(UNTIL, push=_fails), r"fails at t = 0 s \(ZeroDivisionError"),
        (lambda arm: arm.simulate(UNTIL, push=lambda now: "1"), "returns '1' at t = 0 s"),
        (lambda arm: arm.simulate(UNTIL, push=lambda now: np.ones(1)), r"returns array\(\[1.\]\)"),
        (lambda arm: arm.simulate(UNTIL, inputs=[1]), "inputs: must be a mapping"),
        (lambda arm: arm.simulate(UNTIL, inputs={"push": 1}, push=2), "push: is given twice"),
        (lambda arm: arm.simulate(-1.0), "until: must be a positive number of seconds, not -1"),
        (lambda arm: arm.simulate("1"), "until: '1' is not a finite number"),
        (lambda arm: arm.simulate(1e12), r"larger steps \(step\)"),
        (lambda arm: arm.simulate(UNTIL, step=0), "step: must be a positive number"),
        (lambda arm: arm.simulate(UNTIL, backend="rust"), "must be 'numpy' or 'c'"),
        (lambda arm: tg.smooth(0, 1, -1), "smooth: TIME must be positive"),
        (lambda arm: tg.chirp(1, "a", 2, 1), "first: 'a' is not a finite number"),
    ],
)
def test_refusals(rod: tg.Arm, ask: Callable[[tg.Arm], object], words: str) -> None:
    with pytest.raises(tg.UserError, match=words) as caught:
        ask(rod)
    inside = [Path(frame.filename) for frame in traceback.extract_tb(caught.value.__traceback__)]
    assert [path.name for path in inside if "tmm_gen" in path.parts] == ["guard.py"]


def test_how_a_function_failed_is_shown(rod: tg.Arm) -> None:
    with pytest.raises(tg.UserError) as caught:
        rod.simulate(UNTIL, push=_fails)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)
    with pytest.raises(tg.UserError) as caught:
        rod.links_for(1e-9, 50.0)
    assert caught.value.__cause__ is None


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda run: run["tp"], "no output 'tp'. Did you mean 'tip'"),
        (lambda run: run[3], "There are tip, tip_x, tip_y, root, moving"),
        (lambda run: run.plot("run.jpg"), "run.jpg: must end in .png or .svg or .pdf"),
        (lambda run: run.csv(3), "3 is no name of a file"),
        (lambda run: run.animate("run.mp4"), "must end in .gif or .html"),
        (lambda run: run.plot("/dev/null/run.png"), "/dev/null"),
    ],
)
def test_refusals_of_a_run(run: Run, ask: Callable[[Run], object], words: str) -> None:
    with pytest.raises(tg.UserError, match=words):
        ask(run)
