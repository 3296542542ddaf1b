"""How far a run is from the motion that the scene's own equations have, relative to how far that motion goes.

Of a chain that is known: the motion follows from the matrix exponential. Of other arms it is estimated
(:mod:`tmm_gen.simulate.arm_accuracy`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.chain_motion import exact_angles
from tmm_gen.scene import Scene
from tmm_gen.simulate.step_error import error_per_radian
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]

MOST = 0.05
"""Largest error of a run that is not refused, as a share of the motion."""

SENSITIVE = 1e3
"""A disturbance that grows by more than this makes of the integrator's small errors large ones."""

_CHAIN_POINTS = 20_000
"""Instants of chains that are looked at, about; a blow's largest error may last a step."""

HIGHEST = 3
"""Orders above count as this one: stiff arms do not always show more."""


@dataclass(frozen=True)
class Accuracy:
    """What is known about the error of a run.

    Parameters
    ----------
    error : float
        Largest error of the motion, as a share of how far it goes; infinite where nothing can be said.
    sensitivity : float or None
        How many times larger a small disturbance of the start has become at most; None for chains, which are linear.
    good_until : float
        s; until then the error is below half of what is refused.
    from_sweeps : float
        Of the error, what sweeps have left unsolved; at most.
    """

    error: float
    sensitivity: float | None
    good_until: float
    from_sweeps: float = 0.0


def chain_accuracy(scene: Scene, signals: Mapping[str, Signal], trace: Trace) -> Accuracy:
    """Compare a chain's angles with those that it would have."""
    stride = max(1, math.ceil((len(trace.angle) - 1) / _CHAIN_POINTS))
    indices, angle = trace.indices[::stride], trace.angle[::stride]
    exact = exact_angles(scene, signals, scene.integrator.step, indices)
    off = np.max(np.abs(angle - exact), axis=1)
    way = np.max(np.abs(exact - exact[0]), axis=1)
    return judged(off, way, indices * scene.integrator.step, 0.0, None)


def judged(off: Array, way: Array, times: Array, least: float, growth: float | None) -> Accuracy:
    """Return what errors over time, (k,), say of a run, by how far the motion has come then, (k,).

    Parameters
    ----------
    off, way : array, (k,)
        In the same unit.
    times : array, (k,)
        s.
    least : float
        A way that is none.
    growth : float or None
        The sensitivity of the motion.
    """
    whole = max(float(np.max(way)), least)
    error = float(np.max(off)) / whole if whole > 0.0 else float(np.max(off) > 0.0)
    if not math.isfinite(error):
        return Accuracy(math.inf, growth, 0.0)
    # as a run that ends sooner would be judged
    shares = np.maximum.accumulate(off) / np.maximum(np.maximum.accumulate(way), max(least, 1e-300))
    bad = np.flatnonzero(shares > 0.5 * MOST)
    good = times[-1] if len(bad) == 0 else times[bad[0] - 1] if bad[0] > 0 else 0.0
    return Accuracy(error, growth, float(good))


def order_of(scene: Scene) -> float:
    """Return the order of an integrator: by what power of the step its derived error falls."""
    coarse, fine = (error_per_radian(scene.integrator, angle) for angle in (0.04, 0.02))
    return max(1.0, round(math.log2(coarse / fine))) if fine > 0.0 else 1.0
