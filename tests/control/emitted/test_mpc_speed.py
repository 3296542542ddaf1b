"""The benchmark of MPC's speed gives others the same problem: its parts, without the measuring."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pytest

from tmm_gen.control.bench import Bench

ROOT = Path(__file__).resolve().parents[3]
LINKS = 2


@pytest.fixture(scope="module")
def solvers() -> Iterator[Any]:
    """The package beside the benchmark, found as the benchmark finds it."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    chooses = hasattr(ca.GlobalOptions, "setNumpyMode")  # from CasADi 3.8 on
    modes = ca.GlobalOptions.getNumpyMode() if chooses else None
    if chooses:
        ca.GlobalOptions.setNumpyMode(-1)
    yield lambda name: importlib.import_module(f"mpc_solvers.{name}")
    if chooses:
        ca.GlobalOptions.setNumpyMode(modes)
    sys.path.remove(str(ROOT / "benchmarks"))


@pytest.fixture(scope="module")
def stage(solvers: Any) -> Any:
    bench = Bench.of(solvers("task").arm(LINKS))
    return solvers("stage").Stage(solvers("motion").Motion(bench))


def _points(stage: Any, seed: int = 0) -> tuple[np.ndarray, np.ndarray, float]:
    draw = np.random.default_rng(seed)
    return draw.normal(size=stage.motion.size), draw.normal(size=3), 0.1


def _same(motion: Any, x: np.ndarray, state: np.ndarray, off: float) -> None:
    """Whether coordinates and a state of the kernel show the same tip and hub."""
    seen, step = motion.outputs(ca.DM(x)), motion.step
    for name, rows in (("tip", step.motors.tip), ("hub", step.motors.hub)):
        angle, rate = (step.rows(rows, quantity)[0] for quantity in ("angle", "rate"))
        assert float(seen[name]) == pytest.approx(angle @ state, abs=off)
        assert float(seen[f"{name}_rate"]) == pytest.approx(rate @ state, abs=100.0 * off)


def test_smaller_coordinates_make_the_same_step_from_no_acceleration(stage: Any) -> None:
    motion, step = stage.motion, stage.motion.step
    for seed in range(5):
        draw = np.random.default_rng(seed)
        state, (last, torque) = draw.normal(size=step.size), draw.normal(size=2)
        state[motion.accelerations] = 0.0
        x = motion.start(state, last)
        _same(motion, x, state, 1e-12)
        after = np.array(step.sample(state, np.array([last, torque]) + 0.1)).ravel()
        x = np.array(stage.after(x, [torque, 0.0, 0.0], 0.1)).ravel()
        np.testing.assert_allclose(x, motion.start(after, torque), rtol=1e-10, atol=1e-10)
        _same(motion, x, after, 1e-10)


def test_smaller_coordinates_hardly_differ_over_a_horizon(stage: Any) -> None:
    motion, step = stage.motion, stage.motion.step
    state = step.initial()
    x = motion.start(state, 0.0)
    for torque in np.repeat([3.0, -3.0, 1.0], 10):
        state = np.array(step.sample(state, [torque, torque])).ravel()
        x = np.array(stage.after(x, [torque, 0.0, 0.0], 0.0)).ravel()
        _same(motion, x, state, 2e-4)


def test_derivatives_of_a_stage_are_those_of_casadi(stage: Any) -> None:
    x, u, d = _points(stage)
    sx, su = ca.SX.sym("x", len(x)), ca.SX.sym("u", 3)
    for function, slopes in ((stage.rows, stage.rows_slopes), (stage.after, stage.after_slopes)):
        right = ca.Function("right", [sx, su], [ca.jacobian(function(sx, su, d), ca.vertcat(sx, su))])
        np.testing.assert_allclose(np.array(slopes(x, u, d)[1]), np.array(right(x, u)), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("most", [0, 40_000])
def test_hessian_of_a_stage_is_that_of_casadi(
    solvers: Any, stage: Any, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As one function, and column by column."""
    monkeypatch.setattr(solvers("stage"), "MOST_STATEMENTS", most)
    made = solvers("stage").Stage(stage.motion)
    x, u, d = _points(stage)
    multipliers = np.random.default_rng(2).normal(size=len(x))
    sx, su = ca.SX.sym("x", len(x)), ca.SX.sym("u", 3)
    value = ca.dot(multipliers, stage.after(sx, su, d))
    right = ca.Function("right", [sx, su], [ca.hessian(value, ca.vertcat(sx, su))[0]])
    np.testing.assert_allclose(
        np.array(made.curvature(x, u, d, multipliers)), np.array(right(x, u)), rtol=1e-9, atol=1e-9
    )


def test_programmes_have_their_own_derivatives(solvers: Any, stage: Any) -> None:
    """What sqpmethod and IPOPT are given, put together from stages, is what CasADi makes of the programme."""
    draw = np.random.default_rng(3)
    made = solvers("sequential").horizon(stage, stage.rows_slopes)
    controller, _ = solvers("do_mpc_controller")._controller(stage, "MX")
    jacobian, hessian = solvers("do_mpc_controller").derivatives(stage, controller)
    for programme, slopes in ((made.problem, made.slopes), (controller.nlp, jacobian)):
        point, given = (draw.normal(size=programme[name].numel()) for name in ("x", "p"))
        right = ca.Function(
            "right",
            [programme["x"], programme["p"]],
            [programme["g"], ca.jacobian(programme["g"], programme["x"])],
        )
        for found, wanted in zip(slopes(point, given)[-2:], right(point, given), strict=True):
            np.testing.assert_allclose(np.array(found), np.array(wanted), rtol=1e-9, atol=1e-9)
    lam = draw.normal(size=programme["g"].numel())
    lagrangian = 0.3 * programme["f"] + ca.dot(ca.DM(lam), programme["g"])
    whole = ca.triu(ca.hessian(lagrangian, programme["x"])[0])
    wanted = ca.Function("right", [programme["x"], programme["p"]], [whole])(point, given)
    np.testing.assert_allclose(
        np.array(hessian(point, given, 0.3, lam)), np.array(wanted), rtol=1e-9, atol=1e-8
    )


def test_cost_is_that_of_the_problem(solvers: Any, stage: Any) -> None:
    """Its gradient and Hessian too: a quadratic function about a point."""
    made = solvers("sequential").horizon(stage, stage.rows_slopes)
    draw = np.random.default_rng(4)
    point, change = (draw.normal(size=made.problem["x"].numel()) for _ in range(2))
    value, gradient, *_ = made.slopes(point, 0.1)
    later = float(made.slopes(point + change, 0.1)[0])
    hessian = np.array(made.hessian(point, 0.1, 1.0, np.zeros(made.problem["g"].numel())))
    wanted = float(value) + np.array(gradient).ravel() @ change + 0.5 * change @ hessian @ change
    assert later == pytest.approx(wanted, rel=1e-9)


def test_what_is_shifted_starts_a_stage_later(solvers: Any) -> None:
    values = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 9.0])
    assert solvers("sequential").shifted(values, 2, 1).tolist() == [3.0, 4.0, 5.0, 6.0, 5.0, 6.0, 9.0]


def test_two_entries_of_one_place_are_refused(solvers: Any) -> None:
    pattern, where = ca.Sparsity.dense(1, 1), [np.array([0]), np.array([0])]
    with pytest.raises(ValueError, match="same place"):
        solvers("scatter").scattered(ca.MX.sym("b", 1, 2), pattern, where, where, ca.DM(1, 1))


def test_the_page_has_room_for_what_is_measured(solvers: Any) -> None:
    page = solvers("page")
    row = {"links": 5, "solver": "full RTI, C", "median_us": 62.1, "p99_over_median": 1.1, "over_full": 1.0}
    other = {**row, "solver": "other", "median_us": 2104.0, "over_full": 33.9, "over_zero": 180.0}
    rows = [{**row, "over_zero": 5.3, "torque_off": 0.0, "samples": 125}]
    rows += [{**other, "links": links, "torque_off": 4e-4, "samples": 60} for links in (5, 10)]
    growth = [{"solver": "full RTI, C", "exponent": 0.61}]
    costs = [{"links": 5, "solver": "full RTI, C", "more": 1e-10}]
    text = page.section(rows, growth, costs)
    assert "| 5 | full RTI, C | 62.1 | 1.10 | 1.00 | 5.30 | 0 | 125 |" in text
    assert "| 10 | other | 2104 | 1.10 | 33.9 | 180 | 4e-4 | 60 |" in text
    assert "zero-order RTI: other 33.9 and 180." in text
    assert "full RTI 0.61" in text
    assert "with 5 links full RTI 1e-10 more" in text
    committed = (ROOT / "docs" / "mpc-speed.md").read_text()
    renewed, script = importlib.import_module("support.marks").renewed, "mpc_speed.py"
    written = renewed(committed, text, script)
    assert written == renewed(renewed(committed, "other", script), text, script)
    assert text in written
    with pytest.raises(ValueError, match="needs"):
        renewed("no marks", text, script)
