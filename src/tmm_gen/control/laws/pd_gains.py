"""Gains of PD control that a scene does not tell: critical damping of the rigid arm, as slow as samples ask for.

A sampled double integrator under ``u = -p q - d (q[k] - q[k-1])/T`` with ``p = J s^2``, ``d = 2 J s`` has

    2 z^3 + (x^2 + 2 x - 4) z^2 + (x^2 + 2) z - 2 x = 0,   x = s T,

which is stable up to ``x = (sqrt(41) - 5)/2 = 0.70``. An arm that bends is so up to less, one that its motors hold up
from some frequency on, and both change with the delay: its linear model about the reference tells.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.where import where

Array = NDArray[np.float64]

_SHARE = 0.25
"""Of the arm's first frequency."""
_HALVINGS = 5
"""How often that is tried at half as much."""
_GROWTH = 1e-6
"""Per sample, that is rounding: of vibrations without damping."""


def usual_gains(bench: Bench) -> tuple[Array, Array]:
    """Return gains, (m,) each, N m/rad and N m s/rad, of the first frequency tried that is stable.

    Tried are a quarter of the arm's first frequency, and that halved again and again. Where none is stable they are
    those with which the arm swings more the least.
    """
    tried = _SHARE * arm_of(bench.scene).slowest() * 0.5 ** np.arange(_HALVINGS + 1)
    growths = []
    for slow in tried:
        growths.append(_growth_at(bench, slow))
        if growths[-1] <= _GROWTH:
            break
    return _critical(bench, tried[int(np.argmin(growths))])


def unstable_pd(bench: Bench, names: Iterable[str]) -> list[str]:
    """Return a line where some controllers, by name, take gains that are not told, and all of those are unstable."""
    control = bench.scene.control
    assert control is not None
    keys = [name.replace("-", "_") for name in names if name.startswith("pd")]
    untold = [key for key in keys if getattr(control.baselines, key) is None]
    if not untold:
        return []
    problem = bench.problem
    growth = pd_growth(bench.modes, problem.sample_time, *usual_gains(bench))
    if growth <= _GROWTH:
        return []
    return [
        f"{where(bench.scene, 'control.baselines')}: no gains are written for {', '.join(untold)}, and none that PD "
        f"takes then are stable with samples of {problem.sample_time:g} s and a delay of {problem.delay:g} s: the arm "
        f"swings {100.0 * growth:.2g} % more each sample. Write gains there, or a shorter control.delay or "
        "control.sample_time."
    ]


def pd_growth(model: LinearModel, period: float, proportional: Array, derivative: Array) -> float:
    """Return by how much, relative to it, the motion of a sampled arm under PD that lasts longest grows in a sample.

    It is below 0 where all motion dies out.

    Parameters
    ----------
    model : LinearModel
        Of the arm about its target.
    period : float
        Time between samples, s.
    proportional, derivative : array, (m,)
        Gains on the hubs' angles and their differences over a sample, N m/rad and N m s/rad.
    """
    size, count, whole = model.size, model.count, model.delay.whole
    total = size + count * (whole + 2)  # state, hubs a sample ago, torques of so many samples ago
    past = np.split(np.eye(total)[size + count :], whole + 1)
    torque = np.zeros((count, total))
    torque[:, :size] = -(proportional + derivative / period)[:, None] * model.hub
    torque[:, size : size + count] = np.diag(derivative / period)
    chosen = [torque, *past]
    after = np.zeros((size, total))
    after[:, :size] = model.transition
    after += model.before @ chosen[whole + 1] + model.then @ chosen[whole]
    hubs = np.zeros((count, total))
    hubs[:, :size] = model.hub
    closed = np.vstack([after, hubs, *chosen[:-1]])
    if not np.all(np.isfinite(closed)):
        return np.inf
    return float(np.max(np.abs(np.linalg.eigvals(closed)))) - 1.0


def _growth_at(bench: Bench, slow: float) -> float:
    return pd_growth(bench.modes, bench.problem.sample_time, *_critical(bench, slow))


def _critical(bench: Bench, slow: float) -> tuple[Array, Array]:
    """Return the gains of critical damping of the rigid arm at a frequency, rad/s."""
    return bench.inertia * slow**2, 2.0 * bench.inertia * slow
