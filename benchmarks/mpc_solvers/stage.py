"""Functions of one stage with their derivatives, differentiated where it is cheap: at the acceleration.

CasADi differentiates the generated step, once; the rest is linear, and is put around it.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import casadi as ca

from mpc_solvers.motion import Motion

INPUTS = 3
"""Torque, slack of the tip, slack of the hub."""
MOST_STATEMENTS = 40_000
"""Of a Hessian as one C function: a compiler takes a minute for as many, and more than in proportion beyond."""


class Stage:
    """CasADi functions of state, inputs and disturbance."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self._x, self._u = ca.SX.sym("x", motion.size), ca.SX.sym("u", INPUTS)
        self._disturbance = ca.SX.sym("d")
        self._end = ca.SX.sym("a", motion.count)
        torque = motion.torque(self._x, self._u, self._disturbance)
        self._where = ca.vertcat(self._x[: 2 * motion.count], torque)
        self._given = [self._x, self._u, self._disturbance]
        self._free = ca.vertcat(self._x, self._u)

    @property
    def _after(self) -> Any:
        return self.motion.after(self._x, self._u, self._end)

    @cached_property
    def after(self) -> Any:
        """``(x, u, d) -> state a sample later``."""
        end = self.motion.acceleration(self._where[:-1], self._where[-1])
        return ca.Function("after", self._given, [ca.substitute(self._after, self._end, end)])

    @cached_property
    def rows(self) -> Any:
        """``(x, u, d) -> state a sample later, and what bounds bound there``."""
        end = self.motion.acceleration(self._where[:-1], self._where[-1])
        return ca.Function("rows", self._given, [ca.substitute(self._bounded, self._end, end)])

    @property
    def _bounded(self) -> Any:
        seen = self.motion.outputs(self._after)
        slacks = self._u[1], self._u[2]
        return ca.vertcat(
            self._after, seen["tip"] - slacks[0], seen["hub"] - slacks[1], seen["hub"] + slacks[1]
        )

    @cached_property
    def rows_slopes(self) -> Any:
        """``(x, u, d) -> rows, their Jacobian by x and u``."""
        return self._with_slopes("rows_slopes", self._bounded)

    @cached_property
    def after_slopes(self) -> Any:
        """``(x, u, d) -> state a sample later, its Jacobian by x and u``."""
        return self._with_slopes("after_slopes", self._after)

    def _with_slopes(self, name: str, rows: Any) -> Any:
        end, slopes = self._acceleration_slopes(self._where)
        by_end = ca.mtimes(ca.jacobian(rows, self._end), ca.mtimes(slopes, self._where_slopes))
        jacobian = ca.jacobian(rows, self._free) + by_end
        found = ca.cse([ca.substitute(rows, self._end, end), jacobian])
        return ca.Function(name, self._given, found)

    @cached_property
    def _where_slopes(self) -> Any:
        return ca.jacobian(self._where, self._free)

    @cached_property
    def _acceleration_slopes(self) -> Any:
        where = ca.SX.sym("where", 2 * self.motion.count + 1)
        end = self.motion.acceleration(where[:-1], where[-1])
        slopes = ca.densify(ca.jacobian(end, where))
        return ca.Function("acceleration_slopes", [where], ca.cse([end, slopes]))

    @cached_property
    def curvature(self) -> Any:
        """``(x, u, d, multipliers of the state a sample later) -> Hessian by x and u``, of SX or calls of such."""
        multipliers = ca.SX.sym("lam", self.motion.size)
        of_end = ca.mtimes(ca.jacobian(self._after, self._end).T, multipliers)
        where, weights = ca.SX.sym("where", self._where.numel()), ca.SX.sym("weights", self.motion.count)
        value = ca.dot(weights, self.motion.acceleration(where[:-1], where[-1]))
        hessian, gradient = ca.hessian(value, where)
        whole = ca.Function("curvature_of_end", [where, weights], ca.cse([ca.densify(hessian)]))
        if whole.n_instructions() > MOST_STATEMENTS:
            whole = _by_columns(gradient, where, weights)
        places = ca.Function("places", [*self._given, multipliers], [self._where, of_end])
        x, u, d, lam = (ca.MX.sym(name, size) for name, size in self._sizes)
        slopes = ca.DM(ca.Function("slopes", [], [self._where_slopes])()["o0"])
        inner = whole(*places(x, u, d, lam))
        return ca.Function("curvature", [x, u, d, lam], [ca.mtimes(slopes.T, ca.mtimes(inner, slopes))])

    @property
    def _sizes(self) -> list[tuple[str, int]]:
        return [("x", self.motion.size), ("u", INPUTS), ("d", 1), ("lam", self.motion.size)]


def _by_columns(gradient: Any, where: Any, weights: Any) -> Any:
    """Return a Hessian whose columns are calls of one function: a little more work, far less code."""
    size = where.numel()
    direction = ca.SX.sym("direction", size)
    column = ca.jtimes(gradient, where, direction)
    one = ca.Function("column", [where, weights, direction], ca.cse([column]))
    at, by = ca.MX.sym("where", size), ca.MX.sym("weights", weights.numel())
    columns = one.map(size)(ca.repmat(at, 1, size), ca.repmat(by, 1, size), ca.MX(ca.DM.eye(size)))
    return ca.Function("curvature_of_end", [at, by], [columns])
