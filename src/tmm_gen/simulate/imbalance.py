"""How well the energies of a run balance."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.curve import Curve
from tmm_gen.inputs.signals import Signal
from tmm_gen.inputs.waveforms import Step
from tmm_gen.reference.energy import energy
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import PRESCRIBED
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]

_FEW = 5
"""Steps over which a load must spread for its work to be known from its values at them."""


def imbalance_of(
    scene: Scene, signals: Mapping[str, Signal], time: Array, trace: Trace | None
) -> float | None:
    """Return how well a planar arm's energies balance; None where a load is too abrupt to know its work.

    Parameters
    ----------
    scene : Scene
        Of any kind; only a planar arm's are looked at.
    signals : mapping from str to Signal
        All inputs by name.
    time : array, (k,)
        Instants of the trace, s.
    trace : Trace, optional
        The motion of all links.
    """
    step, until = scene.integrator.step, float(time[-1])
    abrupt = any(_abrupt(signals[item.name], item.acts, step, until) for item in scene.inputs)
    flat = scene.model.in_plane
    if not flat or trace is None or len(time) < 3 or abrupt:
        return None
    return energy(scene, signals, time, trace.angle, trace.rate).imbalance


def _abrupt(signal: Signal, acts: str, step: float, until: float) -> bool:
    """Whether a load changes within a few steps, or the rate of a prescribed base jumps on the way."""
    knots = signal.knots
    if acts in PRESCRIBED:
        return isinstance(signal, Curve) and any(0.0 < knots[row] < until for row, _ in signal.corners)
    return isinstance(signal, Step) or bool(np.min(np.diff(knots), initial=np.inf) < _FEW * step)
