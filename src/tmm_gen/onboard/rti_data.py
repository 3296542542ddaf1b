"""Everything numeric that a nonlinear MPC in C needs, prepared once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.credible import Credible
from tmm_gen.control.kalman import KalmanFilter
from tmm_gen.control.rti import RealTimeIteration
from tmm_gen.control.safe import BRAKE_TIME
from tmm_gen.onboard.linear_data import gains_by_sensors
from tmm_gen.onboard.program_data import ProgramData, program_data

Array = NDArray[np.float64]

OUTPUTS = ("tip", "tip_rate", "hub", "hub_rate")


@dataclass(frozen=True, eq=False)
class RtiData:
    """Tables of a real-time iteration.

    Parameters
    ----------
    size : int
        Entries of the kernel's state, m.
    outputs : tuple of str
        Those of `OUTPUTS` that are weighed or bounded.
    weights, targets : tuple of float
        Of each output.
    gains : array, (2^(p - 1), m + 1, p)
        Of the filter; see :func:`~tmm_gen.onboard.linear_data.gains_by_sensors`.
    start : array, (m + 1,)
        Estimate at time zero.
    credible : Credible
        What can be believed of a measurement.
    target_hub : float
        rad.
    lengths : array, (n,)
        Of the links, relative to their sum.
    shares : array, (M,)
        Of the earlier torque in the steps of a sample.
    sensors : tuple of int
        Which of encoder, accelerometer and strain gauge there are.
    target_torque, gravity, brake : float
        N m; m/s^2; N m s/rad, of the safe law.
    whole, memory : int
        Delay in samples; past torques that count.
    program : ProgramData
        The quadratic program at the target.
    answers : array, (outputs, N)
        To a torque, sample by sample, at the target.
    target : array, (m,)
        The state at rest there.
    end : array, (r, m + 1)
        G of the cost to go, by the state off the target and the last torque off the target's.
    end_gradient : array, (N, m + 1)
        What these make of the gradient, at the target.
    """

    size: int
    outputs: tuple[str, ...]
    weights: tuple[float, ...]
    targets: tuple[float, ...]
    gains: Array
    credible: Credible
    target_hub: float
    start: Array
    lengths: Array
    shares: Array
    sensors: tuple[int, ...]
    target_torque: float
    gravity: float
    brake: float
    whole: int
    memory: int
    program: ProgramData
    answers: Array
    target: Array
    end: Array
    end_gradient: Array


def rti_data(controller: RealTimeIteration) -> RtiData:
    """Return the tables of a controller; of its filter, the gain at the target."""
    model, linear, problem = controller.model, controller.linear, controller.problem
    weights = {name: float(getattr(problem.weights, name)) for name in OUTPUTS}
    bounded = {"tip": problem.tip is not None, "hub": problem.hub is not None}
    outputs = tuple(name for name in OUTPUTS if weights[name] or bounded.get(name, False))
    targets = {"tip": problem.reference, "tip_rate": 0.0, "hub": linear.target_hub, "hub_rate": 0.0}
    kalman = KalmanFilter(linear, problem)
    slopes = controller.prepared.slopes
    return RtiData(
        size=model.size,
        outputs=outputs,
        weights=tuple(weights[name] for name in outputs),
        targets=tuple(targets[name] for name in outputs),
        gains=gains_by_sensors(kalman),
        credible=controller.limits,
        target_hub=linear.target_hub,
        start=np.append(model.initial(), 0.0),
        lengths=model.lengths / model.lengths.sum(),
        shares=model.delay.shares(problem.substeps),
        sensors=tuple(kalman.sensors),
        target_torque=linear.target_torque,
        gravity=model.scene.model.gravity or 0.0,
        brake=controller.inertia / BRAKE_TIME,
        whole=controller.delay.whole,
        memory=controller.delay.memory,
        program=program_data(problem, controller.prepared),
        answers=np.array([getattr(slopes, name)[:, 0] for name in outputs]),
        target=controller.target,
        end=controller.end,
        end_gradient=slopes.end.T @ controller.end,
    )
