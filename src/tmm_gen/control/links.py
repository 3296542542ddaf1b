"""The generated step of a few links, linearised about the target."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.linear import LinearModel
from tmm_gen.control.step_model import StepModel
from tmm_gen.control.target import Target, find_target

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
        If the motor cannot hold the target.
    """
    target = find_target(model.scene, model.problem)
    state = target_state(model, target)
    transition, drives = model.jacobian(state, target.torque)
    seen, slopes = (np.array(item) for item in model.sensor_slopes(state))
    whirl = -model.mean_row("angle")
    whirl[model.places("angle")[-1]] += 1.0
    whirl *= model.lengths.sum()
    turn = np.zeros(model.size)
    turn[model.places("rate")] = 1.0
    turned = np.zeros(model.size)
    turned[model.places("angle")] = 1.0
    return LinearModel(
        transition=transition,
        before=drives[:, 0],
        then=drives[:, 1],
        tip=model.mean_row("angle"),
        tip_rate=model.mean_row("rate"),
        hub=model.hub_row("angle"),
        hub_rate=model.hub_row("rate"),
        measure=slopes,
        feed=np.zeros(3),  # the hub's torque reaches the arm through a spring
        target_sensors=seen.ravel(),
        target_hub=float(target.angles[0]),
        target_torque=target.torque,
        whirl=whirl,
        turn=turn,
        turned=turned,
        start_hub=float(model.initial()[model.places("angle")[0]]),
        length=float(model.lengths.sum()),
        start=model.initial() - state,
        delay=model.delay,
    )
