"""What the templates of a linear MPC ask for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.laws.linear_mpc import APPROACH_TIME
from tmm_gen.onboard.held_text import HeldText
from tmm_gen.onboard.linear_data import LinearMpcData
from tmm_gen.onboard.program_data import INFINITE


@dataclass(frozen=True, eq=False)
class LinearText(HeldText):
    """What the templates of a linear MPC ask for.

    Parameters
    ----------
    data : LinearMpcData
        Tables.
    """

    data: LinearMpcData

    @property
    def moves(self) -> bool:
        """Whether the reference may be another one at run time."""
        return self.several

    @property
    def carries(self) -> bool:
        """Whether the payload may be another one at run time."""
        return self.moves and self.data.payload is not None

    @property
    def approaches(self) -> bool:
        """Whether hubs are brought near where the controller's model is not good."""
        return self.several

    @property
    def approach_time(self) -> float:
        """Time constant of that, s."""
        return APPROACH_TIME

    @property
    def fastest(self) -> NDArray[np.float64]:
        """Rates of hubs, (m,), rad/s, infinite as the solver has it."""
        return np.minimum(self.problem.hub_rate, INFINITE)

    @property
    def ranges(self) -> NDArray[np.float64]:
        """How far hubs may be from the target, (m,), rad, infinite as the solver has it."""
        return np.minimum(self.data.range, INFINITE)

    @property
    def told_reach(self) -> str:
        """How far the model is good, for people."""
        names = zip(self.problem.motors.names, self.data.range, strict=True)
        return ", ".join(f"{value:g} rad ({name})" for name, value in names if np.isfinite(value))

    @property
    def bounds_places(self) -> bool:
        """Whether rows bound tips or hubs."""
        return bool(self.data.tips or self.turned_kinds)

    @property
    def sags(self) -> bool:
        """Whether weight makes a difference to how the arm rests elsewhere."""
        return self.upheld

    @property
    def feels(self) -> bool:
        """Whether sensors behind the encoders show that."""
        return self.sags and len(self.data.sensors) > self.motors

    @property
    def turned_kinds(self) -> list[tuple[int, int]]:
        """Kinds of rows that bound hubs, and whose."""
        return [(place, kind.motor) for place, kind in enumerate(self.data.kinds) if kind.what == "hub"]

    @property
    def estimated(self) -> str:
        """How many numbers are estimated, an expression of C."""
        if not self.several:
            return "STATES + 1"
        return "STATES + MOTORS" + (" + BIASES" if self.data.biases else "")

    def of_each(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return a column for each motor, or the only one alone of an arm on a hub."""
        return values if self.several else values[:, 0]

    @property
    def stopping(self) -> list[float]:
        """Half the angle in which each kind of rows is stopped, negative of rates; see `ProgramData`."""
        stopping = self.data.program.stopping
        return [-1.0 if kind.what == "hub_rate" else float(stopping[kind.motor]) for kind in self.data.kinds]

    @property
    def felt(self) -> list[tuple[int, NDArray[np.float64]]]:
        """Places of accelerometers that feel products of the hubs' rates, and these products' factors, (m, m)."""
        return [
            (self.data.sensors.index(self.motors + motor), factors)
            for motor, factors in enumerate(self.data.swept)
            if self.motors + motor in self.data.sensors and factors.any()
        ]
