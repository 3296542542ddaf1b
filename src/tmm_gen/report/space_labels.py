"""How far names and numbers stand off from the sides of a field in space, so that none touches another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ELEVATION, AZIMUTH = 24.0, -58.0
"""Of the eye, degrees: from above, and neither along x nor along y."""

_NAME, _NUMBER = 21.0, 8.0
"""What Matplotlib adds to the padding of names and of numbers, points."""

_LEAST = 0.3
"""Where a number has less than this to stand off by, it would take padding without bounds."""


@dataclass(frozen=True)
class Lettering:
    """Names and numbers along the sides of a field.

    Parameters
    ----------
    size : float
        Of the numbers, points.
    name, number : float
        How far they stand off, as points of padding about a cube.
    count : int
        About how many numbers the longest side has.
    field : float
        How large the field is drawn, as a share of what Matplotlib gives it: the rest is theirs.
    """

    size: float
    name: float
    number: float
    count: int
    field: float = 1.0


STILL = Lettering(8.0, 26.0, 11.5, 5)
"""Of one large field."""
PANEL = Lettering(6.5, 16.0, 6.0, 3, 0.75)
"""Of many small ones."""


def letter(axes: Any, upward: int, sides: Array, lettering: Lettering) -> None:
    """Set names and numbers off from the sides of a field by the same way on paper, whatever its proportions.

    Matplotlib moves them away from the middle by shares of both other sides: far beside a high field, not at all
    beside a flat one.

    Parameters
    ----------
    axes : Axes3D
        With its limits set.
    upward : int
        Which axis is upright.
    sides : array, (3,)
        Of the field, m.
    lettering : Lettering
        What stands there.
    """
    shares = lettering.field * _moved(np.roll(sides, 2 - upward))
    for share, axis in zip(np.roll(shares, upward - 2), (axes.xaxis, axes.yaxis, axes.zaxis), strict=True):
        axis.labelpad = lettering.name / share - _NAME
        axis.set_tick_params(labelsize=lettering.size, pad=lettering.number / share - _NUMBER)


def _moved(sides: Array) -> Array:
    """Return how far on paper what stands by each side is moved, as a share of the same of a cube, (3,).

    The third side is upright. What stands by one of the others is moved along the other and down; what stands by it, to
    the right along both.
    """
    across, up = np.radians(AZIMUTH), np.radians(ELEVATION)
    seen = np.array(
        [
            [-np.sin(across), -np.cos(across) * np.sin(up)],
            [np.cos(across), -np.sin(across) * np.sin(up)],
            [0.0, np.cos(up)],
        ]
    )
    ways = np.array([[0.0, -1.0, -1.0], [1.0, 0.0, -1.0], [1.0, 1.0, 0.0]])
    # the field is scaled to the length of its diagonal
    shown, cube = (
        np.linalg.norm((ways * each) @ seen, axis=1) for each in (sides / np.linalg.norm(sides), 3.0**-0.5)
    )
    return np.asarray(np.maximum(shown / cube, _LEAST))
