"""The generated CasADi step as a prediction model: one sample, its derivatives, what sensors see."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.payload import changed_parameters, kept_out, laden, payload_of
from tmm_gen.control.arm.payload_body import payload_body
from tmm_gen.control.goals.target import Start, find_start
from tmm_gen.control.prediction.lag import input_lag
from tmm_gen.control.prediction.sample import after_sample, rollout, rollout_slopes, sample_slopes
from tmm_gen.control.prediction.step_slopes import step_slopes
from tmm_gen.control.sensors.sensing import Sensing, sites_of
from tmm_gen.control.sensors.sensors import sensors_of
from tmm_gen.control.task.delay import Delay, delay_of
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_WHATEVER_IT_CARRIES = ("module", "names", "motors", "lag", "delay", "start", "carries")


@cache
def _module(scene: Scene) -> Any:
    """Return the generated module of a scene, made once."""
    from tmm_gen.native.python_module import casadi_module

    return casadi_module(scene)


@dataclass(frozen=True, eq=False)
class StepModel:
    """``x[k+1] = F(x[k], w[k])`` over a sample, by the generated step; ``w`` are twice m torques, see `Delay`.

    Parameters
    ----------
    scene : Scene
        That of :func:`tmm_gen.control.prediction.prediction.prediction_scene`.
    problem : ControlProblem
        Gives sample time and substeps.
    """

    scene: Scene
    problem: ControlProblem

    def with_problem(self, problem: ControlProblem) -> StepModel:
        """Return the same model for a problem of the same sample time, horizon and substeps."""
        other = StepModel(self.scene, problem)
        made = {key: value for key, value in self.__dict__.items() if key not in ("scene", "problem")}
        other.__dict__.update(made)
        return other

    @cached_property
    def carries(self) -> bool:
        """Whether its parameters tell of its payload.

        Raises
        ------
        UserError
            If they do not, though the scene says which body that is.
        """
        if payload_of(self.scene) is None:
            return False
        missing = kept_out(self.scene, self.module.PARAMETER_NAMES)
        if missing and (told := payload_body(self.scene)) is not None:
            raise UserError(
                f'{self.scene.source.origin}: control.payload_body = "{told}": what it weighs cannot be told to the '
                f"code of this arm, where {', '.join(missing)} would change, which the scene has at zero or the same "
                f"at all joints. Change body.{told}.mass a little, or remove the key."
            )
        return not missing

    def carrying(self, payload: float) -> StepModel:
        """Return the model of the arm with another payload, kg, that starts as this one does."""
        other = StepModel(laden(self.scene, payload), self.problem)
        parameters = self.parameters.copy()
        for name, value in changed_parameters(self.scene, other.scene).items():
            parameters[self.module.PARAMETER_NAMES.index(name)] = value
        other.__dict__.update(
            {name: getattr(self, name) for name in _WHATEVER_IT_CARRIES}, parameters=parameters
        )
        return other

    @cached_property
    def module(self) -> Any:
        """The generated module."""
        return _module(self.scene)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the state's entries."""
        return tuple(self.module.STATE_NAMES)

    @property
    def size(self) -> int:
        """Entries of the state."""
        return len(self.names)

    def places(self, quantity: str) -> list[int]:
        """Return where the hub's and the links' values of a quantity are, base to tip.

        Parameters
        ----------
        quantity : {"angle", "rate", "acceleration"}
            Part of the state.
        """
        hub = [f"hub_{quantity}"] if self.scene.hub else []
        wanted = [*hub, *(f"{quantity}_{i + 1}" for i in range(self.scene.stations))]
        return [self.names.index(name) for name in wanted]

    @property
    def accelerations(self) -> bool:
        """Whether the state has them."""
        return "acceleration_1" in self.names

    @cached_property
    def motors(self) -> Motors:
        """What turns the arm."""
        return motors_of(self.scene)

    def rows(self, rows: Array, quantity: str) -> Array:
        """Return rows of the state, (k, s), for rows of the arm's angles, (k, d), or of their derivatives."""
        found = np.zeros((len(rows), self.size))
        found[:, self.places(quantity)] = rows
        return found

    # -- functions ----------------------------------------------------------------------------------------------

    @cached_property
    def parameters(self) -> Array:
        """Step and physical parameters, a column ``p``."""
        values = np.array(self.module.default_parameters(), float).ravel()
        values[0] = self.problem.step
        return values

    @cached_property
    def lag(self) -> float:
        """By how much one step answers its input late, in steps: :func:`tmm_gen.control.prediction.lag.input_lag`."""
        import casadi as ca

        x, w = ca.SX.sym("x", self.size), ca.SX.sym("w", self.motors.count)
        after = self.module.step_function()(x, self.inputs(w), self.parameters)[0]
        slopes = ca.Function("slopes", [x, w], [ca.densify(ca.jacobian(after, x)), ca.jacobian(after, w)])
        by_state, by_torques = slopes(self.straight(0.0), np.zeros(self.motors.count))
        places = {name: self.places(name) for name in ("rate", "acceleration")}
        turned = self.motors.turned[:, 0]  # it is the integrator's, and so the same for all motors
        return input_lag(self.scene, turned, places, np.array(by_state), np.array(by_torques)[:, 0])

    @cached_property
    def delay(self) -> Delay:
        """What remains of the delay beside the model's own."""
        return delay_of(self.problem, self.lag / self.problem.substeps)

    @cached_property
    def sample(self) -> Any:
        """``F(x, w)``, a CasADi function of SX: the state a sample later; ``w`` are the torques before and then."""
        import casadi as ca

        x, w = ca.SX.sym("x", self.size), ca.SX.sym("w", 2 * self.motors.count)
        return ca.Function(
            "sample", [x, w], [after_sample(self, x, w, self.parameters)], ["x", "w"], ["x_next"]
        )

    def inputs(self, torques: Any) -> Any:
        """Return the inputs of the kernel where only the motors' torques act, m rows."""
        import casadi as ca

        return ca.mtimes(ca.sparsify(ca.DM(self.acting)), torques)

    @property
    def acting(self) -> Array:
        """Which input of the kernel is the torque of which motor, (inputs, m)."""
        wanted = self.motors.inputs
        return np.array([[float(name == each) for each in wanted] for name in self.module.INPUT_NAMES])

    @cached_property
    def sensing(self) -> Sensing:
        """Accelerometers and gauges of an arm by parts."""
        sites = sites_of(self.scene, self.motors, self.problem)
        return Sensing.of(self.scene, self.motors, self.problem, sites)

    @cached_property
    def sensors(self) -> Any:
        """``h(x)``, a CasADi function, see :func:`~tmm_gen.control.sensors.sensors.sensors_of`."""
        return sensors_of(self)

    @cached_property
    def sample_slopes(self) -> Any:
        """``(x, w) -> F, dF/dx, dF/dw``, a CasADi function: derivatives by the factors of each step's own sweep."""
        import casadi as ca

        x, w = ca.MX.sym("x", self.size), ca.MX.sym("w", 2 * self.motors.count)
        return ca.Function("sample_slopes", [x, w], sample_slopes(self, x, w, self.parameters))

    @cached_property
    def _one_step(self) -> Any:
        return step_slopes(self.module)

    def step_slopes(self, state: Array, torque: Array) -> tuple[Array, Array, Array]:
        """Return the state after a step of the kernel, (s,), its derivatives by state, (s, s), and torques, (s, m)."""
        after, by_state, by_inputs = self._one_step(state, self.acting @ torque, self.parameters)
        return np.array(after).ravel(), np.array(by_state), np.array(by_inputs) @ self.acting

    @cached_property
    def sensor_slopes(self) -> Any:
        """``x -> h, dh/dx``."""
        import casadi as ca

        x = ca.SX.sym("x", self.size)
        seen = self.sensors(x)
        return ca.Function("sensor_slopes", [x], [seen, ca.densify(ca.jacobian(seen, x))])

    @cached_property
    def rollout(self) -> Callable[[Any, Any], Any]:
        """``(x, w (2 m, N)) -> (states after each sample, (size, N))``, compiled."""
        return rollout(self)

    @cached_property
    def rollout_slopes(self) -> Callable[[Any, Any], Any]:
        """``(x (size, N), w (2 m, N)) -> F, dF/dx side by side, dF/dw likewise`` at each of N points, compiled."""
        return rollout_slopes(self)

    # -- states -------------------------------------------------------------------------------------------------

    def straight(self, angle: float) -> Array:
        """Return the state of the straight arm at rest at an angle."""
        state = np.zeros(self.size)
        state[self.places("angle")] = angle
        return state

    @cached_property
    def start(self) -> Start:
        """How the arm starts."""
        return find_start(self.scene, self.problem)

    def initial(self) -> Array:
        """Return the state the arm starts from, at rest in its accelerations."""
        state = np.zeros(self.size)
        for quantity, values in (("angle", self.start.angles), ("rate", self.start.rates)):
            state[self.places(quantity)] = values
        return state

    def jacobian(self, state: Array, torque: Array) -> tuple[Array, Array]:
        """Return ``dF/dx``, (size, size), and ``dF/dw``, (size, 2 m), of an arm held still where it is.

        All steps of the sample are linearised about one state, as the emitted C does it: where the torques do not hold
        the arm there it would move on within the sample.

        Parameters
        ----------
        state : array, (size,)
            Without rates.
        torque : array, (m,)
            That acts throughout, N m.
        """
        _, by_state, by_torque = self.step_slopes(state, torque)
        transition, before, then = np.eye(self.size), np.zeros_like(by_torque), np.zeros_like(by_torque)
        for share in self.delay.shares(self.problem.substeps):
            transition = by_state @ transition
            before = by_state @ before + share * by_torque
            then = by_state @ then + (1.0 - share) * by_torque
        return transition, np.hstack([before, then])
