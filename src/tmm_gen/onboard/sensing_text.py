"""What the templates ask of accelerometers and strain gauges of an arm by parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.sensors.accelerometers import PlanarAccelerometer, SpaceAccelerometer
from tmm_gen.control.sensors.gauges import Gauge
from tmm_gen.control.sensors.sensing import Sensing

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SensingText:
    """Sensors behind the encoders, with their places among those that an emitted controller reads.

    Parameters
    ----------
    sensing : Sensing
        Of the model.
    sensors : tuple of int
        Which there are of m encoders, m accelerometers and m gauges.
    """

    sensing: Sensing
    sensors: tuple[int, ...]

    @property
    def biases(self) -> int:
        """How many there are: each is off by something that stays."""
        return len(self.sensors) - self.sensing.count

    @property
    def feels(self) -> bool:
        """Whether there is an accelerometer."""
        return any(self.sensing.accelerometers)

    @property
    def planar(self) -> list[tuple[int, PlanarAccelerometer]]:
        """Accelerometers of an arm in a plane, with their places."""
        return [(at, each) for at, each in self._felt if isinstance(each, PlanarAccelerometer)]

    @property
    def spatial(self) -> list[tuple[int, SpaceAccelerometer]]:
        """Accelerometers of an arm in space, with their places."""
        return [(at, each) for at, each in self._felt if isinstance(each, SpaceAccelerometer)]

    @property
    def bent(self) -> list[tuple[int, list[tuple[str, int, float]]]]:
        """Gauges with their places: each a sum of entries of the state, by which part of it, number and factor."""
        count = self.sensing.count
        return [
            (self.sensors.index(2 * count + motor), _terms(gauge))
            for motor, gauge in enumerate(self.sensing.gauges)
            if gauge is not None
        ]

    @property
    def _felt(self) -> list[tuple[int, PlanarAccelerometer | SpaceAccelerometer]]:
        count = self.sensing.count
        return [
            (self.sensors.index(count + motor), each)
            for motor, each in enumerate(self.sensing.accelerometers)
            if each is not None
        ]


def _terms(gauge: Gauge) -> list[tuple[str, int, float]]:
    return [
        (part, int(place), float(row[place]))
        for part, row in (("angle", gauge.angle), ("rate", gauge.rate))
        for place in np.flatnonzero(row)
    ]
