"""The continuous beam that a planar arm was made from, beside its modes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import LinearArm
from tmm_gen.modal.beam import BeamArm, damped_pole, natural_frequencies
from tmm_gen.modal.discretised import continuous, straight_frequencies

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Beside:
    """The continuous beam beside the arm, if there is one.

    Parameters
    ----------
    beam : BeamArm or None
        The continuous beam.
    straight : bool
        Whether the arm rests straight, as the beam does.
    exact, discretised : array, (count,)
        Natural frequencies of the beam, and of the arm straight and weightless, rad/s; empty without a beam.
    """

    beam: BeamArm | None
    straight: bool
    exact: Array
    discretised: Array

    @classmethod
    def of(cls, arm: LinearArm, count: int) -> Beside:
        """Return the beam beside the lowest modes of an arm."""
        beam = continuous(arm.scene)
        straight = arm.rest is None or not any(abs(angle) > 1e-9 for angle in arm.rest.angles.tolist())
        if beam is None:
            return cls(None, straight, np.zeros(0), np.zeros(0))
        found = straight_frequencies(arm.scene, count=count)
        return cls(beam, straight, natural_frequencies(beam, count), found)

    def row(self, number: int) -> dict[str, object]:
        """Return what is known of a mode of the continuous beam."""
        if self.beam is None:
            return {}
        exact, straight = float(self.exact[number]), float(self.discretised[number])
        pole = damped_pole(self.beam, exact) if exact > 0.0 else None
        signed = straight / exact - 1.0 if exact > 0.0 else None
        return {
            "straight_hz": straight / (2.0 * math.pi),
            "exact_hz": exact / (2.0 * math.pi),
            "exact_angular_frequency": exact,
            "exact_damping_ratio": None if pole is None else (0.0 - pole.real) / abs(pole),
            "error": signed,
            "error_percent": None if signed is None else 100.0 * signed,
        }
