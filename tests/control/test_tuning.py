"""Tuning: the same search for everything, repeatable, blind to the numbers a scene has."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import mpc_tune
from tmm_gen.closed_loop import pricing
from tmm_gen.closed_loop.knobs import Tunable, number, places_of, turned
from tmm_gen.closed_loop.loop import Loop
from tmm_gen.closed_loop.objective import AIMS, NOISES, objective, price
from tmm_gen.closed_loop.pricing import Cost, OneByOne, side_by_side
from tmm_gen.closed_loop.tunables import TUNABLE
from tmm_gen.closed_loop.tuning import tune
from tmm_gen.control.bench import Bench
from tmm_gen.scene import load_scene, parse_scene
from tmm_gen.scene.problem import SceneError
from tmm_gen.scene.rewrite import rewritten

pytestmark = pytest.mark.compiler

Call = Callable[..., subprocess.CompletedProcess[str]]
BY_NAME = {item.name: item for item in TUNABLE}


def swing(settling: float = 0.7, overshoot: float = 0.0, residual: float = 0.0) -> Loop:
    """A tip that enters the band of 0.5 % when told, passes its target when still on its way, and trembles for ever."""
    time = np.linspace(0.0, 2.0, 2001)
    tip = 1.0 - 0.005 * np.exp(np.minimum(40.0 * (settling - time), 5.0))
    tip[0] = 0.0
    tip[time == 0.5] = 1.0 + overshoot
    tip += np.where(time >= 1.0, 0.5 * residual * np.sin(100.0 * np.pi * (time - 1.0)), 0.0)
    empty = np.zeros(0)
    tips = tip[:, None]
    return Loop(time, tips, tips, empty, empty, (), empty, empty, np.zeros(0, int), (), np.ones(1))


def valley(tunable: Tunable) -> Cost:
    """A price that is least, zero, at 30 % of every range, and steep in one direction that is no axis."""
    keys = list(dict.fromkeys(knob.key for knob in tunable.knobs))

    def cost(bench: Bench, _controllers: Sequence[str] = (), _enough: float = 0.0) -> float:
        values = np.hstack([number(bench.scene, key) for key in keys])
        places = [
            (np.log10(value) - knob.low) / (knob.high - knob.low) - 0.3
            for knob, value in zip(tunable.knobs, values, strict=True)
        ]
        return float(np.sum(np.square(places)) + 30.0 * np.sum(places) ** 2)

    return cost


def test_what_meets_its_aims_costs_less_than_one() -> None:
    for aim in AIMS:
        assert 0.0 < price(swing(), aim) < 0.5
        on_time, over, trembling = (
            swing(settling=aim.settling),
            swing(overshoot=aim.overshoot),
            swing(residual=aim.residual),
        )
        for edge in (on_time, over, trembling):
            assert price(edge, aim) == pytest.approx(1.0, rel=1e-2)


@pytest.mark.parametrize("name", ["settling", "overshoot", "residual"])
def test_whatever_gets_worse_costs_more_and_not_at_a_jump(name: str) -> None:
    for aim in AIMS:
        prices = [
            price(swing(**{name: share * getattr(aim, name)}), aim) for share in np.linspace(1.0, 1.1, 41)
        ]
        assert np.all(np.diff(prices) > 0.0)
        assert np.max(np.diff(np.log(prices))) < 0.15


def test_a_motion_without_end_has_a_price() -> None:
    far = swing()
    far.tip[-500:] = np.nan
    assert 10.0 < price(far, AIMS[0]) < np.inf


def test_the_price_is_near_the_worst_loop_and_no_more_are_run_than_it_takes(bench: Bench) -> None:
    """A mean of high order, not above the worst; what is already too bad is not tried on."""
    aims = AIMS[:2]
    worst = [objective(bench, ["pd"], aims=[aim], order=np.inf) for aim in aims]
    both = objective(bench, ["pd"], aims=aims)
    assert objective(bench, ["pd"], aims=aims, order=np.inf) == max(worst)
    assert (len(aims) * len(NOISES)) ** (-1.0 / 8.0) * max(worst) <= both <= max(worst)
    assert objective(bench, ["pd"], 1e9, aims) == both
    assert 0.1 * both < objective(bench, ["pd"], 0.1 * both, aims) < both


def test_turned_predictive_control_has_a_price(bench: Bench) -> None:
    """The loops that `--tune mpc` runs: all its controllers, on numbers other than the scene's."""
    tunable = BY_NAME["mpc"]
    elsewhere = bench.retuned(turned(bench.scene, tunable, np.full(len(tunable.knobs), 0.4)))
    here, there = (objective(tried, tunable.controllers, aims=AIMS[2:3]) for tried in (bench, elsewhere))
    assert 0.0 < here < there < np.inf


@pytest.mark.parametrize(("name", "evaluations"), [("pd", 60), ("mpc", 400)])
def test_the_search_finds_the_valley_wherever_the_scene_stands(
    bench: Bench, name: str, evaluations: int
) -> None:
    tunable, prices = replace(BY_NAME[name], first=None), []
    cost = valley(tunable)
    elsewhere = bench.retuned(turned(bench.scene, tunable, np.full(len(tunable.knobs), 0.9)))
    pricing = OneByOne(bench, cost)
    first = tune(bench.scene, tunable, evaluations, 1, prices.append, pricing)
    assert len(prices) == evaluations
    assert prices == sorted(prices, reverse=True)
    assert prices[-1] == first.price == cost(bench.retuned(first.scene))
    assert first.price < 0.05 * cost(elsewhere)
    assert first.price_before == cost(bench)
    again = tune(elsewhere.scene, tunable, evaluations, 1, pricing=pricing)
    assert again.scene == first.scene
    one, other = (tune(bench.scene, tunable, 60, seed, pricing=pricing).scene for seed in (1, 2))
    assert one != other


def test_refining_begins_where_the_scene_stands(bench: Bench) -> None:
    tunable = BY_NAME["mpc"]
    pricing = OneByOne(bench, valley(tunable))
    prices: list[float] = []
    near = turned(bench.scene, tunable, np.full(len(tunable.knobs), 0.31))
    assert places_of(near, tunable) == pytest.approx(
        np.full(len(tunable.knobs), 0.31), abs=0.06
    )  # payload's grid
    found = tune(near, tunable, 200, 1, prices.append, pricing, refine=True)
    assert len(prices) == 200
    assert prices[0] < 30.0 * 0.5**2  # far from the tens and hundreds of points spread evenly
    assert found.price < 0.5 * found.price_before
    best = turned(bench.scene, tunable, np.full(len(tunable.knobs), 0.3))
    kept = tune(best, tunable, 20, 1, pricing=pricing, refine=True)
    assert kept.scene == best
    assert kept.price == kept.price_before
    assert BY_NAME["pd"].knobs[0].place(0.0) == 0.0


def test_nothing_worse_than_the_scene_comes_of_it(bench: Bench) -> None:
    """Also where the search never comes near its numbers."""
    for name in ("pd", "lqr", "mpc"):
        tunable = BY_NAME[name]
        best = turned(bench.scene, tunable, np.full(len(tunable.knobs), 0.3))
        kept = tune(best, tunable, 20, 1, pricing=OneByOne(bench, valley(tunable)))
        assert kept.kept
        assert kept.scene == best
        assert kept.price == kept.price_before


def test_processes_side_by_side_find_the_same_numbers(bench: Bench) -> None:
    """Also what is broken off is broken off alike."""
    tunable = BY_NAME["pd"]
    alone = tune(bench.scene, tunable, 16, 3)
    with side_by_side(2) as pricing:
        together = tune(bench.scene, tunable, 16, 3, pricing=pricing)
        payloads = [bench.scene.replace(**{"control.payload": value}) for value in (1.1, 1.2, 1.1)]
        assert list(pricing(payloads, ["lqr"], np.inf)) == list(OneByOne()(payloads, ["lqr"], np.inf))
    assert together.scene == alone.scene
    assert (together.price, together.price_before) == (alone.price, alone.price_before)
    np.testing.assert_array_equal(together.places, alone.places)


def test_predictive_control_begins_where_a_regulator_ended(bench: Bench) -> None:
    """With a price of what both have, its first points cost no more than steps from the regulator's best do."""
    tunable = BY_NAME["mpc"]
    assert tunable.first is not None
    shared = valley(replace(tunable, knobs=tuple(knob for knob in tunable.knobs if "estimator" in knob.key)))
    prices: list[float] = []
    tune(bench.scene, tunable, 400, 1, prices.append, OneByOne(bench, shared))
    regulator, predictive = prices[:200], prices[200:]
    assert len(predictive) == 200
    assert regulator == sorted(regulator, reverse=True)
    assert predictive == sorted(predictive, reverse=True)
    assert regulator[-1] < 0.01 * regulator[0]
    assert predictive[10] < 0.05 * regulator[0]


def test_predictive_control_begins_in_the_valley_that_is_best_for_itself(bench: Bench) -> None:
    """Not in that which is best for what is tuned first, if only another one suits."""
    weights = BY_NAME["lqr"]
    tunable = replace(weights, name="second", controllers=("second",), first=weights)

    def cost(tried: Bench, controllers: Sequence[str], _enough: float) -> float:
        places = places_of(tried.scene, weights)
        low, high = (float(np.sum(np.square(places - at))) for at in (0.2, 0.8))
        return 1.0 + high if "second" in controllers else min(low, 0.01 + high)

    prices: list[float] = []
    tune(bench.scene, tunable, 2000, 1, prices.append, OneByOne(bench, cost))
    assert prices[999] < 1e-4  # in the first one's own valley
    assert min(prices[1000:1010]) < 1.01


def test_every_knob_is_a_number_of_the_committed_scene(bench: Bench) -> None:
    for tunable in TUNABLE:
        keys = dict.fromkeys(knob.key for knob in tunable.knobs)
        for end in (0.0, 1.0):
            scene = turned(bench.scene, tunable, np.full(len(tunable.knobs), end))
            values = np.hstack([number(scene, key) for key in keys])
            ends = [knob.high if end else knob.low for knob in tunable.knobs]
            assert np.log10(values) == pytest.approx(ends, abs=3e-3)


def test_lists_are_rewritten_too(repository: Path) -> None:
    text = (repository / "scenes" / "swing.toml").read_text()
    scene = load_scene(repository / "scenes" / "swing.toml")
    other = scene.replace(**{"control.baselines.pd": [1.5, 20.0]})
    path = ("control", "baselines", "pd")
    new = rewritten(text, "swing.toml", other, {path: (1.5, 20.0)})
    assert parse_scene(new, "swing.toml") == other
    changed = [row for row in new.split("\n") if row not in text.split("\n")]
    assert changed == ["pd = [1.5, 20.0]"]
    with pytest.raises(SceneError, match="a line of their own"):
        rewritten(text.replace("pd = [", "pd = [ # gains\n"), "swing.toml", other, {path: (1.5, 20.0)})


def test_a_comment_stays_in_its_column(repository: Path) -> None:
    text = (repository / "scenes" / "swing.toml").read_text()
    scene = load_scene(repository / "scenes" / "swing.toml")
    new = rewritten(text, "swing.toml", scene.replace(**{"tip.mass": 0.125}), {("tip", "mass"): 0.125})
    (row,) = (row for row in new.split("\n") if row not in text.split("\n"))
    assert row.startswith("mass = 0.125 ")
    assert row.index("#") == text.split("\n")[new.split("\n").index(row)].index("#")


def test_the_command_writes_the_scene_with_the_numbers_found(
    tmm_gen: Call, tmp_path: Path, repository: Path
) -> None:
    tuned = repository / "scenes" / "swing.toml"
    scene = tmp_path / "slack.toml"
    gains = tuned.read_text().split("pd = [")[1].split("]")[0]
    scene.write_text(tuned.read_text().replace(f"pd = [{gains}]", "pd = [0.1, 0.05]"))
    done = tmm_gen("mpc", scene, "--tune", "pd", "--evaluations", "20", "--out", "tuned.toml", "--json")
    assert done.returncode == 0, done.stderr
    shown = json.loads(done.stdout)
    assert shown["evaluations"] == 20
    (row,) = shown["rows"]
    old, new = (path.read_text().split("\n") for path in (scene, tmp_path / "tuned.toml"))
    changed = [(before, after) for before, after in zip(old, new, strict=True) if before != after]
    assert [after for _, after in changed] == [f"pd = {row['value']}"]
    missing = tmp_path / "missing.toml"
    missing.write_text("\n".join(row for row in old if not row.startswith("pd_zv = ")))
    refused = tmm_gen("mpc", missing, "--tune", "pd-zv", "--out", "tuned.toml", "--force")
    assert refused.returncode == 2
    assert "control.baselines.pd_zv" in refused.stderr


def test_the_command_writes_what_was_there_where_nothing_better_is_found(
    bench: Bench,
    tmp_path: Path,
    repository: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """To the letter; a price that the scene's own numbers alone do not pay stands for that of a long search."""
    monkeypatch.setattr(
        pricing, "OneByOne", lambda own: OneByOne(own, lambda tried, *_: float(tried.scene is not own.scene))
    )
    scene, out = repository / "scenes" / "swing.toml", tmp_path / "same.toml"
    mpc_tune.tuned(scene, bench, ("pd", "lqr"), 20, 0, 1, False, out, False, False)
    shown = capsys.readouterr().out
    for name in ("pd", "lqr"):
        assert f"{name}: 0.000 with the numbers the scene had, which stay: nothing better was found" in shown
    assert out.read_text() == scene.read_text()


@pytest.mark.parametrize(
    ("name", "there", "elsewhere"),
    [
        ("swing", "reference = 0.0", "reference = 0.5"),
        (
            "elbow",
            "reference = { shoulder = 0.0, elbow = 0.0 }",
            "reference = { shoulder = 0.2, elbow = 0.0 }",
        ),
    ],
)
def test_an_arm_with_nowhere_to_go_is_not_tuned(
    tmm_gen: Call, tmp_path: Path, repository: Path, name: str, there: str, elsewhere: str
) -> None:
    """Prices are relative to the way; a reference somewhere else is all it takes. Its loops are shown nevertheless."""
    text = (repository / "scenes" / f"{name}.toml").read_text()
    scene = tmp_path / "still.toml"
    scene.write_text(re.sub(r"(?m)^reference = (\{[^}]*\}|[^#\n]*)", there, text))
    refused = tmm_gen("mpc", scene, "--tune", "lqr", "--evaluations", "20")
    assert refused.returncode == 2
    assert "still.toml" in refused.stderr
    assert "control.reference is where the arm starts" in refused.stderr
    shown = tmm_gen(
        "mpc", scene, "--controller", "lqr", "--condition", "nominal", "--until", "0.2", "--json", "--plot"
    )
    assert shown.returncode == 0, shown.stderr
    (row,) = json.loads(shown.stdout)["rows"]
    assert (row["overshoot_percent"], row["settling_s"]) == (None, None)
    scene.write_text(scene.read_text().replace(there, elsewhere))
    assert tmm_gen("mpc", scene, "--tune", "lqr", "--evaluations", "20").returncode == 0
