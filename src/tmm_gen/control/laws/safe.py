"""The law a controller falls back to when its own cannot be computed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.task.problem import ControlProblem

Array = NDArray[np.float64]

BRAKE_TIME = 0.1
"""The safe law's torque would stop the rigid arm's rate in this many seconds."""


def safe_torque(
    problem: ControlProblem,
    inertia: Array,
    rate: Array,
    last: Array,
    held: Array | None = None,
    wanted: Array | float = 0.0,
) -> Array:
    """Return torques that brake the hubs: ``held - inertia (rate - wanted) / BRAKE_TIME`` each, within all bounds, N m.

    They need the encoders alone. Where one fails too, its ``rate`` is not finite and taken to be zero.

    Parameters
    ----------
    problem : ControlProblem
        Gives the bounds.
    inertia : array, (m,)
        What each motor turns, kg m^2.
    rate : array, (m,)
        Of the hubs, from the last two encoder values, rad/s.
    last : array, (m,)
        Torques commanded a sample before, N m.
    held : array, (m,), optional
        Torques that hold the arm, N m; by default none.
    wanted : array, (m,), optional
        Rates that hubs are brought to, rad/s; by default they are brought to rest.
    """
    brakes = inertia * (wanted - np.where(np.isfinite(rate), rate, 0.0)) / BRAKE_TIME
    return problem.allowed(brakes if held is None else held + brakes, last)
