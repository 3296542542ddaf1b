"""What the templates ask for of what holds an arm up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.onboard.text import ControllerText


@dataclass(frozen=True, eq=False)
class HeldText(ControllerText):
    """What the templates ask for of what holds an arm up."""

    @property
    def weighs(self) -> bool:
        """Whether an arm in space is to be held up."""
        return self.data.weight is not None and bool(self.data.weight.terms)

    @property
    def lifts(self) -> bool:
        """Whether an arm in a plane is to be held up."""
        return bool(self.data.holds.any())

    @property
    def upheld(self) -> bool:
        """Whether an arm is to be held up."""
        return self.weighs or self.lifts

    @property
    def beside(self) -> NDArray[np.float64]:
        """What the torques at the target are beside those that hold up an arm that does not bend, (m,), N m."""
        data = self.data
        if data.weight is not None:
            return data.weight.beside(data.target_hub, data.target_torque)
        lifted: NDArray[np.float64] = data.holds @ np.cos(np.cumsum(data.target_hub))
        return data.target_torque - lifted
