"""The error that a motion owes to its step: what it varies with, put into the integrator's own error.

The frequency is the motion's own, weighed by how far the bodies move: ringing in fast modes hardly moves them. What a
parabola in time explains is left out: constant acceleration is followed exactly by steps of second order, and a run
much shorter than a period shows little else. The estimate is meant to be low rather than high.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Integrator

if TYPE_CHECKING:
    from tmm_gen.derive.integrators.amplification import Amplification

Array = NDArray[np.float64]

_DEGREE = 2
_LONGEST = 0.5
"""Radians per step up to which an integrator's error is looked up: some know no vibration beyond."""

_SHORTEST = 1e-6
"""Radians per step below which no digits of its error would be left."""


def step_error(arm: Arm, times: Array, q: Array, v: Array) -> float:
    """Return the error that the step leaves in a motion, per radian of it and as a share of how far it goes.

    Parameters
    ----------
    arm : Arm
        What moves.
    times : array, (k,)
        Instants looked at, s, increasing; each stands for the time since the one before.
    q, v : array, (k, n)
        Angles and rates of the coordinates there.

    Returns
    -------
    float
        Zero without motion; of three instants or fewer, as for a long step.
    """
    if len(times) <= _DEGREE + 1:  # a parabola explains them all: nothing tells that the step is short
        return error_per_radian(arm.scene.integrator, _LONGEST)
    spans = np.diff(times, prepend=0.0)
    roots = np.sqrt(np.concatenate([arm.masses, arm.masses]))
    place = roots * np.concatenate([arm.walked(np.cos(q)), arm.walked(np.sin(q))], axis=1)
    speed = roots * np.concatenate([arm.walked(-np.sin(q) * v), arm.walked(np.cos(q) * v)], axis=1)
    moved = _mean(place - np.average(place, axis=0, weights=spans), spans)
    scaled = 2.0 * times / times[-1] - 1.0
    powers = legendre.legvander(scaled, _DEGREE)
    weights = np.sqrt(spans)[:, None]
    smooth = np.linalg.lstsq(weights * powers, weights * place, rcond=None)[0]
    rest = _mean(place - powers @ smooth, spans)
    slope = legendre.legval(scaled, legendre.legder(smooth)).T * 2.0 / times[-1]
    if moved == 0.0 or rest == 0.0:
        return 0.0
    frequency = _mean(speed - slope, spans) / rest
    return rest / moved * error_per_radian(arm.scene.integrator, frequency * arm.scene.integrator.step)


def error_per_radian(declared: Integrator, angle: float) -> float:
    """Return how far an integrator strays from a free vibration, per radian of it: in phase and in amplitude.

    Parameters
    ----------
    declared : Integrator
        Of a scene.
    angle : float
        Radians of the vibration per step; above 0.5 it counts as 0.5.
    """
    from tmm_gen.derive.integrators.accuracy import principal_exponent

    angle = min(max(angle, _SHORTEST), _LONGEST)
    linear = _amplification(declared.name, tuple(sorted(declared.parameters.items())))
    try:
        return abs(principal_exponent(linear, angle) / angle - 1j)
    except ValueError:  # no vibration any more, so early: any error is its step's
        return 1.0


@lru_cache
def _amplification(name: str, parameters: tuple[tuple[str, float], ...]) -> Amplification:
    from tmm_gen.derive.integrators.amplification import amplification
    from tmm_gen.derive.integrators.registry import integrator

    return amplification(integrator(name, **dict(parameters)).main)


def _mean(values: Array, spans: Array) -> float:
    """Return the root of the mean square over time, summed over columns."""
    return float(np.sqrt(np.average(np.sum(values**2, axis=1), weights=spans)))
