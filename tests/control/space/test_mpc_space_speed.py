"""The benchmark of MPC's speed in space gives others the same problem: its parts, without the measuring."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import Any

import casadi as ca
import numpy as np
import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.control.quadratic.walls import Wall


@pytest.fixture(scope="module")
def solvers() -> Iterator[Any]:
    """The package beside the benchmark."""
    chooses = hasattr(ca.GlobalOptions, "setNumpyMode")  # from CasADi 3.8 on
    modes = ca.GlobalOptions.getNumpyMode() if chooses else None
    if chooses:
        ca.GlobalOptions.setNumpyMode(-1)
    yield lambda name: importlib.import_module(f"mpc_solvers.{name}")
    if chooses:
        ca.GlobalOptions.setNumpyMode(modes)


@pytest.fixture(scope="module")
def stage(solvers: Any) -> Any:
    """Of the arm with a cell in each link, two samples looked ahead, which starts near its wall and too fast."""
    changes = {"control.horizon": 2, "initial.angles": {"yaw": -0.42, "shoulder": -0.3, "elbow": 0.9}}
    bench = Bench.of(solvers("task").arm_in_space((1, 1), **changes))
    return solvers("stage").Stage(solvers("motion").Motion(bench))


def _state(stage: Any) -> np.ndarray:
    step, draw = stage.motion.step, np.random.default_rng(1)
    state = step.initial() + 0.02 * draw.normal(size=step.size)
    state[stage.motion.rates[0]] = -4.5
    return state


def test_smaller_coordinates_make_the_same_step_and_see_the_same_walls(stage: Any) -> None:
    motion, step = stage.motion, stage.motion.step
    last, torque = np.array([1.0, -6.0, -2.0]), np.array([3.0, -4.0, 1.0])
    state = _state(stage)
    after = np.array(step.sample(state, np.append(last, torque) + 0.1)).ravel()
    inputs = np.append(torque, np.zeros(motion.inputs - 3))
    found = np.array(stage.after(motion.start(state, last), inputs, 0.1)).ravel()
    np.testing.assert_allclose(found[: motion.size], motion.start(after, torque), rtol=1e-10, atol=1e-10)
    angles = after[motion.angles]
    walls = [Wall.of(motion.bench.scene, keep).along(angles[None])[0] for keep in motion.problem.keeps]
    np.testing.assert_allclose(found[motion.size :], walls, atol=1e-12)
    for name, rows in (("tip", step.motors.tip), ("hub", step.motors.hub)):
        for end, quantity in (("", "angle"), ("_rate", "rate")):
            seen = np.array(motion.outputs(ca.DM(found[: motion.size]))[name + end]).ravel()
            np.testing.assert_allclose(seen, step.rows(rows, quantity) @ after, atol=1e-9)


def test_derivatives_of_a_stage_are_those_of_casadi(stage: Any) -> None:
    x, u = stage.motion.start(_state(stage), np.ones(3)), np.linspace(-1.0, 1.0, stage.motion.inputs)
    sx, su = ca.SX.sym("x", len(x)), ca.SX.sym("u", len(u))
    for function, slopes in ((stage.rows, stage.rows_slopes), (stage.after, stage.after_slopes)):
        one = ca.SX.sym("one", len(x) + len(u))
        along = ca.jtimes(function(sx, su, 0.1), ca.vertcat(sx, su), one)
        column = ca.Function("column", [sx, su, one], [along])
        wanted = np.hstack([np.array(column(x, u, each)) for each in np.eye(len(x) + len(u))])
        np.testing.assert_allclose(np.array(slopes(x, u, 0.1)[1]), wanted, rtol=1e-9, atol=1e-9)


def test_the_same_torques_are_the_best(solvers: Any, stage: Any) -> None:
    """CasADi's sqpmethod and our own iteration, both repeated until they converge, at a wall and a bounded rate."""
    motion, bench = stage.motion, stage.motion.bench
    state, last, unknown = _state(stage), bench.links.goal.torque, np.full(3, 0.2)
    ours = solvers("record").Converged(bench.step, bench.links, bench.inertia).converged(state, unknown, last)
    made = solvers("sequential").horizon(stage, stage.rows_slopes)
    quiet = {f"print_{what}": False for what in ("header", "iteration", "status", "time")}
    solver = ca.nlpsol(
        "test",
        "sqpmethod",
        made.problem,
        {
            "qpsol": "qrqp",
            "qpsol_options": {f"print_{what}": False for what in ("iter", "header", "info", "time")},
            **{"hess_lag": made.hessian, "jac_fg": made.slopes, "max_iter": 20, **quiet},
        },
    )
    start = motion.start(state, last)
    low, high = made.low.copy(), made.high.copy()
    low[: motion.size] = high[: motion.size] = start
    found = solver(
        x0=motion.idle(start, last), p=unknown, lbx=low, ubx=high, lbg=made.low_rows, ubg=made.high_rows
    )
    point = np.array(found["x"]).ravel()
    slacks = point[motion.size + 3 : motion.size + motion.inputs]
    assert np.all(slacks[[0, 3]] > 1e-5)  # of the yaw's rate and of the payload's wall
    np.testing.assert_allclose(point[motion.size : motion.size + 3], ours.torque, atol=1e-5)


def test_fatrop_is_given_the_same_derivatives(solvers: Any, stage: Any) -> None:
    """Its functions, but for the order and signs of rows, are those of the programme."""
    motion, draw = stage.motion, np.random.default_rng(2)
    made = solvers("sequential").horizon(stage, stage.rows_slopes)
    found = {each.name(): each for each in solvers("interior").functions(stage, made)}
    x, p = (draw.normal(size=found["nlp"].numel_in(k)) for k in (0, 1))
    rows, jacobian = (np.array(each) for each in found["nlp_jac_g"](x, p))
    np.testing.assert_allclose(rows, np.array(found["nlp_g"](x, p)), rtol=1e-9, atol=1e-9)
    _, gradient, inner, slopes = (np.array(each) for each in made.slopes(x, p[motion.size :]))
    sign = np.tile([*[-1.0] * motion.size, *[1.0] * len(motion.bounded)], motion.problem.horizon)[:, None]
    np.testing.assert_allclose(rows[motion.size :], sign * inner)
    np.testing.assert_allclose(jacobian[motion.size :], sign * slopes)
    np.testing.assert_allclose(rows[: motion.size, 0], x[: motion.size] - p[: motion.size])
    lam = draw.normal(size=len(rows))
    np.testing.assert_allclose(
        np.array(found["nlp_hess_l"](x, p, 0.5, lam)[0]), 0.5 * gradient + jacobian.T @ lam[:, None]
    )


def test_the_page_says_how_far_the_others_are(solvers: Any) -> None:
    page = solvers("page")
    row = {"joints": 13, "walled": True, "solver": "`rti`, C", "median_us": 952.0, "p99_over_median": 1.1}
    own = {**row, "over_full": 1.0, "over_zero": 7.0, "torque_off": 0.0, "samples": 100}
    other = {**own, "solver": "other", "median_us": 12000.0, "over_full": 12.6, "over_zero": 88.0}
    other["torque_off"] = 3e-4
    bare = {**other, "walled": False, "over_full": 13.0, "over_zero": 130.0}
    once = {"joints": 13, "walled": True, "solver": page.DERIVATIVES, "median_us": 701.0}
    text = page.space_section([own, other, bare, once])
    assert "| 13 | yes | other | 12000 | 1.10 | 12.6 | 88 | 3e-4 | 100 |" in text
    assert "takes 12.6 times the time of `rti` up to the wall and 88 times that of `rti-zero`, 13 and" in text
    assert "13 and 130 times without it." in text
    assert "takes them 701 µs." in text
