"""One Gauss-Newton iteration of CasADi's sqpmethod per sample, by hpipm or qrqp."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from mpc_solvers.compiled import HPIPM, compiled
from mpc_solvers.scatter import scattered
from mpc_solvers.stage import Stage

QP_OPTIONS: dict[str, dict[str, Any]] = {
    "qrqp": {"print_iter": False, "print_header": False, "print_info": False, "print_time": False},
    # its own mode and tolerances take half as long again, for the same torques
    "hpipm": {
        "inf": 1e5,
        "hpipm": {
            **{"mode": "speed_abs", "iter_max": 100, "mu0": 10.0},
            **{f"res_{kind}_max": 1e-6 for kind in "gbd"},
            "res_m_max": 1e-8,
        },
    },
}
MORE = {"qrqp": (), "hpipm": HPIPM}


@dataclass(frozen=True, eq=False)
class Horizon:
    """Multiple shooting, stage by stage: state, then inputs; its derivatives assembled from those of a stage."""

    problem: dict[str, Any]
    slopes: Any
    hessian: Any
    low: np.ndarray
    high: np.ndarray
    low_rows: np.ndarray
    high_rows: np.ndarray


def horizon(stage: Stage, slopes: Any) -> Horizon:
    """Return the nonlinear programme.

    Parameters
    ----------
    stage : Stage
        Its functions.
    slopes : Function
        ``stage.rows_slopes``, perhaps compiled.
    """
    motion, problem = stage.motion, stage.motion.problem
    count, size, inputs = problem.horizon, motion.size, motion.inputs
    width, height, bounds = size + inputs, motion.height, motion.bounded
    cost, gradient, hessian = _cost(stage)
    point, disturbance = ca.MX.sym("x", count * width + size), ca.MX.sym("p", motion.motors)
    table = ca.reshape(point[: count * width], width, count)
    states = ca.horzcat(table[:size, 1:], point[count * width :])
    following = ca.vertcat(states, ca.MX.zeros(height - size, count))
    given = table[:size, :], table[size:, :], ca.repmat(disturbance, 1, count)
    value = cost(point, disturbance)
    rows, blocks = slopes.map(count)(*given)
    places = [(np.arange(height) + k * height, np.arange(width) + k * width) for k in range(count)]
    gaps = ca.DM.triplet(
        [k * height + i for k in range(count) for i in range(size)],
        [(k + 1) * width + i for k in range(count) for i in range(size)],
        np.full(count * size, -1.0),
        count * height,
        count * width + size,
    )
    at_rows, at_columns = zip(*places, strict=True)
    jacobian = scattered(blocks, slopes.sparsity_out(1), at_rows, at_columns, gaps)
    names = ["x", "p"], ["f", "grad_f_x", "g", "jac_g_x"]
    found = [value, gradient(point, disturbance), ca.vec(rows - following), jacobian]
    multipliers = [ca.MX.sym("lam_f"), ca.MX.sym("lam_g", count * height)]
    low, high = np.full((count, width), -np.inf), np.full((count, width), np.inf)
    low[:, size : size + motion.motors], high[:, size : size + motion.motors] = problem.torque
    free = np.full(size, np.inf)
    programme = {"x": point, "p": disturbance, "f": value}
    programme["g"] = ca.vec(stage.rows.map(count)(*given) - following)
    return Horizon(
        programme,
        ca.Function("nlp_jac_fg", [point, disturbance], found, *names),
        ca.Function(
            "nlp_hess_l",
            [point, disturbance, *multipliers],
            [ca.MX(hessian)],
            ["x", "p", "lam_f", "lam_g"],
            ["hess_gamma_x_x"],
        ),
        np.concatenate([low.ravel(), -free]),
        np.concatenate([high.ravel(), free]),
        np.tile([*np.zeros(size), *(bound.low for bound in bounds)], count),
        np.tile([*np.zeros(size), *(bound.high for bound in bounds)], count),
    )


def _cost(stage: Stage) -> tuple[Any, Any, Any]:
    """Return the cost, its gradient, and its Hessian, which is constant."""
    motion, count = stage.motion, stage.motion.problem.horizon
    size, width = motion.size, motion.size + motion.inputs
    point, disturbance = ca.SX.sym("x", count * width + size), ca.SX.sym("p", motion.motors)
    value: Any = 0.0
    for k in range(count):
        here, after = point[k * width : k * width + size], point[(k + 1) * width : (k + 1) * width + size]
        value += motion.input_cost(here, point[k * width + size : (k + 1) * width], disturbance)
        value += motion.state_cost(after)
    value += motion.cost_to_go(after, disturbance)
    hessian, gradient = ca.hessian(value, point)
    constant = ca.DM(ca.Function("hessian", [], [hessian])()["o0"])
    given = [point, disturbance]
    return ca.Function("cost", given, [value]), ca.Function("gradient", given, [gradient]), constant


class Sequential:
    """Solves sample after sample, each from the last solution shifted by one.

    Parameters
    ----------
    stage : Stage
        The task.
    qpsol : {"hpipm", "qrqp"}
        Solver of quadratic programs.
    whole : bool
        Whether all of the solver is compiled, or a stage with its derivatives, called by CasADi.
    """

    def __init__(self, stage: Stage, qpsol: str, whole: bool) -> None:
        self._motion = stage.motion
        made = horizon(stage, stage.rows_slopes if whole else compiled(stage.rows_slopes, stage.linked))
        options = {
            "qpsol": qpsol,
            "qpsol_options": {"error_on_fail": False, **QP_OPTIONS[qpsol]},
            **{"max_iter": 1, "min_iter": 1, "max_iter_ls": 0, "error_on_fail": False},
            **{f"print_{what}": False for what in ("header", "iteration", "status", "time")},
            "hess_lag": made.hessian,
            "jac_fg": made.slopes,
        }
        solver = ca.nlpsol("nmpc", "sqpmethod", made.problem, options)
        self._solver = compiled(solver, (*MORE[qpsol], *stage.linked)) if whole else solver
        # numbers stay where they are: converting them would take as long as solving
        bound: tuple[Any, Any] = self._solver.buffer()
        self._buffer, self._call = bound
        self._given: dict[str, np.ndarray] = {}
        self._found: dict[str, np.ndarray] = {}
        for name in ("x0", "p", "lbx", "ubx", "lbg", "ubg", "lam_x0", "lam_g0"):
            place = self._solver.index_in(name)
            self._given[name] = np.zeros(self._solver.numel_in(place))
            self._buffer.set_arg(place, self._given[name].data)
        for name in ("x", "lam_x", "lam_g"):
            place = self._solver.index_out(name)
            self._found[name] = np.zeros(self._solver.numel_out(place))
            self._buffer.set_res(place, self._found[name].data)
        bounds = {"lbx": made.low, "ubx": made.high, "lbg": made.low_rows, "ubg": made.high_rows}
        for name, values in bounds.items():
            self._given[name][:] = values
        self._started = False

    def __call__(self, state: np.ndarray, last: np.ndarray, disturbance: np.ndarray) -> np.ndarray:
        """Return the torques, (m,), from a state of the kernel, last torques and disturbances."""
        given, found, motion = self._given, self._found, self._motion
        size, width, torques = motion.size, motion.size + motion.inputs, found["x"][motion.size :]
        start = motion.start(state, last)
        if not self._started:
            given["x0"][:] = motion.idle(start, last)
            self._started = True
        given["lbx"][:size] = given["ubx"][:size] = start
        given["p"][:] = disturbance
        self._call()
        given["x0"][:] = shifted(found["x"], width, size)
        given["lam_x0"][:] = shifted(found["lam_x"], width, size)
        given["lam_g0"][:] = shifted(found["lam_g"], motion.height, 0)
        return torques[: motion.motors].copy()


def shifted(values: np.ndarray, width: int, tail: int) -> np.ndarray:
    """Return values one stage later; the last stage and what follows it stay."""
    end = len(values) - tail
    return np.concatenate([values[width:end], values[end - width : end], values[end:]])
