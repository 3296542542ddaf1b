"""The generated step in coordinates of two thirds the size: what a solver that stacks states should be given.

Newmark's step of constant average acceleration advances (q, q', q''), but it is implicit in two combinations alone,

    z = q + h q' + h^2/4 q'',   z' = q' + h/2 q'',

and with the acceleration a at its end these follow from themselves: ``z' <- z' + h a``, then ``z <- z + h z'``. Angles
and rates come back from two successive values. Jacobians and Hessians have a third less rows and columns, and no
entries of the size of accelerations, which cost IPOPT four times the iterations.

The kernel's one Newton iteration for a starts from the last acceleration, which is no more known here; it starts from
none. That is the only difference: 1e-6 rad in a sample of the task, 2e-4 rad at the end of the horizon.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from tmm_gen.control.bench import Bench
from tmm_gen.control.links import rest_state
from tmm_gen.control.terminal import end_rows


class Motion:
    """One sample of the generated step.

    A state is z, z', the last torque, and z' of a step before at tip and hub, (2 m + 3,) for m - 1 links.

    Raises
    ------
    ValueError
        If the step is not that of average acceleration, once a sample.
    """

    def __init__(self, bench: Bench) -> None:
        self.bench, self.step = bench, bench.step
        integrator = bench.step.scene.integrator
        rule = (integrator.name, integrator.parameters.get("beta"), integrator.parameters.get("gamma"))
        if bench.problem.substeps != 1 or rule != ("newmark", 0.25, 0.5):
            raise ValueError(f"needs one step of newmark with beta 1/4, gamma 1/2 a sample, not {rule}")
        self.h = bench.problem.step
        self.angles, self.rates, self.accelerations = (
            self.step.places(quantity) for quantity in ("angle", "rate", "acceleration")
        )
        self.count = len(self.angles)
        self.size = 2 * self.count + 3

    @cached_property
    def rows(self) -> dict[str, np.ndarray]:
        """What gives tip and hub from all angles."""
        motors = self.step.motors
        return {"tip": motors.tip[0], "hub": motors.hub[0]}

    @property
    def bounds(self) -> tuple[float, float, float]:
        """Highest tip angle, lowest and highest hub angle, rad."""
        kinds = {kind.what: kind for kind in self.bench.problem.kinds(self.bench.links.goal)}
        return kinds["tip"].high, kinds["hub"].low, kinds["hub"].high

    @cached_property
    def weights(self) -> dict[str, float]:
        """Of the cost, of the only motor."""
        return {name: float(value[0]) for name, value in vars(self.bench.problem.weights).items()}

    def start(self, state: np.ndarray, last: float) -> np.ndarray:
        """Return the coordinates of a state of the kernel."""
        angle, rate, acceleration = (
            state[places] for places in (self.angles, self.rates, self.accelerations)
        )
        later = rate + self.h / 2 * acceleration
        before = rate - self.h / 2 * acceleration
        ahead = angle + self.h * rate + self.h**2 / 4 * acceleration
        return np.concatenate([ahead, later, [last], [row @ before for row in self.rows.values()]])

    @cached_property
    def acceleration(self) -> Any:
        """``(z and z', torque) -> a``, a CasADi function of SX: all of the step that is not linear."""
        z, w = ca.SX.sym("z", 2 * self.count), ca.SX.sym("w")
        state = [ca.SX(0.0)] * self.step.size
        for place, (angle, rate) in enumerate(zip(self.angles, self.rates, strict=True)):
            later = z[self.count + place]
            state[angle], state[rate] = z[place] - self.h * later, later
        after = self.step.sample(ca.vertcat(*state), ca.vertcat(w, w))
        return ca.Function("acceleration", [z, w], [after[self.accelerations]])

    def torque(self, x: Any, u: Any, disturbance: Any) -> Any:
        """Return what acts in a sample."""
        share = float(self.step.delay.shares(1)[0])
        return share * x[2 * self.count] + (1.0 - share) * u[0] + disturbance

    def after(self, x: Any, u: Any, acceleration: Any) -> Any:
        """Return the state a sample later, if it ends with an acceleration."""
        later = x[self.count : 2 * self.count]
        new = later + self.h * acceleration
        memory = [ca.dot(ca.DM(row), later) for row in self.rows.values()]
        return ca.vertcat(x[: self.count] + self.h * new, new, u[0], *memory)

    def outputs(self, x: Any) -> dict[str, Any]:
        """Return tip, hub and their rates in a state, all linear in it."""
        ahead, later = x[: self.count], x[self.count : 2 * self.count]
        found = {}
        for place, (name, row) in enumerate(self.rows.items()):
            before, now = x[2 * self.count + 1 + place], ca.dot(ca.DM(row), later)
            found[name] = ca.dot(ca.DM(row), ahead) - self.h * (0.75 * now + 0.25 * before)
            found[f"{name}_rate"] = 0.5 * (now + before)
        return found

    def state_cost(self, x: Any) -> Any:
        """Return what a state costs."""
        goal = self.bench.links.goal
        targets = {"tip": float(goal.tip[0]), "hub": float(goal.hub[0])}
        return 0.5 * sum(
            self.weights[name] * (value - targets.get(name, 0.0)) ** 2
            for name, value in self.outputs(x).items()
        )

    def cost_to_go(self, x: Any, disturbance: Any) -> Any:
        """Return what a state still costs after it; the same for all states of the kernel with its z and z'."""
        end = end_rows(self.bench.links, self.bench.problem.weights)
        rest = rest_state(self.step, self.bench.links)[self.angles]
        ahead, later = x[: self.count], x[self.count : 2 * self.count]
        left = ca.mtimes(end[:, self.angles], ahead - self.h * later - rest)
        left += ca.mtimes(end[:, self.rates], later)
        left += ca.mtimes(end[:, -1:], x[2 * self.count] + disturbance)
        return 0.5 * ca.sumsqr(left)

    def input_cost(self, x: Any, u: Any, disturbance: Any) -> Any:
        """Return what torque, its change and both slacks cost."""
        weights = self.weights
        return 0.5 * (
            weights["torque"] * (u[0] + disturbance) ** 2
            + weights["torque_step"] * (u[0] - x[2 * self.count]) ** 2
            + weights["overshoot"] * u[1] ** 2
            + weights["hub_bound"] * u[2] ** 2
        )
