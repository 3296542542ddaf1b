"""Functions of one stage with their derivatives, differentiated where it is cheap: at the acceleration.

CasADi, or in space the step's own tangents, differentiate the generated step, once; the rest is put around it.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import casadi as ca

from mpc_solvers.compiled import External, external
from mpc_solvers.motion import Motion

MOST_STATEMENTS = 40_000
"""Of a Hessian as one C function: a compiler takes a minute for as many, and more than in proportion beyond."""


class Stage:
    """CasADi functions of state, inputs and disturbances.

    Parameters
    ----------
    motion : Motion
        The step.
    apart : bool
        Whether the step's derivatives are compiled apart, once for all solvers: where there are many.
    """

    def __init__(self, motion: Motion, apart: bool = False) -> None:
        self.motion, self.apart = motion, apart
        self._x, self._u = ca.SX.sym("x", motion.size), ca.SX.sym("u", motion.inputs)
        self._disturbance = ca.SX.sym("d", motion.motors)
        self._end = ca.SX.sym("a", motion.count)
        torque = motion.torque(self._x, self._u, self._disturbance)
        self._where = ca.vertcat(self._x[: 2 * motion.count], torque)
        self._given = [self._x, self._u, self._disturbance]
        self._free = ca.vertcat(self._x, self._u)

    @property
    def _after(self) -> Any:
        return self.motion.after(self._x, self._u, self._end)

    @property
    def _walls(self) -> Any:
        return self.motion.walls(self._x[: self.motion.count], self._end)

    def _stepped(self, name: str, rows: Any) -> Any:
        """Return a function of what depends on the acceleration."""
        split = 2 * self.motion.count
        end = self.motion.acceleration(self._where[:split], self._where[split:])
        return ca.Function(name, self._given, [ca.substitute(rows, self._end, end)])

    @cached_property
    def after(self) -> Any:
        """``(x, u, d) -> state a sample later, places at walls there``."""
        return self._stepped("after", ca.vertcat(self._after, self._walls))

    @cached_property
    def rows(self) -> Any:
        """``(x, u, d) -> state a sample later, and what bounds bound there``."""
        return self._stepped("rows", self._bounded)

    @property
    def _bounded(self) -> Any:
        bounds = self.motion.bounds(self._after, self._walls, self._u)
        return ca.vertcat(self._after, *(bound.row for bound in bounds))

    @cached_property
    def rows_slopes(self) -> Any:
        """``(x, u, d) -> rows, their Jacobian by x and u``."""
        return self._with_slopes("rows_slopes", self._bounded)

    @cached_property
    def after_slopes(self) -> Any:
        """``(x, u, d) -> state a sample later, places at walls there, their Jacobian by x and u``."""
        return self._with_slopes("after_slopes", ca.vertcat(self._after, self._walls))

    @cached_property
    def _acceleration_slopes(self) -> External | None:
        return external(self.motion.acceleration_slopes) if self.apart else None

    @property
    def linked(self) -> tuple[str, ...]:
        """Options for a compiler of what calls these functions."""
        return self._acceleration_slopes.options if self._acceleration_slopes else ()

    def _with_slopes(self, name: str, rows: Any) -> Any:
        slopes = ca.SX.sym("slopes", self.motion.count, self._where.numel())
        by_end = ca.mtimes(ca.jacobian(rows, self._end), ca.mtimes(slopes, self._where_slopes))
        found = [rows, ca.jacobian(rows, self._free) + by_end]
        around = ca.Function("around", [*self._given, self._end, slopes], ca.cse(found))
        if self._acceleration_slopes is None:
            inner = self.motion.acceleration_slopes(self._where)
            return ca.Function(name, self._given, ca.cse(list(around(*self._given, *inner))))
        given = [ca.MX.sym(name, size) for name, size in self._sizes[:3]]
        where = ca.Function("where", self._given, [self._where])
        inner = self._acceleration_slopes.function(where(*given))
        return ca.Function(name, given, [*around(*given, *inner)])

    @cached_property
    def _where_slopes(self) -> Any:
        return ca.jacobian(self._where, self._free)

    @cached_property
    def curvature(self) -> Any:
        """``(x, u, d, multipliers of what is after it) -> Hessian by x and u``, of SX or calls of such."""
        motion, size = self.motion, self.motion.size
        multipliers = ca.SX.sym("lam", size + motion.kept)
        of_end = ca.mtimes(ca.jacobian(self._after, self._end).T, multipliers[:size])
        where = ca.SX.sym("where", self._where.numel())
        weights = ca.SX.sym("weights", motion.count + motion.kept)
        end = motion.acceleration(where[: 2 * motion.count], where[2 * motion.count :])
        walls = motion.walls(where[: motion.count], end)
        gradient = ca.gradient(ca.dot(weights, ca.vertcat(end, walls)), where)
        places = ca.Function(
            "places", [*self._given, multipliers], [self._where, ca.vertcat(of_end, multipliers[size:])]
        )
        x, u, d, lam = (ca.MX.sym(name, size) for name, size in self._sizes)
        slopes = ca.DM(ca.Function("slopes", [], [self._where_slopes])()["o0"])
        inner = _hessian(gradient, where, weights)(*places(x, u, d, lam))
        return ca.Function("curvature", [x, u, d, lam], [ca.mtimes(slopes.T, ca.mtimes(inner, slopes))])

    @property
    def _sizes(self) -> list[tuple[str, int]]:
        motion = self.motion
        return [
            ("x", motion.size),
            ("u", motion.inputs),
            ("d", motion.motors),
            ("lam", motion.size + motion.kept),
        ]


def _hessian(gradient: Any, where: Any, weights: Any) -> Any:
    """Return the Jacobian of a gradient as one function, or column by column where that would be too long."""
    if ca.Function("gradient", [where, weights], [gradient]).n_instructions() < MOST_STATEMENTS / 4:
        whole = ca.Function(
            "curvature_of_end", [where, weights], ca.cse([ca.densify(ca.jacobian(gradient, where))])
        )
        if whole.n_instructions() <= MOST_STATEMENTS:
            return whole
    return _by_columns(gradient, where, weights)


def _by_columns(gradient: Any, where: Any, weights: Any) -> Any:
    """Return a Hessian whose columns are calls of one function: a little more work, far less code."""
    size = where.numel()
    direction = ca.SX.sym("direction", size)
    column = ca.jtimes(gradient, where, direction)
    one = ca.Function("column", [where, weights, direction], ca.cse([column]))
    at, by = ca.MX.sym("where", size), ca.MX.sym("weights", weights.numel())
    columns = one.map(size)(ca.repmat(at, 1, size), ca.repmat(by, 1, size), ca.MX(ca.DM.eye(size)))
    return ca.Function("curvature_of_end", [at, by], [columns])
