"""What turns an arm: its motors, what each of them carries, and the rows that give their angles.

Every motor has a *hub*, what it turns against what carries it as its encoder sees it (behind an elastic gear where the
encoder is at the output), and a *tip*, the outer end of what it carries up to the
next motor. Both angles are linear in those of the arm: the hub's is that of the motor's joint, the tip's the
length-weighted mean of the links' angles against what carries the motor, which differs from that of the chord by the
third power of the bending. An arm on a hub has one motor, the hub itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

HUB = "hub"
"""Name of the motor of an arm on a hub."""


@dataclass(frozen=True)
class Motor:
    """A joint that an input turns.

    Parameters
    ----------
    name, input_name : str
        Of the motor, and of the input that is its torque.
    place : int
        Which of the arm's angles is that of its outer side.
    host : int
        Which is that of its inner side; -1 where that is the ground.
    end : int
        Behind the last of the angles of the links it carries up to the next motor.
    gear : float
        Its torque acts so many times at the joint.
    hub : tuple of int
        Which angles add up to the hub's, less that of the host: those up to where its encoder is.
    """

    name: str
    input_name: str
    place: int
    host: int
    end: int
    gear: float
    hub: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Motors:
    """The m motors of an arm of d angles, from the base outward.

    Parameters
    ----------
    each : tuple of Motor
        At least one.
    lengths : array, (d,)
        Of the links that belong to the angles, m; that of a hub is zero.
    on_hub : bool
        Whether the arm stands on a hub; its reference is then the angle of its tip, else those of the hubs.
    """

    each: tuple[Motor, ...]
    lengths: Array
    on_hub: bool

    @property
    def count(self) -> int:
        """Number of motors, m."""
        return len(self.each)

    @property
    def names(self) -> tuple[str, ...]:
        """Their names."""
        return tuple(motor.name for motor in self.each)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs that are their torques."""
        return tuple(motor.input_name for motor in self.each)

    @cached_property
    def hub(self) -> Array:
        """Rows that give the hubs' angles, (m, d)."""
        found = np.zeros((self.count, len(self.lengths)))
        for row, motor in zip(found, self.each, strict=True):
            row[list(motor.hub)] = 1.0
            if motor.host >= 0:
                row[motor.host] = -1.0
        return found

    @cached_property
    def tip(self) -> Array:
        """Rows that give the tips' angles, (m, d)."""
        found = np.zeros((self.count, len(self.lengths)))
        for row, motor in zip(found, self.each, strict=True):
            carried = self.lengths[motor.place : motor.end]
            row[motor.place : motor.end] = carried / carried.sum()
            if motor.host >= 0:
                row[motor.host] = -1.0
        return found

    @property
    def prescribed(self) -> Array:
        """Rows of the angles that the reference prescribes, (m, d)."""
        return self.tip if self.on_hub else self.hub

    @cached_property
    def turned(self) -> Array:
        """What the angles grow by where a hub turns by 1 rad and nothing bends, (d, m)."""
        found = np.zeros((len(self.lengths), self.count))
        for k, motor in enumerate(self.each):
            found[motor.place :, k] = 1.0
        return found

    @cached_property
    def drive(self) -> Array:
        """Torques on the angles for a unit of each motor's, (d, m)."""
        found = np.zeros((len(self.lengths), self.count))
        for k, motor in enumerate(self.each):
            found[motor.place, k] = motor.gear
            if motor.host >= 0:
                found[motor.host, k] = -motor.gear
        return found

    @property
    def gears(self) -> Array:
        """Of each motor, (m,)."""
        return np.array([motor.gear for motor in self.each])

    def inertia(self, mass: Array) -> Array:
        """Return what each motor would turn if nothing bent and no other turned, (m,), by its own torque, kg m^2.

        Parameters
        ----------
        mass : array, (d, d)
            Of the arm's angles, kg m^2.
        """
        carried = [mass[motor.place :, motor.place :].sum() for motor in self.each]
        return np.array(carried) / self.gears

    def bent(self, angles: Array) -> float:
        """Return the largest angle between a link and the hub of the motor that carries it, rad; angles are (d,)."""
        bent = [np.max(np.abs(angles[m.place : m.end] - angles[m.place])) for m in self.each]
        return float(max(bent))

    def torques(self, values: Array) -> dict[str, float]:
        """Return torques, (m,), by the names of their inputs."""
        return dict(zip(self.inputs, map(float, values), strict=True))
