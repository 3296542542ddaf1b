"""What a controller is: measurements in, torques within bounds and a status out."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Status(Enum):
    """How a torque came about."""

    OK = "ok"
    MEASUREMENT = "a measurement is not finite"
    ESTIMATE = "the estimate is not finite"
    INFEASIBLE = "the optimisation has no solution"
    ITERATIONS = "the optimisation ran out of iterations"
    NOT_FINITE = "the optimisation is not finite"


@dataclass(frozen=True)
class Command:
    """A torque and how it came about.

    Parameters
    ----------
    torque : float
        N m, within its bounds.
    status : Status
        ``OK``, or why the safe law stepped in.
    iterations : int
        Of the solver.
    """

    torque: float
    status: Status = Status.OK
    iterations: int = 0


class Controller(Protocol):
    """Called once per sample; remembers what it needs."""

    def reset(self) -> None:
        """Forget all measurements."""

    def command(self, measured: Array) -> Command:
        """Return the torque for a measurement.

        Parameters
        ----------
        measured : array, (3,)
            Hub angle (rad), acceleration across the last link at the tip (m/s^2), bending moment at the root
            (N m); NaN where there is no such sensor.
        """
        ...
