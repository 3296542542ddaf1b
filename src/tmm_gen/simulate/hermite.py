"""Polynomials through values and their derivatives at nodes of steps, for many steps at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def hermite(shares: Array, spans: Array, data: Sequence[Sequence[Array]]) -> list[Array]:
    """Return value, rate and acceleration of polynomials through values and derivatives at nodes of steps.

    Parameters
    ----------
    shares : array, (r,)
        Where, in steps from the start of the step.
    spans : array, (r,)
        Lengths of the steps, s.
    data : sequence of sequence of array, (r, ...)
        Values at the nodes, which are equally far apart from start to end; then first derivatives, and so on.
    """
    origin = data[0][0]
    x, h = along(shares, origin), along(spans, origin)
    powers = _by_conditions(len(data[0]), len(data))
    known = [values - origin for values in data[0]]
    for derivative, values in enumerate(data[1:], start=1):
        known += [h**derivative * value for value in values]
    c = [
        sum((float(w) * k for w, k in zip(row, known, strict=True)), np.zeros(np.shape(origin)))
        for row in powers
    ]
    found = []
    for derivative in range(3):
        value = np.zeros(np.shape(origin))
        for power in range(len(c) - 1, derivative - 1, -1):
            value = value * x + math.perm(power, derivative) * c[power]
        found.append(value / np.where(h > 0.0, h, 1.0) ** derivative)
    found[0] = found[0] + origin
    return found


@cache
def _by_conditions(nodes: int, derivatives: int) -> Array:
    """Return coefficients in powers of the share, lowest first, by values at nodes, then their derivatives."""
    count = nodes * derivatives
    rows = []
    for derivative in range(derivatives):
        for node in np.linspace(0.0, 1.0, nodes):
            rows.append([math.perm(p, derivative) * node ** max(p - derivative, 0) for p in range(count)])
    found: Array = np.linalg.inv(np.array(rows))
    return found


def along(values: Array, like: Array) -> Array:
    """Give numbers for each instant as many axes as arrays of them have."""
    return values.reshape(values.shape + (1,) * (np.ndim(like) - 1))
