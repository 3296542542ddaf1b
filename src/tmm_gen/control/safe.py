"""The law a controller falls back to when its own cannot be computed."""

from __future__ import annotations

import math

from tmm_gen.control.problem import ControlProblem

BRAKE_TIME = 0.1
"""The safe law's torque would stop the rigid arm's rate in this many seconds."""


def safe_torque(problem: ControlProblem, inertia: float, rate: float, last: float) -> float:
    """Return a torque that brakes the hub: ``-inertia rate / BRAKE_TIME``, within all bounds, N m.

    It needs the encoder alone. Where that fails too, ``rate`` is not finite and the torque goes to zero as fast as
    its bounds allow.

    Parameters
    ----------
    problem : ControlProblem
        Gives the bounds.
    inertia : float
        Of the hub and the arm behind it, kg m^2.
    rate : float
        Of the hub, from the last two encoder values, rad/s.
    last : float
        Torque commanded a sample before, N m.
    """
    wanted = -inertia * rate / BRAKE_TIME if math.isfinite(rate) else 0.0
    return problem.allowed(wanted, last)
