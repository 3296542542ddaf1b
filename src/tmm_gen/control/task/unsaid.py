"""What is taken of motors where a scene does not say it.

Of an arm on a hub plain numbers. Of motors by name in units of the largest torque that each may have: what is little
for one may be all that another can do, and a filter that takes that for a change per sample makes it tremble.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.scene.each import Each, by_names

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Unsaid:
    """A number that is not said.

    Parameters
    ----------
    hub : float
        What it is of an arm on a hub.
    share, power : float and int
        What it is of a motor by name, in this power of its largest torque, N m.
    """

    hub: float
    share: float
    power: int = 0


TORQUE = Unsaid(1e-3, 0.02, -2)
TORQUE_STEP = Unsaid(1e-3, 0.05, -2)
"""Weights of predictive control: as those that were found for the example scenes, of motors of 0.06 to 20 N m."""
REGULATOR_TORQUE = Unsaid(0.1, 0.4, -2)
UNKNOWN_TORQUE = Unsaid(1e-2, 0.05, 1)
DISTURBANCE = Unsaid(1e-2, 0.01, 1)
RATE = Unsaid(0.0, 0.02)


@dataclass(frozen=True, eq=False)
class Told:
    """What scenes tell of m motors.

    Parameters
    ----------
    names : tuple of str, length m
        Theirs.
    largest : array, (m,), or None
        The largest torque of each, N m; None of an arm on a hub.
    """

    names: tuple[str, ...]
    largest: Array | None

    @classmethod
    def by(cls, motors: Motors, torque: tuple[Array, Array]) -> Told:
        """Return that of some motors, by the bounds of their torques, (m,) each, N m."""
        return cls(motors.names, None if motors.on_hub else np.max(np.abs(torque), axis=0))

    def of(self, value: Each[float] | None, unsaid: Unsaid) -> Array:
        """Return a number for each motor, (m,): that which is told, or else what is taken for it."""
        if value is not None:
            return np.array(by_names(value, self.names))
        if self.largest is None:
            return np.full(len(self.names), unsaid.hub)
        return np.asarray(unsaid.share * self.largest**unsaid.power, float)
