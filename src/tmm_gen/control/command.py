"""What a controller is: measurements in, torques within bounds and a status out."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


class Status(Enum):
    """How a torque came about.

    The first three are the controller's own law, with all or with less than there should be; with the others the
    safe law stepped in. In C they have other numbers.
    """

    OK = "ok"
    REDUCED = "a sensor was left out"
    RELAXED = "soft bounds were left out"
    MEASUREMENT = "the encoder shows nothing that can be"
    ESTIMATE = "the estimate is of no use"
    INFEASIBLE = "the optimisation has no solution"
    ITERATIONS = "the optimisation ran out of iterations"
    NOT_FINITE = "the optimisation is not finite"
    MISSING = "a pointer is NULL"

    @property
    def optimal(self) -> bool:
        """Whether the torque is that of the controller's own law."""
        return self in (Status.OK, Status.REDUCED, Status.RELAXED)


@dataclass(frozen=True, eq=False)
class Command:
    """Torques and how they came about.

    Parameters
    ----------
    torque : array, (m,)
        N m, within their bounds.
    status : Status
        ``OK``, or what was not as it should be.
    iterations : int
        Of the solver.
    """

    torque: Array
    status: Status = Status.OK
    iterations: int = 0


class Controller(Protocol):
    """Called once per sample; remembers what it needs."""

    def reset(self) -> None:
        """Forget all measurements."""

    def follow(self, angles: Array) -> Status:
        """Take what the reference is to be over the horizon, before :meth:`prepare`.

        It is kept until another is given, moves on by a sample with each measurement, and rests where it ends. Before
        the first the reference is that of the scene.

        Parameters
        ----------
        angles : array, (N, m)
            Joint angles a sample after the measurement that comes, and at the samples after that, rad.

        Returns
        -------
        Status
            ``OK``; ``NOT_FINITE``: there is no such pose; ``INFEASIBLE``: the motors could not hold the arm at the end.
            What is not OK leaves the former reference.
        """
        ...

    def prepare(self) -> None:
        """Do what needs no measurement, once a sample's torques are out; :meth:`command` does it where nobody did."""

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques for a measurement.

        Parameters
        ----------
        measured : array, (3 m,)
            Hub angles (rad), accelerations across the last links at the tips (m/s^2), bending moments at the roots
            (N m), m of each; NaN where there is no such sensor.
        valid : array of bool, (3 m,), optional
            Which of them to look at; by default all. What is not valid is as good as NaN.
        """
        ...


def shown(measured: Array, valid: Flags | None) -> Array:
    """Return a measurement, NaN where it is not valid; with arguments as for :meth:`Controller.command`."""
    measured = np.asarray(measured, float)
    return measured if valid is None else np.where(valid, measured, np.nan)
