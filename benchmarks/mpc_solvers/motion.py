"""The generated step in coordinates of two thirds the size: what a solver that stacks states should be given.

Newmark's step of constant average acceleration advances (q, q', q''), but it is implicit in two combinations alone,

    z = q + h q' + h^2/4 q'',   z' = q' + h/2 q'',

and with the acceleration a at its end these follow from themselves: ``z' <- z' + h a``, then ``z <- z + h z'``. Angles
and rates come back from two successive values. Jacobians and Hessians have a third less rows and columns, and no
entries of the size of accelerations, which cost IPOPT four times the iterations.

In the plane the kernel's one Newton iteration for a starts from the last acceleration, which is no more known here; it
starts from none. That is the only difference: 1e-6 rad in a sample of the task, 2e-4 rad at the end of the horizon. In
space the kernel predicts with z and z' alone, and there is none.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from tmm_gen.control.bench import Bench
from tmm_gen.control.prediction.links import rest_state
from tmm_gen.control.quadratic.terminal import end_rows
from tmm_gen.native.python_module import casadi_module


@dataclass(frozen=True)
class Bound:
    """A row that is bounded on one side, its slack included, by a number; the other side is infinite."""

    name: str
    row: Any
    low: float
    high: float


class Motion:
    """One sample of the generated step.

    A state is z, z', the last torques, and of a step before z' at tips and hubs, (2 n + 3 m,) for n angles and m
    motors; inputs are the torques and a slack of each kind of soft bound.

    Raises
    ------
    ValueError
        If the step is not that of average acceleration, once a sample, or torques may not change at any rate.
    """

    def __init__(self, bench: Bench) -> None:
        self.bench, self.step, self.problem = bench, bench.step, bench.problem
        integrator = bench.step.scene.integrator
        given = integrator.parameters
        rule = (integrator.name, given.get("beta", 0.25), given.get("gamma", 0.5))
        if bench.problem.substeps != 1 or rule != ("newmark", 0.25, 0.5):
            raise ValueError(f"needs one step of newmark with beta 1/4, gamma 1/2 a sample, not {rule}")
        self.kinds = bench.problem.kinds(bench.links.goal)
        if not all(kind.soft for kind in self.kinds):
            raise ValueError("needs torques that may change at any rate")
        self.h = bench.problem.step
        self.angles, self.rates, self.accelerations = (
            self.step.places(quantity) for quantity in ("angle", "rate", "acceleration")
        )
        self.count, self.motors = len(self.angles), bench.problem.count
        self.size = 2 * self.count + 3 * self.motors
        self.inputs = self.motors + len(self.kinds)
        self.kept = len(bench.problem.keeps)

    @cached_property
    def rows(self) -> dict[str, np.ndarray]:
        """What gives tips and hubs from all angles, (m, n) each."""
        motors = self.step.motors
        return {"tip": motors.tip, "hub": motors.hub}

    @cached_property
    def _module(self) -> Any:
        """The generated module of an arm in space: with its tangents, and where what is kept from walls is."""
        keeps = self.problem.keeps
        seen = [{"name": f"keep_{k}", "at": keep.frame, "of": "position"} for k, keep in enumerate(keeps)]
        changes: dict[str, object] = {"emit.sensitivities": True}
        return casadi_module(self.step.scene.replace(**changes, **({"output": seen} if seen else {})))

    @cached_property
    def _parameters(self) -> np.ndarray:
        """Of that module."""
        values = np.array(self._module.default_parameters(), float).ravel()
        values[0] = self.h
        return values

    def start(self, state: np.ndarray, last: Any) -> np.ndarray:
        """Return the coordinates of a state of the kernel, with the last torques, (m,)."""
        angle, rate, acceleration = (
            state[places] for places in (self.angles, self.rates, self.accelerations)
        )
        later = rate + self.h / 2 * acceleration
        before = rate - self.h / 2 * acceleration
        ahead = angle + self.h * rate + self.h**2 / 4 * acceleration
        memory = [row @ before for row in self.rows.values()]
        return np.concatenate([ahead, later, np.ravel(last), *memory])

    def idle(self, start: np.ndarray, last: np.ndarray) -> np.ndarray:
        """Return states and inputs, stage by stage, of an arm that stays as it is under the last torques."""
        inputs = np.append(last, np.zeros(self.inputs - self.motors))
        return np.append(np.tile(np.append(start, inputs), self.problem.horizon), start)

    @cached_property
    def acceleration(self) -> Any:
        """``(z and z', torques) -> a``, a CasADi function of SX: all of the step that is not linear."""
        z, w = ca.SX.sym("z", 2 * self.count), ca.SX.sym("w", self.motors)
        after = self.step.sample(self._kernel_state(z), ca.vertcat(w, w))
        return ca.Function("acceleration", [z, w], [after[self.accelerations]])

    def _kernel_state(self, z: Any) -> Any:
        """Return a state of the kernel, without accelerations, that has these z and z'; or columns of changes."""
        state = [ca.SX(1, z.shape[1])] * self.step.size
        for place, (angle, rate) in enumerate(zip(self.angles, self.rates, strict=True)):
            later = z[self.count + place, :]
            state[angle], state[rate] = z[place, :] - self.h * later, later
        return ca.vertcat(*state)

    @cached_property
    def acceleration_slopes(self) -> Any:
        """``(z, z' and torques) -> a, its Jacobian``, a CasADi function of SX.

        In space by the step's own tangents, for fewer operations than CasADi's own derivatives take; in the plane there
        are so few that it does not matter.
        """
        where = ca.SX.sym("where", 2 * self.count + self.motors)
        z, torques = where[: 2 * self.count], where[2 * self.count :]
        end = self.acceleration(z, torques)
        if self.step.scene.spatial is None:
            slopes = ca.jacobian(end, where)
        else:
            every = ca.SX.eye(where.numel())
            tangent, p = self._module.tangent_function(where.numel()), self._parameters
            given = self._kernel_state(z), self.step.inputs(torques), p
            changes = (
                self._kernel_state(every[: 2 * self.count, :]),
                self.step.inputs(every[2 * self.count :, :]),
            )
            slopes = tangent(*given, *changes)[self.accelerations, :]
        return ca.Function("acceleration_slopes", [where], ca.cse([end, ca.densify(slopes)]))

    @cached_property
    def places(self) -> Any:
        """``angles -> how far along the normals of walls what is kept from them is``, (w,), a CasADi function of SX."""
        angles, state = ca.SX.sym("q", self.count), [ca.SX(0.0)] * self.step.size
        for place, angle in enumerate(self.angles):
            state[angle] = angles[place]
        found = ca.SX(0, 1)
        if self.kept:
            still = ca.DM.zeros(len(self._module.INPUT_NAMES))
            seen = self._module.step_function()(ca.vertcat(*state), still, self._parameters)[1]
            for k, keep in enumerate(self.problem.keeps):
                normal = np.array(keep.normal) / np.linalg.norm(keep.normal)
                found = ca.vertcat(found, ca.dot(ca.DM(normal), seen[3 * k : 3 * k + 3]))
        return ca.Function("places", [angles], [found])

    def walls(self, z: Any, acceleration: Any) -> Any:
        """Return the same a sample after a z, if it ends with an acceleration."""
        return self.places(z + self.h**2 / 4 * acceleration)

    def torque(self, x: Any, u: Any, disturbance: Any) -> Any:
        """Return what acts in a sample."""
        share = float(self.step.delay.shares(1)[0])
        return share * self._last(x) + (1.0 - share) * u[: self.motors] + disturbance

    def _last(self, x: Any) -> Any:
        return x[2 * self.count : 2 * self.count + self.motors]

    def after(self, x: Any, u: Any, acceleration: Any) -> Any:
        """Return the state a sample later, if it ends with an acceleration."""
        later = x[self.count : 2 * self.count]
        new = later + self.h * acceleration
        memory = [ca.mtimes(ca.DM(row), later) for row in self.rows.values()]
        return ca.vertcat(x[: self.count] + self.h * new, new, u[: self.motors], *memory)

    def outputs(self, x: Any) -> dict[str, Any]:
        """Return tips, hubs and their rates in a state, (m,) each, all linear in it."""
        ahead, later = x[: self.count], x[self.count : 2 * self.count]
        found, begin = {}, 2 * self.count + self.motors
        for name, row in self.rows.items():
            before, now = x[begin : begin + self.motors], ca.mtimes(ca.DM(row), later)
            found[name] = ca.mtimes(ca.DM(row), ahead) - self.h * (0.75 * now + 0.25 * before)
            found[f"{name}_rate"] = 0.5 * (now + before)
            begin += self.motors
        return found

    def bounds(self, x: Any, walls: Any, u: Any) -> list[Bound]:
        """Return what is bounded in a state, (s,), with its places at walls, (w,), by the slacks of an input."""
        seen, found = self.outputs(x), []
        for number, kind in enumerate(self.kinds):
            slack = u[self.motors + number]
            value = walls[kind.motor] if kind.what == "keep" else seen[kind.what][kind.motor]
            name = f"{kind.what}_{kind.motor}"
            if np.isfinite(kind.high):
                found.append(Bound(f"{name}_high", value - slack, -np.inf, kind.high))
            if np.isfinite(kind.low):
                found.append(Bound(f"{name}_low", value + slack, kind.low, np.inf))
        return found

    @cached_property
    def bounded(self) -> list[Bound]:
        """The bounds, of symbols."""
        sizes = {"x": self.size, "w": self.kept, "u": self.inputs}
        return self.bounds(*(ca.SX.sym(name, size) for name, size in sizes.items()))

    @property
    def height(self) -> int:
        """Rows of a stage: the state after it and what is bounded there."""
        return self.size + len(self.bounded)

    def state_cost(self, x: Any) -> Any:
        """Return what a state costs."""
        goal, weights = self.bench.links.goal, vars(self.problem.weights)
        targets = {"tip": goal.tip, "hub": goal.hub}
        return 0.5 * sum(
            _weighed(weights[name], value - ca.DM(targets[name]) if name in targets else value)
            for name, value in self.outputs(x).items()
        )

    def cost_to_go(self, x: Any, disturbance: Any) -> Any:
        """Return what a state still costs after it; the same for all states of the kernel with its z and z'."""
        end = end_rows(self.bench.links, self.problem.weights)
        rest = rest_state(self.step, self.bench.links)[self.angles]
        ahead, later = x[: self.count], x[self.count : 2 * self.count]
        left = ca.mtimes(end[:, self.angles], ahead - self.h * later - rest)
        left += ca.mtimes(end[:, self.rates], later)
        left += ca.mtimes(end[:, -self.motors :], self._last(x) + disturbance - self.bench.links.goal.torque)
        return 0.5 * ca.sumsqr(left)

    def input_cost(self, x: Any, u: Any, disturbance: Any) -> Any:
        """Return what torques, their change and all slacks cost."""
        weights, torques = self.problem.weights, u[: self.motors]
        slacks = np.array([kind.weight for kind in self.kinds])
        return 0.5 * (
            _weighed(weights.torque, torques - self.bench.links.goal.torque + disturbance)
            + _weighed(weights.torque_step, torques - self._last(x))
            + _weighed(slacks, u[self.motors :])
        )


def _weighed(weights: np.ndarray, values: Any) -> Any:
    """Return the weighed sum of squares."""
    return ca.dot(ca.DM(weights), values**2)
