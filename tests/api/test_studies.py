"""Costs, limits, tunings, controllers and fits from Python are those of the command line."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import tmm_gen as tg
from tmm_gen.api.run import Run
from tmm_gen.cli import main
from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.scene import Scene
from tmm_gen.stability.limits import scene_integrators

QUICK = {"integrators": ["newmark", "sdirk4"], "until": 0.5, "rounds": 1, "brake": 0.5}


@pytest.fixture(scope="module")
def swing() -> tg.Arm:
    return tg.load("scenes/swing.toml").with_(beam__links=1)


@pytest.fixture(scope="module")
def stiffer(swing: tg.Arm) -> Run:
    """Return a run of an arm whose stiffness is to be found."""
    return swing.with_(beam__bending_stiffness=15.0).simulate(0.4, hub_torque=tg.sine(1.0, 2.0))


def test_explain(shafts: tg.Arm, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = shafts.explain()
    assert main(["explain", str(shafts.save(tmp_path / "shafts.toml")), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert found.rows == told["rows"]
    assert (found.cost.step, found.cost.state_bytes) == (told["operations_per_step"], told["state_bytes"])
    assert found.everything.step == told["everything_operations_per_step"] > found.cost.step
    assert repr(found).startswith(f"<Explanation of shafts: {found.cost.step} operations a step, ")
    assert found.statement in found._repr_html_()


def test_stability(
    shafts: tg.Arm, tmp_path: Path, agree: Callable[..., None], monkeypatch: pytest.MonkeyPatch
) -> None:
    few = ("newmark", "sdirk4")  # the limits of all take seconds; tests of the command derive them

    def some(scene: Scene, wanted: Iterable[str] | None = None) -> list[Integrator]:
        return scene_integrators(scene, wanted or few)

    monkeypatch.setattr("tmm_gen.api.stability.scene_integrators", some)
    found = shafts.stability(cells=2)
    assert found
    assert found.stable
    assert found.agrees
    assert found.largest_step == np.inf
    assert [row["integrator"] for row in found.rows] == [*few]
    assert repr(found) == "<Stability of shafts: sdirk4 is stable at any step>"
    assert "measured: the sdirk4 kernel grows as derived at all 4 steps" in found.statement
    assert len(found.plot().figure.axes) == 3
    agree(found.rows, "stability", shafts.save(tmp_path / "shafts.toml"), "--cells", 0)
    assert "largest stable step (s)" in found._repr_html_()
    with pytest.raises(tg.UserError, match="draws maps, and cells=0 leaves them out"):
        replace(found, maps=()).plot()


@pytest.mark.compiler
def test_trade_and_tune(shafts: tg.Arm, tmp_path: Path, agree: Callable[..., None]) -> None:
    found = shafts.trade(steps=[0.02, 0.01], **QUICK)  # type: ignore[arg-type]
    assert len(found) == len(found.rows) == 4
    errors = {row["configuration"]: row["error"] for row in found.rows if row["step"] == 0.01}
    assert errors["sdirk4"] < errors["newmark"]
    assert set(found.front) <= set(found.points)
    assert found.statement.splitlines()[1] == "4 configurations: 4 finished."
    assert found.csv(tmp_path / "all.csv").count("\n") == 5
    assert "</svg>" in found.report(tmp_path / "page.html").read_text()
    assert found.plot().figure.axes
    assert "µs per simulated s" in found._repr_html_()
    file, clocked = shafts.save(tmp_path / "shafts.toml"), ("ns_", "us_", "pareto")
    words = ["--integrators", "newmark,sdirk4", "--until", 0.5, "--rounds", 1, "--input", "brake=0.5"]
    agree(found.rows, "trade", file, "--steps", "0.02,0.01", *words, but=clocked)

    tuned = shafts.tune("1%", 1.0, **QUICK)  # type: ignore[arg-type]
    assert tuned
    assert tuned.arm is not None
    assert (tuned.arm.scene.integrator.name, tuned.arm.scene.integrator.step) == (
        tuned.integrator,
        tuned.step,
    )
    assert tuned.error is not None
    assert tuned.error < 0.01
    assert tuned.statement.splitlines()[0].startswith(
        f"{tuned.integrator} with steps of {tuned.step:g} s: run"
    )
    assert repr(tuned) == f"<Tuning of shafts: {tuned.integrator} at {tuned.step:.4g} s>"
    assert "within bounds" in tuned._repr_html_()
    bounds = ["--max-error", "1%", "--max-time", "1s", "--out", tmp_path / "tuned.toml"]
    agree(tuned.rows, "tune", file, *bounds, *words, but=clocked)


@pytest.mark.compiler
def test_mpc(swing: tg.Arm, tmp_path: Path, agree: Callable[..., None]) -> None:
    found = swing.mpc("pd", ["nominal", "soft"], until=0.2)
    assert [(row["controller"], row["condition"]) for row in found.rows] == [
        ("pd", "nominal"),
        ("pd", "soft"),
    ]
    assert repr(found) == "<Control of swing: pd; nominal, soft>"
    assert found[0].loop.tip.shape == (len(found[0].loop.time), 1)
    assert len(found.plot().figure.axes) == 4
    assert "solve (µs)" in found._repr_html_()
    words = ["--controller", "pd", "--condition", "nominal", "--condition", "soft", "--until", 0.2]
    agree(found.rows, "mpc", swing.save(tmp_path / "swing.toml"), *words, but=("solve",))
    assert "</script>" in found.animate(tmp_path / "arm.html").read_text()


@pytest.mark.compiler
def test_calibrate(swing: tg.Arm, stiffer: Run, tmp_path: Path, agree: Callable[..., None]) -> None:
    key = "beam.bending_stiffness"
    found = swing.calibrate(stiffer, fit=key)
    assert found.values == pytest.approx({key: 15.0}, rel=1e-6)
    assert found.arm == swing.with_({key: found.values[key]})
    assert "change (%)" in found._repr_html_()
    assert repr(found).startswith("<Calibration of swing: beam.bending_stiffness = 15; ")
    assert found.deviations[key] < 1e-3
    record, file = tmp_path / "record.csv", swing.save(tmp_path / "swing.toml")
    stiffer.csv(record, inputs=True)
    words = ["--fit", key, "--out", tmp_path / "fitted.toml"]
    agree(swing.calibrate(record, fit=key).rows, "calibrate", file, record, *words)

    tip = stiffer["tip_y"].copy()
    tip[20] = np.nan  # a sample that is missing
    record = {"time": 1e3 * stiffer.time, "tip_y": tip, "note": ["x"]}
    apart = swing.calibrate(record, fit=[key], time_unit="ms", hub_torque=tg.sine(1.0, 2.0))
    assert apart.values == pytest.approx({key: 15.0}, rel=1e-3)
    assert apart.calibration.samples == len(tip) - 1

    stiffer.csv(tmp_path / "run.csv")  # without what acted
    assert stiffer.csv(tmp_path / "all.csv", inputs=True).startswith("time,hub_torque,tip_x,tip_y,hub\n0,")
    assert swing.calibrate(tmp_path / "all.csv", fit=key).values == found.values
    of_file = swing.calibrate(tmp_path / "run.csv", fit=key, hub_torque=tg.sine(1.0, 2.0))
    assert of_file.values == pytest.approx({key: 15.0}, rel=1e-3)


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda arm: arm.stability(maps="newmrk"), 'maps="newmrk": no such integrator; there are '),
        (lambda arm: arm.stability(cells=-1), "cells: must be a whole number from 0"),
        (lambda arm: arm.trade(integrators=["euler"]), 'integrators="euler": no such integrator'),
        (lambda arm: arm.trade(integrators=[3]), "integrators: 3 is no name"),
        (lambda arm: arm.trade(steps=[0.0]), "steps: must be a positive number of seconds"),
        (lambda arm: arm.trade(reals="float16"), "reals: 'float16' is none of float64, float32"),
        (lambda arm: arm.trade(links=2), "links: the scene has no .beam. to cut into links"),
        (lambda arm: arm.trade(iterations=2), "iterations: a chain is linear"),
        (lambda arm: arm.trade(output="tip"), 'output="tip": no such output; choose from end, twist'),
        (
            lambda arm: arm.trade(workers=2, scheduler="tcp://h:1"),
            "workers starts a cluster, scheduler names one",
        ),
        (lambda arm: arm.trade(brake=lambda now: now), "brake: .* cannot tell one function from another"),
        (lambda arm: arm.trade(brk=1.0), "no input of this name. Did you mean brake"),
        (lambda arm: arm.tune("1 parsec", 1.0), "max_error=1 parsec: unknown unit"),
        (lambda arm: arm.tune(-1.0, 1.0), "max_error: must be a positive number"),
        (lambda arm: arm.tune(1e-3, "soon"), 'max_time="soon": is no positive number'),
        (
            lambda arm: arm.tune(1e-3, 1.0, links="auto"),
            'links="auto": the links of scene .* cannot be chosen',
        ),
        (lambda arm: arm.tune(1e-3, 1.0, target="z80"), 'target="z80": no such microcontroller'),
        (lambda arm: arm.mpc("pdd"), 'controllers="pdd": there is none. Did you mean pd'),
        (lambda arm: arm.mpc("pd", seed=-1), "seed: must be a whole number from 0"),
        (lambda arm: arm.mpc("pd"), "has nothing that controllers turn"),
        (lambda arm: arm.calibrate("no.csv"), "no.csv: no such file"),
        (lambda arm: arm.calibrate({"end": [1.0]}), "record: has no 'time'"),
        (lambda arm: arm.calibrate({"time": [0.0]}), "record: has none of the outputs end, twist"),
        (
            lambda arm: arm.calibrate({"time": [0.0], "end": [1.0]}, loss="l1"),
            "loss: must be 'linear' or 'huber'",
        ),
        (
            lambda arm: arm.calibrate({"time": [0.0], "end": [1.0]}, time_unit="h"),
            "time_unit: must be one of s, ms",
        ),
        (lambda arm: arm.calibrate({"time": [0.0], "end": [1.0, 2.0]}), "end: has 1 times and 2 values"),
        (
            lambda arm: arm.calibrate({"time": [0.0], "end": [1.0], "brake": [1.0]}, brake=1.0),
            "brake: is a column of the record",
        ),
    ],
)
def test_refusals(shafts: tg.Arm, ask: Callable[[tg.Arm], object], words: str) -> None:
    with pytest.raises(tg.UserError, match=words):
        ask(shafts)


def test_a_record_that_the_model_does_not_follow(swing: tg.Arm, stiffer: Run) -> None:
    other = {"time": stiffer.time, "tip_y": np.cos(40.0 * stiffer.time)}
    with pytest.raises(
        tg.UserError, match=r"\(max_misfit\).*\(start, time_unit\).*, loss=\"huber\" gives them"
    ):
        swing.calibrate(other, fit="beam.bending_stiffness", hub_torque=1.0)
