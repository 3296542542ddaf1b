r"""The optimal control problem every predictive controller here solves, stated once.

**Model.** ``x`` is the state of the generated kernel (angles, rates, accelerations, the hub's first), and one
sample is ``M`` of its steps of ``T/M``:

    x[k+1] = F(x[k], u_before + d[k], u_then + d[k]),   d[k+1] = d[k],   tip = c x = sum_i l_i q_i / L,   hub = q_0.

``d`` is the disturbance state, a torque at the hub nobody commanded; it makes the control free of offset. ``tip``
is linear in the angles and differs from the polar angle of the tip by the third power of the bending.

**Delay.** The torque ``u[k]`` computed from the measurement at ``k T`` acts from ``k T + delay`` on. A model's step
may answer an input late by itself (Newmark's by half a step, as it averages the accelerations at both ends): by
``lag`` steps, see :func:`tmm_gen.control.lag.input_lag`. What remains is ``delay / T - lag / M = whole + part`` with
``whole >= 0`` an integer and ``part < 1``, at least ``-1/(2M)``. In sample ``k``, ``u_before = u[k - whole - 1]`` acts
for a ``part`` of it and ``u_then = u[k - whole]`` for the rest: step ``j`` of ``0 ... M-1`` takes the torque

    share_j u_before + (1 - share_j) u_then,   share_j = clip(part M - j, 0, 1),   but share_0 = min(part M, 1).

The state is first predicted over ``whole`` samples with torques already chosen; the horizon starts there, and
``u[-1]`` below is the last torque chosen.

**Target.** ``(x_s, u_s)``: the arm at rest with ``tip = reference``; ``hub_s`` is its hub angle. Without gravity
``u_s = 0`` and ``hub_s = reference``.

**Problem.** Over ``u = (u[0], ..., u[N-1])`` and one slack per stage and soft bound,

    minimise    1/2 sum_{i=1..N} ( W.tip (tip_i - reference)^2 + W.hub (hub_i - hub_s)^2
                                   + W.tip_rate tip'_i^2 + W.hub_rate hub'_i^2 )
              + 1/2 sum_{i=0..N-1} ( W.torque (u_i - u_s + d)^2 + W.torque_step (u_i - u_{i-1})^2 )
              + 1/2 sum_{i=1..N} ( W.overshoot s_i^2 + W.hub_bound r_i^2 )  +  1/2 |G (x_N - x_s, u_{N-1} - u_s + d)|^2
    subject to  torque_low <= u_i <= torque_high                                           i = 0..N-1
                -rate T <= u_i - u_{i-1} <= rate T            (if there is a torque_rate)   i = 0..N-1
                tip_low - s_i <= tip_i <= tip_high + s_i      (if there is an overshoot)    i = 1..N
                hub_low - r_i <= hub_i <= hub_high + r_i      (if there are hub bounds)     i = 1..N

A soft bound gives way, at all i, where the arm is more than 0.1 rad beyond it at i = 1, or will be even if it brakes
(:meth:`tmm_gen.control.condensed.Condensed.bounds`): it would be passed at nearly every sample, whatever the torques.

The last term is the cost to go: what the first two sums would come to beyond the horizon, without bounds, for the model
linearised about the target (:mod:`tmm_gen.control.terminal`). Of the tip only the side beyond the reference is bounded,
by ``reference + overshoot (reference - start)``, where ``start`` is the tip angle of the scene's initial state.

**Condensed QP.** Predictions are affine in the inputs about a trajectory ``u^``:

    tip_i(u) = tip_i(u^) + sum_{j<i} S_ij (u_j - u^_j),    hub_i, rates alike.

- *Linear MPC*: ``F`` linearised about the target, ``u^ = 0``; ``S`` is Toeplitz and constant.
- *Real-time iteration, full*: ``u^`` is the last solution shifted by a sample, its last entry repeated; ``F`` is
  rolled out along it and ``S`` follows from its derivatives there; one QP per sample.
- *Zero-order real-time iteration*: the same rollout, but ``S`` is that of the linear MPC, prepared once.

Decision variables are ``z = (u - u^, s, r)``; slacks of absent bounds are absent. The Hessian is the Gauss-Newton
one. Rows in order: bounds of the torques (N), then rates of change (N), tip (N), hub (N), those present.

**Safe law.** If the QP is not solved, it is once more without its soft bounds. If that fails too, the controller
applies :func:`tmm_gen.control.safe.safe_torque` and says so. Every torque that leaves a controller is within its
bounds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from tmm_gen.errors import UserError
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene
from tmm_gen.scene.control import Control, Estimator, Sensors, Weights
from tmm_gen.scene.flat import require_flat


@dataclass(frozen=True)
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
    reference : float
        Tip angle to reach, rad.
    start : float
        Tip angle at time zero, rad.
    delay : float
        From measurement to torque, s.
    torque : (low, high)
        N m.
    torque_rate : float or None
        N m/s.
    hub : (low, high) or None
        rad.
    tip : (low, high) or None
        rad; one side is infinite.
    weights : Weights
        Of the cost.
    sensors : Sensors
        What is measured.
    estimator : Estimator
        What the Kalman filter assumes.
    input_name : str
        The scene's input that is the hub's torque.
    """

    horizon: int
    sample_time: float
    substeps: int
    modes: int
    reference: float
    start: float
    delay: float
    torque: tuple[float, float]
    torque_rate: float | None
    hub: tuple[float, float] | None
    tip: tuple[float, float] | None
    weights: Weights
    sensors: Sensors
    estimator: Estimator
    input_name: str

    @property
    def step(self) -> float:
        """Step of the kernel, s."""
        return self.sample_time / self.substeps

    def allowed(self, torque: float, last: float) -> float:
        """Return the torque nearest to a given one within the bounds, NaN counted as zero, N m.

        Parameters
        ----------
        torque : float
            Wanted, N m.
        last : float
            Last torque commanded, N m; within the bounds.
        """
        low, high = self.torque
        if self.torque_rate is not None:
            change = self.torque_rate * self.sample_time
            low, high = max(low, last - change), min(high, last + change)
        return min(max(0.0 if math.isnan(torque) else torque, low), high)


def control_problem(scene: Scene) -> ControlProblem:
    """Return the control problem of a scene.

    Raises
    ------
    UserError
        If the scene has no ``[control]``, or is of a kind that cannot have it.
    """
    require_flat(scene, "controllers do not")
    control = scene.control
    if control is None and scene.parts:
        raise UserError(
            f"{scene.source.origin}: predictive control turns a hub, and knows no arms of parts by name yet. Write the "
            f'arm with base.kind = "motor" and [beam], as {scenes_dir() / "swing.toml"} does.'
        )
    # the sentence asks for just these two words
    if control is None and (scene.model.kind != "planar" or scene.base.kind != "motor"):
        raise UserError(
            f"{scene.source.origin}: only planar arms are controlled, by a torque at a hub that turns. Take one with "
            f'kind = "planar" under [model] and kind = "motor" under [base], such as {scenes_dir() / "swing.toml"}.'
        )
    if control is None:
        raise UserError(
            f"{scene.source.origin}: has no [control]. Add it, with for example `reference = 1.0` and "
            f"[control.bounds] with `torque = 3.0`; {scenes_dir() / 'swing.toml'} has all of it."
        )
    start = tip_angle(scene, scene.initial.angles)
    name = next(item.name for item in scene.inputs if item.at == "base" and item.acts == "torque")
    return ControlProblem(
        horizon=control.horizon,
        sample_time=control.sample_time,
        substeps=control.substeps,
        modes=control.modes,
        reference=control.reference,
        start=start,
        delay=control.delay,
        torque=control.bounds.torque,
        torque_rate=control.bounds.torque_rate,
        hub=control.bounds.hub,
        tip=_tip_bound(control, start),
        weights=control.weights,
        sensors=control.sensors,
        estimator=control.estimator,
        input_name=name,
    )


def tip_angle(scene: Scene, angles: tuple[float, ...]) -> float:
    """Return the length-weighted mean of the links' angles, ``sum l_i q_i / L``, rad."""
    lengths = [link.length for link in scene.links]
    return sum(length * angle for length, angle in zip(lengths, angles, strict=True)) / sum(lengths)


def _tip_bound(control: Control, start: float) -> tuple[float, float] | None:
    """Return the interval of the tip angle: bounded beyond the reference, as seen from the start."""
    if control.bounds.overshoot is None or control.reference == start:
        return None
    way = control.reference - start
    edge = control.reference + control.bounds.overshoot * way
    return (-math.inf, edge) if way > 0.0 else (edge, math.inf)
