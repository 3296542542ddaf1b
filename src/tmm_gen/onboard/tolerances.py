"""Tolerances of DAQP by number type."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Tolerances:
    """Settings of DAQP's core; see its documentation.

    Parameters
    ----------
    primal : float
        By how much a bound may be passed, in its own unit.
    dual, zero, pivot, progress, singular, refactor : float
        Of multipliers, directions, pivots, the objective and factors, all normalised.
    """

    primal: float
    dual: float
    zero: float
    pivot: float
    progress: float
    singular: float
    refactor: float


TOLERANCES = {
    "float64": Tolerances(1e-6, 1e-12, 1e-11, 1e-8, 1e-14, 3.7e-11, 1e-9),  # DAQP's own
    "float32": Tolerances(1e-5, 1e-6, 1e-6, 1e-4, 1e-7, 1e-6, 1e-5),
}
"""Of a solver in float32, what rounding leaves of them."""
