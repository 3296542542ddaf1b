"""A sample under torques that are held, with first and second derivatives by the generated step's own tangent.

With ``f`` the step, ``z`` a state and torques and ``t(z, v) = f'(z) v`` the generated tangent, a weighed sum of what
the step gives, ``mu' f``, has the gradient ``f'(z)' mu``, that of ``mu' t`` by the direction, in which ``t`` is linear;
and the product ``(mu' f)'' v``, the gradient of ``mu' t`` by the point. So the tangent is differentiated once,
backwards, and never the step. One piece of code serves all steps of a sample and all directions.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import ModuleType
from typing import Any

from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.prediction.step_slopes import step_slopes


@dataclass(frozen=True, eq=False)
class HeldSample:
    """Expressions of ``phi(x, u)``, the state after a sample through which the motors' torques ``u`` are held.

    Parameters
    ----------
    model : StepModel
        The generated step, of n numbers and m torques.
    """

    model: StepModel

    def after(self, x: Any, u: Any) -> Any:
        """Return ``phi``, (n,), for symbols of MX."""
        for _ in range(self._steps):
            x = self._step(x, u)
        return x

    def slopes(self, x: Any, u: Any) -> tuple[Any, Any]:
        """Return ``phi`` and its slopes by ``(u, x)``, (n, m + n)."""
        points, slopes, total = self._forward(x, u)
        del slopes
        return points[-1], total[-1]

    def slopes_and_hessian(self, x: Any, u: Any, weights: Any) -> tuple[Any, Any, Any]:
        """Return ``phi``, its slopes by ``(u, x)``, and the second derivatives of ``weights' phi``, (m + n, m + n).

        Each step adds ``S' H S``: S is what start and torques make of its state and torques, H are second derivatives
        of the step weighed by what its result does in the end.
        """
        import casadi as ca

        points, slopes, total = self._forward(x, u)
        many = self._width
        twice = self._back.map(many)
        found = ca.MX.zeros(many, many)
        nothing = ca.MX.zeros(self.model.size, many)
        for point, slope, before in zip(points[-2::-1], slopes[::-1], total[-2::-1], strict=True):
            along = ca.vertcat(self._held, before)
            each = (ca.repmat(value, 1, many) for value in (point, u, weights))
            found += ca.mtimes(along.T, twice(*each, along, nothing)[1])
            weights = ca.mtimes(slope[:, self.model.motors.count :].T, weights)
        # equal but for rounding: exactly so, as those who factorise it expect
        return points[-1], total[-1], ca.densify((found + found.T) / 2.0)

    def hessian_product(self, x: Any, u: Any, weights: Any, direction: Any) -> Any:
        """Return the second derivatives of ``weights' phi`` by ``(u, x)`` times a direction, (m + n,), without them."""
        import casadi as ca

        motors = self.model.motors.count
        points, changes = [x], [direction[motors:]]
        turned = direction[:motors]
        for _ in range(self._steps):
            changes.append(self._tangent(points[-1], u, ca.vertcat(turned, changes[-1])))
            points.append(self._step(points[-1], u))
        product, more = ca.MX.zeros(motors), ca.MX.zeros(self.model.size)
        for point, change in zip(points[-2::-1], changes[-2::-1], strict=True):
            slope, bent = self._back(point, u, weights, ca.vertcat(turned, change), more)
            product += bent[:motors]
            weights, more = slope[motors:], bent[motors:]
        return ca.densify(ca.vertcat(product, more))

    # -- one step -----------------------------------------------------------------------------------------------

    def _forward(self, x: Any, u: Any) -> tuple[list[Any], list[Any], list[Any]]:
        """Return states, slopes of each step, and slopes of states by torques and start, all by ``(u, x)``."""
        import casadi as ca

        motors = self.model.motors.count
        points, slopes = [x], []
        total = [ca.horzcat(ca.MX.zeros(self.model.size, motors), ca.MX.eye(self.model.size))]
        for _ in range(self._steps):
            after, slope = self._slopes(points[-1], u)
            points.append(after)
            slopes.append(slope)
            total.append(ca.densify(ca.mtimes(slope, ca.vertcat(self._held, total[-1]))))
        return points, slopes, total

    @property
    def _steps(self) -> int:
        return self.model.problem.substeps

    @property
    def _width(self) -> int:
        return int(self.model.motors.count + self.model.size)

    @property
    def _held(self) -> Any:
        """What torques and start make of a step's torques, (m, m + n)."""
        import casadi as ca

        return ca.DM.eye(self._width)[: self.model.motors.count, :]

    @cached_property
    def _module(self) -> ModuleType:
        """The generated module with its tangent; predictions of arms in space do without."""
        from tmm_gen.native.python_module import casadi_module

        module: ModuleType = self.model.module
        if hasattr(module, "tangent_function"):
            return module
        return casadi_module(self.model.scene.replace(**{"emit.sensitivities": True}))

    @cached_property
    def _step(self) -> Any:
        """``(x, u) -> f``."""
        import casadi as ca

        x, u = self._symbols()
        after = self._module.step_function()(x, self.model.inputs(u), self.model.parameters)[0]
        return ca.Function("step", [x, u], [after])

    @cached_property
    def _tangent(self) -> Any:
        """``(x, u, (du, dx)) -> f' (du, dx)``."""
        import casadi as ca

        x, u = self._symbols()
        along = ca.SX.sym("along", self._width)
        return ca.Function("tangent", [x, u, along], [self._along(x, u, along)])

    @cached_property
    def _slopes(self) -> Any:
        """``(x, u) -> f, df/d(u, x)``: in a plane as generated; in space, where that is long, a direction at a time."""
        import casadi as ca

        if self.model.scene.spatial is None:
            x, u = self._symbols()
            slopes = step_slopes(self._module)
            after, by_state, by_inputs = slopes(x, self.model.inputs(u), self.model.parameters)
            by_torques = ca.mtimes(by_inputs, ca.sparsify(ca.DM(self.model.acting)))
            return ca.Function("slopes", [x, u], [after, ca.densify(ca.horzcat(by_torques, by_state))])
        at, torques = ca.MX.sym("x", self.model.size), ca.MX.sym("u", self.model.motors.count)
        many = self._width
        columns = self._tangent.map(many)(
            ca.repmat(at, 1, many), ca.repmat(torques, 1, many), ca.DM.eye(many)
        )
        return ca.Function("slopes", [at, torques], [self._step(at, torques), columns])

    @cached_property
    def _back(self) -> Any:
        """``(x, u, mu, v, dmu) -> f' mu, (mu' f)'' v + f' dmu``, all by ``(u, x)``."""
        import casadi as ca

        x, u = self._symbols()
        size, along = self.model.size, ca.SX.sym("along", self._width)
        mu, more = ca.SX.sym("mu", size), ca.SX.sym("more", size)
        change = self._along(x, u, along)
        slope = ca.jtimes(change, along, mu, True)
        bent = ca.jtimes(change, ca.vertcat(u, x), mu, True) + ca.jtimes(change, along, more, True)
        results = [ca.densify(slope), ca.densify(bent)]
        return ca.Function("back", [x, u, mu, along, more], results, {"cse": True})

    def _along(self, x: Any, u: Any, along: Any) -> Any:
        """Return the generated tangent along torques and state."""
        motors = self.model.motors.count
        inputs = self.model.inputs
        function = self._module.tangent_function()
        return function(x, inputs(u), self.model.parameters, along[motors:], inputs(along[:motors]))

    def _symbols(self) -> tuple[Any, Any]:
        import casadi as ca

        return ca.SX.sym("x", self.model.size), ca.SX.sym("u", self.model.motors.count)
