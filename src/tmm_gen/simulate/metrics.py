"""Figures by which responses are judged."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def rms_error(response: ArrayLike, exact: ArrayLike, scale: float) -> float:
    """Return the root mean square of a deviation relative to a scale, such as the static deflection."""
    deviation = np.asarray(response, float) - np.asarray(exact, float)
    return float(np.sqrt(np.mean(deviation**2)) / abs(scale))


def largest_error(response: ArrayLike, exact: ArrayLike, scale: float) -> float:
    """Return the largest deviation relative to a scale."""
    return float(np.max(np.abs(np.asarray(response, float) - np.asarray(exact, float))) / abs(scale))


@dataclass(frozen=True)
class StepFigures:
    """What is said of a response that goes from a start to a final value.

    Parameters
    ----------
    start, final : float
        Values it goes between.
    peak, peak_time : float
        The value farthest from the start in the direction of the final value, and when, s.
    overshoot : float
        By how much the peak passes the final value, relative to the way from start to final; not negative.
    settling_time : float or None
        From then on the response stays within the band about the final value, s; None if it never does.
    """

    start: float
    final: float
    peak: float
    peak_time: float
    overshoot: float
    settling_time: float | None


def step_figures(
    time: ArrayLike, response: ArrayLike, final: float | None = None, band: float = 0.02
) -> StepFigures:
    """Return peak, overshoot and settling time of a response.

    Parameters
    ----------
    time, response : array, (k,)
        Samples, the first one at the start.
    final : float, optional
        Value approached; by default the last sample.
    band : float
        Half-width of the band, relative to the way from start to final; or, where these are the same,
        to the largest distance from there.
    """
    t, y = np.asarray(time, float), np.asarray(response, float)
    start, final = float(y[0]), float(y[-1] if final is None else final)
    way = final - start
    ahead = np.abs(y - start) if way == 0.0 else (y - start) * np.sign(way)
    top = int(np.argmax(ahead))
    overshoot = 0.0 if way == 0.0 else max(0.0, (float(y[top]) - final) / way)
    away = np.abs(y - final)
    settling = settled_from(t, away, band * (abs(way) or float(np.max(away))))
    return StepFigures(start, final, float(y[top]), float(t[top]), overshoot, settling)


def settled_from(time: ArrayLike, away: ArrayLike, band: float) -> float | None:
    """Return from when on a response stays within a band about its final value.

    Parameters
    ----------
    time, away : array, (k,)
        Samples, s, and how far it is from the final value there; not negative.
    band : float
        Half-width of the band, in the unit of the response.

    Returns
    -------
    float or None
        s; None if it is outside at the end.
    """
    t = np.asarray(time, float)
    outside = np.flatnonzero(~(np.asarray(away, float) <= band))
    if len(outside) == 0:
        return float(t[0])
    return float(t[outside[-1] + 1]) if outside[-1] + 1 < len(t) else None


@dataclass(frozen=True)
class Slope:
    """A line through errors over steps in double logarithmic scale.

    Parameters
    ----------
    order : float
        Its slope: errors go with ``step**order``.
    spread : float
        Largest difference between it and the slope from one step to the next.
    """

    order: float
    spread: float


def convergence_slope(steps: ArrayLike, errors: ArrayLike) -> Slope:
    """Fit the order of convergence.

    Raises
    ------
    ValueError
        If there are fewer than two steps, or an error is not positive.
    """
    h, e = np.log(np.asarray(steps, float)), np.asarray(errors, float)
    if len(h) < 2 or not np.all(e > 0.0):
        raise ValueError("a slope needs two steps at least and positive errors")
    e = np.log(e)
    order = float(np.polyfit(h, e, 1)[0])
    local = np.diff(e) / np.diff(h)
    return Slope(order, float(np.max(np.abs(local - order))))
