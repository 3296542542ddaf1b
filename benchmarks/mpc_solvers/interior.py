"""fatrop: an interior point method for problems in stages, to convergence at every sample, from the last solution.

CasADi's interface takes no derivatives as options, but it looks for functions in a library. The Hessian is that of
Gauss and Newton, as with sqpmethod: it is constant.
"""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from mpc_solvers.compiled import library
from mpc_solvers.sequential import Horizon, horizon, shifted
from mpc_solvers.stage import Stage

OPTIONS: dict[str, Any] = {
    "print_level": 0,
    "tol": 1e-6,
    # the last solution is where to start: in the plane it takes twice the iterations from its own first one
    "mu_init": 1e-6,
}


class Fatrop:
    """Solves sample after sample, each from the last solution shifted by one.

    Parameters
    ----------
    stage : Stage
        The task.
    options : dict, optional
        Of fatrop.
    """

    def __init__(self, stage: Stage, options: dict[str, Any] = OPTIONS) -> None:
        self._motion = motion = stage.motion
        made = horizon(stage, stage.rows_slopes)

        def write(path: str) -> None:
            generator = ca.CodeGenerator(path)
            for function in functions(stage, made):
                generator.add(function)
            generator.generate()

        size, count = motion.size, motion.problem.horizon
        self._solver = ca.nlpsol(
            "nmpc",
            "fatrop",
            str(library(write, "nlp", stage.linked)),
            {
                "structure_detection": "auto",
                "equality": [True] * size + ([True] * size + [False] * len(motion.bounded)) * count,
                **{"print_time": False, "calc_lam_p": False, "error_on_fail": False},
                "fatrop": options,
            },
        )
        self._bounds = {"lbx": made.low, "ubx": made.high}
        for name, rows in (("lbg", made.low_rows), ("ubg", made.high_rows)):
            self._bounds[name] = np.append(np.zeros(size), rows)
        self._guess: dict[str, np.ndarray] = {}

    def __call__(self, state: np.ndarray, last: np.ndarray, disturbance: np.ndarray) -> np.ndarray:
        """Return the torques, (m,), from a state of the kernel, last torques and disturbances."""
        motion, size = self._motion, self._motion.size
        start = motion.start(state, last)
        if not self._guess:
            self._guess = {"x0": motion.idle(start, last)}
        found = self._solver(**self._guess, **self._bounds, p=np.append(start, disturbance))
        x, lam_x, lam_g = (np.array(found[name]).ravel() for name in ("x", "lam_x", "lam_g"))
        width = size + motion.inputs
        self._guess = {
            "x0": shifted(x, width, size),
            "lam_x0": shifted(lam_x, width, size),
            "lam_g0": np.append(lam_g[:size], shifted(lam_g[size:], motion.height, 0)),
        }
        return x[size : size + motion.motors]


def functions(stage: Stage, made: Horizon) -> list[Any]:
    """Return what fatrop looks for; parameters are the state at the start and the disturbances.

    It wants ``x_after - F(x, u)``; and as it has no bounds that are equal, rows hold the state at the start.
    """
    motion, x = stage.motion, made.problem["x"]
    size, p = motion.size, ca.MX.sym("p", motion.size + motion.motors)
    turned = ca.DM(np.tile([*np.full(size, -1.0), *np.ones(len(motion.bounded))], motion.problem.horizon))
    at_start = x[:size] - p[:size]
    first = ca.horzcat(ca.MX(ca.DM.eye(size)), ca.MX(size, x.numel() - size))
    value, gradient, rows, slopes = made.slopes(x, p[size:])
    jacobian = ca.vertcat(first, ca.mtimes(ca.diag(turned), slopes))
    plain = ca.Function("plain", [x, made.problem["p"]], [made.problem["f"], made.problem["g"]])
    f, g = plain(x, p[size:])
    g = ca.vertcat(at_start, turned * g)
    factor, multipliers = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", g.numel())
    hessian = ca.MX(ca.DM(made.hessian(0.0, 0.0, 1.0, 0.0)))
    lagrangian = factor * gradient + ca.mtimes(jacobian.T, multipliers)
    short, long = (["x", "p"], ["x", "p", "lam_f", "lam_g"])

    def function(name: str, found: dict[str, Any], names: list[str] = short) -> Any:
        given = dict(zip(long, [x, p, factor, multipliers], strict=True))
        return ca.Function(name, [given[each] for each in names], [*found.values()], names, [*found])

    none = ca.MX(1, p.numel())
    return [
        function("nlp", {"f": f, "g": g}),
        function("nlp_f", {"f": f}),
        function("nlp_g", {"g": g}),
        function("nlp_grad_f", {"grad_f_x": gradient}),
        function("nlp_jac_g", {"g": ca.vertcat(at_start, turned * rows), "jac_g_x": jacobian}),
        function("nlp_grad", {"f": value, "g": g, "grad_gamma_x": lagrangian, "grad_gamma_p": none}, long),
        function("nlp_hess_l", {"grad_gamma_x": lagrangian, "hess_gamma_x_x": factor * hessian}, long),
    ]
