"""How an arm moves from rest under loads that swing, in small motion: what loads of a study are measured by.

The motion from rest and no steady swing: what no spring holds goes on at the speed that the first half swing gives it,
and soft springs give way to that, far beyond what they swing by in the end.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_STEPS = 40
"""In a period of the quickest load: motion at its frequency is late by a fifth of a per cent of what has passed."""

_LOOKED_AT = 4
"""Steps between two instants that are looked at."""


def swung(
    mass: Array, damping: Array, stiffness: Array, pushes: Array, frequencies: Array, until: float
) -> Iterator[Array]:
    """Yield coordinates at instants up to the end, (n, m): column k is what ``pushes[:, k] sin(w_k t)`` alone does.

    By Newmark's method, whose steps no stiff spring limits.

    Parameters
    ----------
    mass, damping, stiffness : array, (n, n)
        Of the small motion; the mass is positive definite.
    pushes : array, (n, m)
        A unit of each load.
    frequencies : array, (m,)
        rad/s.
    until : float
        s.
    """
    from scipy.linalg import lu_factor, lu_solve  # slow to import

    periods = float(np.max(frequencies)) * until / (2.0 * math.pi)
    steps = _LOOKED_AT * math.ceil(_STEPS * max(periods, 1.0) / _LOOKED_AT)
    h = until / steps
    pivots = lu_factor(mass + 0.5 * h * damping + 0.25 * h * h * stiffness)
    q, v, a = np.zeros((3, *pushes.shape))
    for step in range(1, steps + 1):
        q, v = q + h * v + 0.25 * h * h * a, v + 0.5 * h * a
        a = lu_solve(pivots, pushes * np.sin(frequencies * step * h) - damping @ v - stiffness @ q)
        q, v = q + 0.25 * h * h * a, v + 0.5 * h * a
        if step % _LOOKED_AT == 0:
            yield q
