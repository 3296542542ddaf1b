"""How long to simulate where the user does not say: a few periods of the slowest swing."""

from __future__ import annotations

import math

import numpy as np

from tmm_gen.measure.assembly import assemble
from tmm_gen.measure.planar_linear import vibration
from tmm_gen.scene import Scene

_PERIODS = 5
_NICE = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0)

_STANDS = 1e-6
"""A frequency below this share of the highest is that of a chain turning as a whole."""


def default_duration(scene: Scene) -> float:
    """Return a round number of seconds that covers some periods of the lowest natural frequency."""
    from scipy.linalg import eigh_tridiagonal  # slow to import

    if scene.model.kind == "planar":
        frequencies = vibration(scene).frequencies
        return _round_up(_PERIODS * 2.0 * math.pi / float(frequencies[frequencies > 0.0][0]))
    assembly = assemble(scene)
    root = np.sqrt(np.diag(assembly.mass))
    scaled = assembly.stiffness / np.outer(root, root)
    squares = eigh_tridiagonal(np.diag(scaled), np.diag(scaled, 1), eigvals_only=True)
    swinging = squares[squares > _STANDS**2 * squares[-1]]
    return _round_up(_PERIODS * 2.0 * math.pi / math.sqrt(float(swinging[0])))


def _round_up(value: float) -> float:
    decade = 10.0 ** math.floor(math.log10(value))
    return next(float(f"{nice * decade:.3g}") for nice in _NICE if nice * decade >= value * (1.0 - 1e-9))
