"""What the tables of all controllers in C have."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.estimators.credible import Credible
from tmm_gen.onboard.program_data import ProgramData
from tmm_gen.onboard.weight import Weight


class ControllerData(Protocol):
    """What all controllers' tables have."""

    @property
    def size(self) -> int:
        """Entries of the state."""
        ...

    @property
    def sensors(self) -> tuple[int, ...]:
        """Which sensors there are: of m encoders, m accelerometers and m strain gauges."""
        ...

    @property
    def memory(self) -> int:
        """Past torques that count."""
        ...

    @property
    def program(self) -> ProgramData:
        """The quadratic program."""
        ...

    @property
    def brake(self) -> float | NDArray[np.float64]:
        """Of the safe law, N m s/rad, of each motor."""
        ...

    @property
    def start_torque(self) -> NDArray[np.float64]:
        """Torques before any is chosen, (m,), N m."""
        ...

    @property
    def credible(self) -> Credible:
        """What can be believed of a measurement."""
        ...

    @property
    def target_hub(self) -> NDArray[np.float64]:
        """Angles of the hubs at the target, (m,), rad."""
        ...

    @property
    def target_torque(self) -> NDArray[np.float64]:
        """Torques there, (m,), N m."""
        ...

    @property
    def holds(self) -> NDArray[np.float64]:
        """What holds up an arm in a plane, (m, m), N m."""
        ...

    @property
    def weight(self) -> Weight | None:
        """What holds up an arm in space."""
        ...
