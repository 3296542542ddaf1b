"""What the templates of real-time iterations ask for about the gains of their filter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tmm_gen.control.quadratic.qp import INFINITE
from tmm_gen.onboard.wall_text import WallText


@dataclass(frozen=True, eq=False)
class FilterText(WallText):
    """The part of :class:`~tmm_gen.onboard.rti_text.RtiText` that is about the filter's gains."""

    @property
    def sets(self) -> int:
        """How many gains there are: by sets of sensors behind the encoders, and the one far from the target."""
        return len(self.data.gains)

    @property
    def every_sensor(self) -> int:
        """Which of them is that of all sensors."""
        return self.sets - 1 - self.far

    @property
    def far(self) -> bool:
        """Whether other gains of the filter are used far from the target."""
        return self.data.far is not None

    @property
    def gains_reach(self) -> str:
        """How far from the target hubs may be for its gains, a list of numbers."""
        assert self.data.far is not None
        return self.numbers(np.minimum(self.data.far.reach, INFINITE))
