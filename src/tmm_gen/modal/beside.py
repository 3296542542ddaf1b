"""The continuous beam that a planar arm was made from, beside its modes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import LinearArm
from tmm_gen.modal.beam import BeamArm, damped_pole, natural_frequencies
from tmm_gen.modal.discretised import continuous, straight_frequencies
from tmm_gen.modal.modes import Mode

Array = NDArray[np.float64]

_KEYS = (
    "straight_hz",
    "exact_hz",
    "exact_angular_frequency",
    "exact_damping_ratio",
    "error",
    "error_percent",
)


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
    def of(cls, arm: LinearArm, modes: Sequence[Mode]) -> Beside:
        """Return the beam beside modes of an arm."""
        beam = continuous(arm.scene)
        straight = arm.rest is None or not any(abs(angle) > 1e-9 for angle in arm.rest.angles.tolist())
        if beam is None:
            return cls(None, straight, np.zeros(0), np.zeros(0))
        count = 1 + max((mode.undamped for mode in modes if mode.undamped is not None), default=0)
        found = straight_frequencies(arm.scene, count=count)
        return cls(beam, straight, natural_frequencies(beam, count), found)

    def row(self, mode: Mode) -> dict[str, object]:
        """Return what is known of the beam's mode beside one of the arm; nothing where damping mixes modes."""
        if self.beam is None:
            return {}
        if mode.undamped is None:
            return dict.fromkeys(_KEYS)
        exact, straight = float(self.exact[mode.undamped]), float(self.discretised[mode.undamped])
        pole = damped_pole(self.beam, exact) if exact > 0.0 else None
        signed = straight / exact - 1.0 if exact > 0.0 else None
        values = (
            straight / (2.0 * math.pi),
            exact / (2.0 * math.pi),
            exact,
            None if pole is None else (0.0 - pole.real) / abs(pole),
            signed,
            None if signed is None else 100.0 * signed,
        )
        return dict(zip(_KEYS, values, strict=True))
