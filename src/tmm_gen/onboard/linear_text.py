"""What the templates of a linear MPC ask for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.onboard.linear_data import LinearMpcData
from tmm_gen.onboard.text import ControllerText


@dataclass(frozen=True, eq=False)
class LinearText(ControllerText):
    """What the templates of a linear MPC ask for.

    Parameters
    ----------
    data : LinearMpcData
        Tables.
    """

    data: LinearMpcData

    @property
    def weighs(self) -> bool:
        """Whether an arm in space is to be held up."""
        return self.data.weight is not None and bool(self.data.weight.terms)

    @property
    def lifts(self) -> bool:
        """Whether an arm in a plane is to be held up."""
        return bool(self.data.holds.any())

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
