"""What a filter of constant gains takes in far from its target, where the gains of the target may do harm.

There an arm bends in other ways: folded, it swings sideways where it would nod, and what an encoder is off is then
ascribed to the wrong motion. With the gains of the target an estimate of `wall3` whose arm hangs down grows by a tenth
per sample of its own. So it is tried in poses all around whether the estimate is stable. If it is not everywhere, hubs
are corrected as if nothing bent where it might not be: that is right in any pose, for bending dies away.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_discrete_are

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.links import rest_state
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.task.extremes import UnsolvableError
from tmm_gen.control.task.where import where

Array = NDArray[np.float64]

POSES = 64
"""In which stability is tried; and as many again within what seems to be the reach of the target's gains."""
_NEARER = 8
"""How often their reach may shrink."""
_SLOWER = 8
"""How often unknown torques are taken to change half as much, until hubs are stable in all poses."""


@dataclass(frozen=True, eq=False)
class FarGain:
    """How encoders are taken in far from the target.

    Parameters
    ----------
    gain : array, (s + m + b, p)
        As a filter's; what sensors behind the encoders show is not taken in.
    target : array, (m,)
        Where hubs are at the target, rad.
    reach : array, (m,)
        How far from there they may be for the gains of the target, rad; infinite for the one that turns the whole arm.
    """

    gain: Array
    target: Array
    reach: Array

    def is_far(self, hub: Array) -> bool:
        """Return whether hubs, (m,), rad, are so far from the target that this is the gain to take."""
        return not np.all(np.abs(hub - self.target) <= self.reach)


def far_gain(model: StepModel, linear: LinearModel, stationary: KalmanFilter) -> FarGain | None:
    """Return the gain far from the target; None where that of the target is stable in any pose.

    Parameters
    ----------
    model : StepModel
        That predicts.
    linear : LinearModel
        Of the same about the target.
    stationary : KalmanFilter
        Whose gains are used near the target.

    Raises
    ------
    UnsolvableError
        If no gain is found that is stable in the poses tried.
    """
    count, target = model.problem.count, linear.goal.hub
    if count == 1:  # it turns the whole arm
        return None
    random = np.random.default_rng(0)
    tried = _Tried(model, linear, stationary)
    poses = target + random.uniform(-np.pi, np.pi, (POSES, count))
    maps = [tried.maps(hub) for hub in poses]
    away = np.max(np.abs(poses - target)[:, 1:], axis=1)
    bad = [not tried.is_stable(each, stationary.gain) for each in maps]
    if not any(bad):
        return None
    reach = float(away[bad].min())
    for _ in range(_NEARER):
        near = target + random.uniform(-reach, reach, (POSES, count))
        near[:, 0] = target[0] + random.uniform(-np.pi, np.pi, POSES)
        bad = [not tried.is_stable(tried.maps(hub), stationary.gain) for hub in near]
        if not any(bad):
            break
        reach = float(np.max(np.abs(near - target)[bad, 1:], axis=1).min())
    within = np.full(count, reach)
    within[0] = np.inf
    for gain in _rigid_gains(model, stationary):
        if all(tried.is_stable(each, gain) for each in maps):
            return FarGain(gain, target, within)
    problem = model.problem
    raise UnsolvableError(
        f"{where(model.scene, 'control.substeps')}: no gains of the filter are stable in all poses of the arm, where "
        f"it is predicted by steps of {problem.step:g} s (got {problem.substeps}). Write more for a sample, such "
        f"as {4 * problem.substeps}, or set a smaller control.estimator.disturbance."
    )


@dataclass(frozen=True, eq=False)
class _Tried:
    """What becomes of errors of an estimate in a pose."""

    model: StepModel
    linear: LinearModel
    stationary: KalmanFilter

    def maps(self, hub: Array) -> tuple[Array, Array]:
        """Return by what an error is taken a sample on, and what sensors make of it, with hubs there, (m,), rad."""
        model, torque, biased = self.model, self.linear.goal.torque, self.stationary.biased
        state = rest_state(model, self.linear)
        state[model.places("angle")] += model.motors.turned @ (hub - self.linear.goal.hub)
        _, by_state, by_torques = (
            np.array(item) for item in model.sample_slopes(state, np.concatenate([torque, torque]))
        )
        size, count = len(state), len(torque)
        on = np.eye(size + count + len(biased))
        on[:size, :size], on[:size, size : size + count] = (
            by_state,
            by_torques[:, :count] + by_torques[:, count:],
        )
        sensors = list(self.stationary.sensors)
        seen = np.zeros((len(sensors), len(on)))
        seen[:, :size] = np.array(model.sensor_slopes(state)[1])[sensors]
        for column, sensor in enumerate(biased, start=size + count):
            seen[sensors.index(sensor), column] = 1.0
        return on, seen

    def is_stable(self, maps: tuple[Array, Array], gain: Array) -> bool:
        """Return whether errors die away; what a sensor that is not taken in is off for long need not."""
        on, seen = maps
        kept = on @ (np.eye(len(on)) - gain @ seen)
        used = len(on) - (
            0 if np.any(gain[len(on) - len(self.stationary.biased) :]) else len(self.stationary.biased)
        )
        return bool(np.max(np.abs(np.linalg.eigvals(kept[:used, :used]))) < 1.0)


def _rigid_gains(model: StepModel, stationary: KalmanFilter) -> Iterator[Array]:
    """Yield gains of motors that each turn a rigid body alone: its angle, its rate, and a torque that nobody commanded.

    The body is what the motor would turn if nothing bent. Such torques are found ever more slowly: what bends pulls at
    the motor too, and must not be taken for one.
    """
    problem = model.problem
    assumed, time, count = problem.estimator, problem.sample_time, problem.count
    inertia = motors_of(model.scene).inertia(arm_of(model.scene).mass())
    for slower in 2.0 ** np.arange(_SLOWER):
        gain = np.zeros_like(stationary.gain)
        for j in range(count):
            push = np.array([0.5 * time**2, time, 0.0]) / inertia[j]
            on = np.eye(3)
            on[0, 1], on[:2, 2] = time, push[:2]
            driven = assumed.torque[j] ** 2 * np.outer(push, push)
            driven += np.diag([0.0, assumed.rate[j] ** 2, (assumed.disturbance[j] / slower) ** 2])
            noise = assumed.encoder[j] ** 2
            covariance = solve_discrete_are(on.T, np.eye(3)[:, :1], driven, np.array([[noise]]))
            angle, rate, torque = covariance[:, 0] / (covariance[0, 0] + noise)
            gain[model.places("angle"), j] = angle * model.motors.turned[:, j]
            gain[model.places("rate"), j] = rate * model.motors.turned[:, j]
            gain[model.size + j, j] = torque
        yield gain
