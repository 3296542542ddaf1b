r"""The optimal control problem every predictive controller here solves, stated once.

**Model.** ``x`` is the state of the generated kernel (angles, rates, accelerations, a hub's first), ``u`` are the
torques of the m motors, each with a hub and a tip (:mod:`tmm_gen.control.arm.motors`), and one sample is ``M`` of its
steps of ``T/M``:

    x[k+1] = F(x[k], u_before + d[k], u_then + d[k]),   d[k+1] = d[k],   tip = c x,   hub = h x,

with for an arm on a hub ``tip = sum_i l_i q_i / L`` and ``hub = q_0``. ``d`` are the disturbance states, torques of the
motors nobody commanded; they make the control free of offset. ``tip`` is linear in the angles and differs from the
polar angle of the tip by the third power of the bending.

**Delay.** The torque ``u[k]`` computed from the measurement at ``k T`` acts from ``k T + delay`` on. A model's step may
answer an input late by itself (Newmark's by half a step, as it averages the accelerations at both ends): by ``lag``
steps, see :func:`tmm_gen.control.prediction.lag.input_lag`. What remains is ``delay / T - lag / M = whole + part`` with
``whole >= 0`` an integer and ``part < 1``, at least ``-1/(2M)``. In sample ``k``, ``u_before = u[k - whole - 1]`` acts
for a ``part`` of it and ``u_then = u[k - whole]`` for the rest: step ``j`` of ``0 ... M-1`` takes the torque

    share_j u_before + (1 - share_j) u_then,   share_j = clip(part M - j, 0, 1),   but share_0 = min(part M, 1).

The state is first predicted over ``whole`` samples with torques already chosen; the horizon starts there, and
``u[-1]`` below is the last torque chosen.

**Target.** ``(x_s, u_s)``: the arm at rest with ``tip = reference`` on a hub, ``hub = reference`` where motors are
parts by name; ``hub_s`` and ``tip_s`` are its angles. Without gravity ``u_s = 0`` and all of them are the reference. An
arm on a hub starts as its scene says; one whose motors are parts by name at rest, held by them at the joint angles its
scene says. Where a trajectory is followed, each sample has a target of its own (:mod:`tmm_gen.control.laws.pose`),
rates included, and no tip is bounded.

**Problem.** Over ``u = (u[0], ..., u[N-1])`` and one slack per stage and soft bound, all terms and rows once for each
motor, with its own numbers,

    minimise    1/2 sum_{i=1..N} ( W.tip (tip_i - tip_s)^2       + W.hub (hub_i - hub_s)^2
                                   + W.tip_rate tip'_i^2 + W.hub_rate hub'_i^2 )
              + 1/2 sum_{i=0..N-1} ( W.torque (u_i - u_s + d)^2 + W.torque_step (u_i - u_{i-1})^2 )
              + 1/2 sum_{i=1..N} ( W.overshoot s_i^2 + W.hub_bound r_i^2 )  +  1/2 |G (x_N - x_s, u_{N-1} - u_s + d)|^2
    subject to  torque_low <= u_i <= torque_high                                           i = 0..N-1
                -rate T <= u_i - u_{i-1} <= rate T            (if there is a torque_rate)   i = 0..N-1
                tip_low - s_i <= tip_i <= tip_high + s_i      (if there is an overshoot)    i = 1..N
                hub_low - r_i <= hub_i <= hub_high + r_i      (if there are hub bounds)     i = 1..N
                -rate - v_i <= hub'_i <= rate + v_i           (if there is a hub_rate)      i = 1..N
                n . p(x_i) >= offset + margin - w_i           (for each wall)               i = 1..N

A soft bound gives way, at all i, where the arm is more than 0.1 rad beyond it at i = 1, or will be even if it brakes
(:meth:`tmm_gen.control.quadratic.condensed.Condensed.bounds`): it would be passed at nearly every sample, whatever the
torques.

The last term is the cost to go: what the first two sums would come to beyond the horizon, without bounds, for the model
linearised about the target (:mod:`tmm_gen.control.quadratic.terminal`). Of the tip only the side beyond the target is
bounded, by ``tip_s + overshoot (reference - start)``, where ``start`` is what the reference is of in the scene's
initial state.

**Condensed QP.** Predictions are affine in the inputs about a trajectory ``u^``:

    tip_i(u) = tip_i(u^) + sum_{j<i} S_ij (u_j - u^_j),    hub_i, rates alike.

- *Linear MPC*: ``F`` linearised about the target, ``u^ = 0``; ``S`` is Toeplitz and constant.
- *Real-time iteration, full*: ``u^`` is the last solution shifted by a sample, its last entry repeated; ``F`` is
  rolled out along it and ``S`` follows from its derivatives there; one QP per sample.
- *Zero-order real-time iteration*: the same rollout, but ``S`` is that of the linear MPC, prepared once.

Decision variables are ``z = (u - u^, s, r)``; slacks of absent bounds are absent. The Hessian is the Gauss-Newton
one. Rows in order: bounds of the torques (N), then rates of change (N), tip (N), hub (N), its rate (N), those present,
and walls (N each), linear about ``u^``, with slacks of their own. What there is of each motor stands motor by motor, so
that N after N belong together: ``u`` is all torques of the first, then all of the next.

**Safe law.** If the QP is not solved, it is once more without its soft bounds. If that fails too, the controller
applies :func:`tmm_gen.control.laws.safe.safe_torque` and says so. Every torque that leaves a controller is within its
bounds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.task.angle_bounds import hub_bounds, tip_bound
from tmm_gen.control.task.terms import Assumed, Goal, Kind, MotorWeights, Pair
from tmm_gen.control.task.unsaid import Told
from tmm_gen.errors import UserError
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene
from tmm_gen.scene.control import Sensors
from tmm_gen.scene.each import by_names, some_by_names
from tmm_gen.scene.trajectory import Keep

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ControlProblem:
    """The numbers of the problem; see the module for its statement.

    Parameters
    ----------
    horizon : int
        N, samples.
    sample_time : float
        T, s.
    substeps : int
        M, kernel steps per sample.
    modes : int
        Of a prediction by modes.
    motors : Motors
        What turns the arm of the scene, m of them.
    reference : array, (m,)
        Angles to reach, rad: of the tip of an arm on a hub, else of the hubs.
    start : array, (m,)
        The same at time zero, rad.
    delay : float
        From measurement to torque, s.
    torque : (low, high), arrays, (m,)
        N m.
    torque_rate : array, (m,)
        N m/s; infinite where there is none.
    hub : tuple of ((low, high) or None), length m
        rad; in space within the limits of the joints, where these have some.
    hub_rate : array, (m,)
        rad/s; infinite where there is none.
    tip : tuple of ((low, high) or None), length m
        Off the target, rad; one side is infinite.
    weights : MotorWeights
        Of the cost.
    sensors : Sensors
        What is measured.
    estimator : Assumed
        What the Kalman filter assumes.
    keeps : tuple of Keep
        Half-planes that parts are to stay in.
    """

    horizon: int
    sample_time: float
    substeps: int
    modes: int
    motors: Motors
    reference: Array
    start: Array
    delay: float
    torque: tuple[Array, Array]
    torque_rate: Array
    hub: tuple[Pair | None, ...]
    hub_rate: Array
    tip: tuple[Pair | None, ...]
    weights: MotorWeights
    sensors: Sensors
    estimator: Assumed
    keeps: tuple[Keep, ...] = ()

    @property
    def step(self) -> float:
        """Step of the kernel, s."""
        return self.sample_time / self.substeps

    @property
    def count(self) -> int:
        """Number of motors, m."""
        return self.motors.count

    @property
    def encoders(self) -> Array:
        """Counts per revolution of each hub's encoder, (m,)."""
        return np.array(by_names(self.sensors.encoder, self.motors.names), float)

    @property
    def accelerometers(self) -> Array:
        """Standard deviation of the noise of the accelerometer at each motor's tip, (m,), m/s^2; NaN where none is."""
        return np.array(some_by_names(self.sensors.accelerometer, self.motors.names))

    @property
    def gauges(self) -> Array:
        """The same of strain gauges on the beams that motors carry, (m,), N m."""
        return np.array(some_by_names(self.sensors.strain, self.motors.names))

    def kinds(self, goal: Goal) -> tuple[Kind, ...]:
        """Return the rows of the quadratic program, N for each kind, in their order.

        Parameters
        ----------
        goal : Goal
            From which the tips' bounds count.
        """
        found: list[Kind] = []
        for motor, change in enumerate(self.torque_rate * self.sample_time):
            if math.isfinite(change):
                found.append(Kind("rate", motor, -float(change), float(change)))
        for motor, bounds in enumerate(self.tip):
            if bounds is not None:
                low, high = (float(goal.tip[motor]) + bound for bound in bounds)
                found.append(Kind("tip", motor, low, high, float(self.weights.overshoot[motor])))
        for motor, bounds in enumerate(self.hub):
            if bounds is not None:
                found.append(Kind("hub", motor, *bounds, float(self.weights.hub_bound[motor])))
        for motor, most in enumerate(self.hub_rate):
            if math.isfinite(most):
                weight = float(self.weights.hub_rate_bound[motor])
                found.append(Kind("hub_rate", motor, -float(most), float(most), weight))
        for number, keep in enumerate(self.keeps):
            found.append(Kind("keep", number, keep.offset + keep.margin, math.inf, keep.weight))
        return tuple(found)

    def allowed(self, torque: Array, last: Array) -> Array:
        """Return the torques nearest to given ones within the bounds, NaN counted as zero, (m,), N m.

        Parameters
        ----------
        torque : array, (m,)
            Wanted, N m.
        last : array, (m,)
            Last torques commanded, N m. Where they are beyond the bounds, these are kept at once.
        """
        change = self.torque_rate * self.sample_time
        low, high = np.clip(last - change, *self.torque), np.clip(last + change, *self.torque)
        return np.minimum(np.maximum(np.where(np.isnan(torque), 0.0, torque), low), high)


def control_problem(scene: Scene) -> ControlProblem:
    """Return the control problem of a scene.

    Raises
    ------
    UserError
        If the scene has no ``[control]``, or is of a kind that cannot have it.
    """
    control = scene.control
    # only to say what is missing: a scene that has [control] was asked for these when it was read
    flat = scene.model.kind == "planar" and (scene.base.kind == "motor" or _driven(scene))
    controlled = flat or scene.spatial is not None
    if control is None and not controlled:
        raise UserError(
            f"{scene.source.origin}: has nothing that controllers turn: a hub with a torque, or motors on a clamp. "
            f'Take an arm with kind = "planar" under [model] and kind = "motor" under [base], such '
            f"as {scenes_dir() / 'swing.toml'}, or with [[motor]], such as {scenes_dir() / 'elbow.toml'}."
        )
    motors = motors_of(scene)
    names = motors.names
    if control is None:
        example, like = (
            ("1.0", "swing.toml")
            if motors.on_hub
            else ("{ " + ", ".join(f"{name} = 0.5" for name in names) + " }", "elbow.toml")
        )
        raise UserError(
            f"{scene.source.origin}: has no [control]. Add it, with for example `reference = {example}` and "
            f"[control.bounds] with `torque = 3.0`; {scenes_dir() / like} has all of it."
        )
    start = motors.prescribed @ np.array([*np.zeros(scene.hub), *scene.initial.angles])
    reference = np.array(by_names(control.reference, names))
    bounds = control.bounds
    rate, turning, hub = bounds.torque_rate, bounds.hub_rate, hub_bounds(scene, control, motors)
    low, high = np.array(by_names(bounds.torque, names)).T
    told = Told.by(motors, (low, high))
    return ControlProblem(
        horizon=control.horizon,
        sample_time=control.sample_time,
        substeps=control.substeps,
        modes=control.counted_modes(motors.count),
        motors=motors,
        reference=reference,
        start=start,
        delay=control.delay,
        torque=(low, high),
        torque_rate=np.array(by_names(math.inf if rate is None else rate, names)),
        hub=hub,
        hub_rate=np.array(by_names(math.inf if turning is None else turning, names)),
        tip=tuple(tip_bound(control, float(way)) for way in reference - start),
        weights=MotorWeights.of(control.weights, told),
        sensors=control.sensors,
        estimator=Assumed.of(control.estimator, told),
        keeps=control.keep,
    )


def _driven(scene: Scene) -> bool:
    return bool(scene.parts) and any(item.acts == "drive" for item in scene.inputs)
