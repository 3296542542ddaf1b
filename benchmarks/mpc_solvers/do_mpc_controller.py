"""do-mpc with IPOPT: as its documentation has it, and as fast as it was got."""

from __future__ import annotations

import contextlib
import io
import warnings
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from mpc_solvers.compiled import library
from mpc_solvers.scatter import scattered
from mpc_solvers.stage import Stage

QUIET: dict[str, Any] = {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": 0}
PUSHES = (
    *("warm_start_bound_push", "warm_start_bound_frac", "warm_start_mult_bound_push"),
    *("warm_start_slack_bound_push", "warm_start_slack_bound_frac"),
)
TUNED: dict[str, Any] = {
    **QUIET,
    "ipopt.tol": 1e-6,
    # the last solution is where to start; by its own options IPOPT moves away from all bounds first
    "ipopt.warm_start_init_point": "yes",
    "ipopt.mu_init": 1e-4,
    "ipopt.mu_strategy": "adaptive",
    **{f"ipopt.{name}": 1e-8 for name in PUSHES},
    # of the matrix; the problem is scaled
    "ipopt.mumps_permuting_scaling": 0,
    "ipopt.mumps_scaling": 0,
}


class DoMpc:
    """Solves sample after sample.

    Parameters
    ----------
    stage : Stage
        The task.
    tuned : bool
        Whether derivatives are assembled stage by stage, everything is compiled, and IPOPT starts from the last
        multipliers with the options `TUNED`; or all is as do-mpc has it.
    """

    def __init__(self, stage: Stage, tuned: bool) -> None:
        self._motion = stage.motion
        self.controller, self._template = _controller(stage, "MX" if tuned else "SX")
        if tuned:
            self.controller.S = ca.nlpsol("S", "ipopt", str(_compiled(stage, self.controller)), TUNED)
        self._started = False

    def __call__(self, state: np.ndarray, last: np.ndarray, disturbance: np.ndarray) -> np.ndarray:
        """Return the torques, (m,), from a state of the kernel, last torques and disturbances."""
        motion = self._motion
        self._template["_p", 0, "d"] = disturbance
        places = np.array(motion.places(state[motion.angles])).ravel()
        start = np.append(motion.start(state, last), places)
        if not self._started:
            idle = np.zeros(motion.inputs)
            idle[: motion.motors] = last
            self.controller.x0, self.controller.u0 = start, idle
            self.controller.set_initial_guess()
            self._started = True
        with contextlib.redirect_stdout(io.StringIO()):
            return np.array(self.controller.make_step(start[:, None])[: motion.motors, 0])


def _compiled(stage: Stage, controller: Any) -> Path:
    """Do what do-mpc's ``compile_nlp`` does, with better derivatives; its own fails in version 5.1.2."""
    programme = controller.nlp
    jacobian, hessian = derivatives(stage, controller)
    solver = ca.nlpsol("S", "ipopt", programme, {**TUNED, "jac_g": jacobian, "hess_lag": hessian})

    def write(path: str) -> None:
        generator = ca.CodeGenerator(path)
        generator.add(ca.Function("nlp", programme, ["x", "p"], ["f", "g"]))
        for name in ("nlp_f", "nlp_g", "nlp_grad", "nlp_grad_f", "nlp_jac_g", "nlp_hess_l"):
            generator.add(solver.get_function(name))
        generator.generate()

    return library(write, "nlp", stage.linked)


def _controller(stage: Stage, kind: str) -> tuple[Any, Any]:
    """Return do-mpc's controller, set up, and where it looks for the disturbance."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import do_mpc

    motion, problem = stage.motion, stage.motion.problem
    model = do_mpc.model.Model("discrete", kind)
    # it bounds a state and not what comes after it: places at walls, of accelerations there, are states here
    whole = model.set_variable("_x", "x", shape=(motion.size + motion.kept, 1))
    u = model.set_variable("_u", "u", shape=(motion.inputs, 1))
    disturbance = model.set_variable("_p", "d", shape=(motion.motors, 1))
    model.set_rhs("x", stage.after(whole[: motion.size], u, disturbance))
    model.setup()
    x, walls = whole[: motion.size], whole[motion.size :]  # setting up made other symbols of them
    controller = do_mpc.controller.MPC(model)
    controller.set_param(
        n_horizon=problem.horizon,
        t_step=problem.sample_time,
        n_robust=0,
        store_full_solution=False,
        nlpsol_opts=QUIET,
    )
    running = motion.state_cost(x) + motion.input_cost(x, u, disturbance)
    controller.set_objective(mterm=motion.state_cost(x) + motion.cost_to_go(x, disturbance), lterm=running)
    controller.set_rterm(u=np.zeros(motion.inputs))
    for side, value in zip(("lower", "upper"), problem.torque, strict=True):
        beyond = -np.inf if side == "lower" else np.inf
        slacks = np.full(motion.inputs - motion.motors, beyond)
        controller.bounds[side, "_u", "u"] = np.append(value, slacks)
    for bound in motion.bounds(x, walls, u):
        above = np.isfinite(bound.high)
        controller.set_nl_cons(bound.name, *((bound.row, bound.high) if above else (-bound.row, -bound.low)))
    template = controller.get_p_template(1)
    controller.set_p_fun(lambda _: template)
    controller.setup()
    return controller, template


def derivatives(stage: Stage, controller: Any) -> tuple[Any, Any]:
    """Return Jacobian and Hessian of do-mpc's programme as IPOPT asks for them, put together from those of a stage.

    CasADi's own would colour the whole horizon and carry forty directions through each stage.
    """
    programme, motion, count = controller.nlp, stage.motion, stage.motion.problem.horizon
    size, wide = motion.size, motion.size + motion.kept
    point, given = programme["x"].numel(), programme["p"].numel()
    x, p = ca.MX.sym("x", point), ca.MX.sym("p", given)
    places = controller.opt_x(np.arange(point))
    columns = [
        np.concatenate([_whole(places["_x", k, 0, -1])[:size], _whole(places["_u", k, 0])])
        for k in range(count)
    ]
    # rows: the initial state, then stage by stage the state after it and its bounds
    rows = [np.arange(wide) + wide + k * (wide + len(motion.bounded)) for k in range(count)]
    table = ca.horzcat(*(x[part.tolist()] for part in columns))
    disturbance = p[_whole(controller.opt_p(np.arange(given))["_p", 0, "d"]).tolist()]
    stages = [table[:size, :], table[size:, :], ca.repmat(disturbance, 1, count)]

    symbols = [programme["x"], programme["p"]]
    constraints = ca.Function("g", symbols, [programme["g"]])
    linear = ca.Function("linear", symbols, [ca.jacobian(programme["g"], programme["x"])])
    held = ca.DM(linear(np.zeros(point), np.zeros(given)))
    for row, column in zip(rows, columns, strict=True):
        held[row.tolist(), column.tolist()] = 0.0
    slopes = stage.after_slopes
    jacobian = scattered(
        slopes.map(count)(*stages)[1], slopes.sparsity_out(1), rows, columns, ca.sparsify(held)
    )

    factor, multipliers = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", programme["g"].numel())
    quadratic = ca.Function("quadratic", symbols, [ca.hessian(programme["f"], programme["x"])[0]])
    curved = ca.sparsify(ca.DM(quadratic(np.zeros(point), np.zeros(given))))
    weights = ca.horzcat(*(multipliers[row.tolist()] for row in rows))
    bent = scattered(
        stage.curvature.map(count)(*stages, weights),
        *(stage.curvature.sparsity_out(0), columns, columns, ca.DM(point, point)),
    )
    return (
        ca.Function("nlp_jac_g", [x, p], [constraints(x, p), jacobian], ["x", "p"], ["g", "jac_g_x"]),
        ca.Function(
            "nlp_hess_l",
            [x, p, factor, multipliers],
            [ca.triu(bent + factor * curved)],
            ["x", "p", "lam_f", "lam_g"],
            ["triu_hess_gamma_x_x"],
        ),
    )


def _whole(values: Any) -> np.ndarray:
    return np.array(values).ravel().astype(int)
