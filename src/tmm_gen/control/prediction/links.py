"""The generated step of a few links, linearised about the target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.goals.target import Target, find_target
from tmm_gen.control.prediction.lift import Lift
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.step_model import StepModel

Array = NDArray[np.float64]


def target_state(model: StepModel, target: Target) -> Array:
    """Return the kernel's state at the target."""
    state = np.zeros(model.size)
    state[model.places("angle")] = target.angles
    return state


def rest_state(model: StepModel, linear: LinearModel) -> Array:
    """Return the kernel's state about which a linear model of it was made."""
    return model.initial() - linear.start


def links_model(model: StepModel) -> LinearModel:
    """Return the linear model of a generated step; its state is the kernel's, less that at the target.

    Raises
    ------
    UserError
        If the motors cannot hold the target, or the start.
    """
    target = find_target(model.scene, model.problem)
    state = target_state(model, target)
    motors, count = model.motors, model.motors.count
    transition, drives = model.jacobian(state, target.goal.torque)
    seen, slopes = (np.array(item) for item in model.sensor_slopes(state))
    whirl = np.zeros(model.size)
    if motors.on_hub:
        whirl -= model.rows(motors.tip, "angle")[0]
        whirl[model.places("angle")[-1]] += 1.0
        whirl *= motors.lengths.sum()
    return LinearModel(
        transition=transition,
        before=drives[:, :count],
        then=drives[:, count:],
        tip=model.rows(motors.tip, "angle"),
        tip_rate=model.rows(motors.tip, "rate"),
        hub=model.rows(motors.hub, "angle"),
        hub_rate=model.rows(motors.hub, "rate"),
        measure=slopes,
        feed=np.zeros((3 * count, count)),  # torques reach what is measured through springs
        target_sensors=seen.ravel(),
        goal=target.goal,
        swept=np.zeros((1, 1, 1)) if motors.on_hub else model.sensing.swept(target.angles, motors.turned),
        whirl=whirl,
        turn=model.rows(motors.turned.T, "rate").T,
        turned=model.rows(motors.turned.T, "angle").T,
        start_hub=motors.hub @ model.start.angles,
        length=float(motors.lengths.sum()),
        start=model.initial() - state,
        start_torque=model.start.torque,
        lift=Lift.of(model.scene),
        delay=model.delay,
    )
