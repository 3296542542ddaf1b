"""Whether the arm swings as its controllers predict: long steps and few cells change how fast it does.

Predicted faster than it is by more than half the width of its resonance (the damping ratio, as a share of its
frequency), a vibration is answered half a radian too early, and real-time iterations keep it up: the arm trembles. What
is predicted too slowly is only damped less.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.bench import Bench
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.where import where

_BY_STEPS = ("mpc-links", "rti-zero", "rti", "nmpc")
"""Controllers that predict by the generated step."""

_DAMPED = 0.2
"""Damping ratio from which on a vibration dies by itself."""

_FASTEST = 0.5 * np.pi
"""Radians in a sample up to which torques act on a vibration."""

_SHARE = 0.5
"""Of the damping ratio, by which a frequency may be too high."""


def swings_too_fast(bench: Bench, names: Iterable[str]) -> list[str]:
    """Return a line where controllers, by name, predict a vibration of the arm faster than it is by too much."""
    taken = [name for name in names if name in _BY_STEPS]
    if not taken:
        return []
    problem, worst = bench.problem, (0.0, 0.0, 0.0)
    predicted = swings(bench.links, problem.sample_time)
    for swing in swings(bench.modes, problem.sample_time):
        frequency, damping = abs(swing), -swing.real / abs(swing)
        if damping < _DAMPED and frequency * problem.sample_time < _FASTEST and len(predicted):
            nearest = abs(predicted[np.argmin(np.abs(predicted - swing))])
            worst = max(worst, ((nearest - frequency) / (_SHARE * damping * frequency), frequency, nearest))
    excess, frequency, nearest = worst
    if excess <= 1.0:
        return []
    key, remedy = (
        ("control.substeps", "Write more control.substeps")
        if problem.motors.on_hub
        else ("beam", "Cut beams into more `links`")
    )
    return [
        f"{where(bench.scene, key)}: a vibration of {frequency:.4g} rad/s is predicted at {nearest:.4g} rad/s "
        f"with steps of {problem.step:g} s, too fast by more than half its damping ratio: {', '.join(taken)} may "
        f"tremble. {remedy}."
    ]


def swings(model: LinearModel, period: float) -> NDArray[np.complex128]:
    """Return the poles of what swings in an arm under no control, in continuous time, 1/s, one of each pair."""
    poles = np.linalg.eigvals(model.transition).astype(complex)
    logarithms = np.log(poles[np.abs(poles) > 1e-6]) / period  # what is gone in a sample swings no more
    turning = logarithms.imag * period
    return np.asarray(logarithms[(turning > 1e-3) & (turning < 0.99 * np.pi)], complex)
