"""Slopes seen from the inner side of a hinge: rows and columns turned at once, by what the turn leaves alone.

Of the four entries across the axis a turn changes neither the trace nor the difference of the two that couple, so that
two numbers say what it does to all four.
"""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.declaration import AXES
from tmm_gen.derive.space.outward import COSINE, SINE
from tmm_gen.derive.space.sheet import Sheet


class HingeTurn:
    """Turns slopes from the outer axes of a hinge into its inner ones: ``turn^T block turn``, with names on a sheet.

    Parameters
    ----------
    sheet : Sheet
        Where values get names.
    axis : int
        Of the hinge.
    """

    def __init__(self, sheet: Sheet, axis: int) -> None:
        self._sheet = sheet
        self._squared = sheet.named("sine_squared", SINE**2)
        self._mixed = sheet.named("sine_cosine", SINE * COSINE)
        self._axis, self._i, self._j = axis, (axis + 1) % 3, (axis + 2) % 3

    def block(self, name: str, block: sp.Matrix) -> sp.Matrix:
        """Return one block, shape (3, 3), of a force or moment by a motion."""
        axis, i, j, sheet = self._axis, self._i, self._j, self._sheet
        found = block.copy()
        spread = sheet.named(f"spread_{name}", block[j, j] - block[i, i])
        shear = sheet.named(f"shear_{name}", block[i, j] + block[j, i])
        grown = sheet.named(f"grown_{name}", self._squared * spread - self._mixed * shear)
        sheared = sheet.named(f"sheared_{name}", self._squared * shear + self._mixed * spread)
        found[i, i], found[j, j] = block[i, i] + grown, block[j, j] - grown
        found[i, j], found[j, i] = block[i, j] - sheared, block[j, i] - sheared
        for one, other, sign in ((i, j, -1), (j, i, 1)):
            found[axis, one] = COSINE * block[axis, one] + sign * SINE * block[axis, other]
            found[one, axis] = COSINE * block[one, axis] + sign * SINE * block[other, axis]
        force, motion = name.split("_by_")
        return sp.Matrix(
            3,
            3,
            lambda r, c: sheet.named(f"turned_{force}_{AXES[r]}_by_{motion}_{AXES[c]}", found[r, c]),
        )
