"""Period error and numerical damping of the principal eigenvalue as numbers."""

from __future__ import annotations

import math

from tmm_gen.derive.integrators.accuracy import principal_exponent
from tmm_gen.derive.integrators.amplification import Amplification


def period_error(linear: Amplification, omega: float, zeta: float = 0.0) -> float:
    """Return (numerical period - period)/period of free motion at ``Omega = omega``."""
    return omega * math.sqrt(1 - zeta**2) / principal_exponent(linear, omega, zeta).imag - 1


def numerical_damping(linear: Amplification, omega: float, zeta: float = 0.0) -> float:
    """Return the damping ratio of free motion at ``Omega = omega`` in excess of the physical one."""
    exponent = principal_exponent(linear, omega, zeta)
    return -exponent.real / abs(exponent) - zeta
