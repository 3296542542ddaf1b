"""A uniform beam between two nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Member:
    """A uniform beam.

    Parameters
    ----------
    length : float
        m.
    bending_stiffness : float
        E I, N m^2.
    mass_per_length : float
        rho A, kg/m.
    rotary_inertia : float
        rho I per length, kg m; zero for Euler and Bernoulli.
    shear_compliance : float
        1 / (kappa G A), 1/N; zero for Euler and Bernoulli.
    damping_time : float
        Stiffness-proportional (Kelvin-Voigt) damping, s: ``E I (1 + damping_time s)``, and the shear
        stiffness likewise.
    """

    length: float
    bending_stiffness: float
    mass_per_length: float
    rotary_inertia: float = 0.0
    shear_compliance: float = 0.0
    damping_time: float = 0.0

    @property
    def rotary(self) -> float:
        """Rotary inertia over mass and length squared, dimensionless."""
        return self.rotary_inertia / (self.mass_per_length * self.length**2)

    @property
    def shear(self) -> float:
        """Shear compliance times bending stiffness over length squared, dimensionless."""
        return self.shear_compliance * self.bending_stiffness / self.length**2

    @property
    def unit_frequency(self) -> float:
        """``sqrt(E I / (rho A L^4))``, rad/s: frequencies are ``lambda^2`` of these."""
        return float(np.sqrt(self.bending_stiffness / self.mass_per_length)) / self.length**2

    def frequency_number(self, s: Complex) -> Complex:
        """Return ``p = rho A L^4 s^2 / (E I (1 + damping_time s))``."""
        p: Complex = (s / self.unit_frequency) ** 2 / (1.0 + self.damping_time * s)
        return p

    def undamped(self) -> Member:
        """Return the same beam without damping."""
        return Member(
            self.length,
            self.bending_stiffness,
            self.mass_per_length,
            self.rotary_inertia,
            self.shear_compliance,
        )
