"""The motion that a chain would have, at many instants: what steps of a simulation are held against.

During a step the inputs are polynomials (``cubics.py``), and the motion follows from the matrix exponential of the
linear system (``chain_linear.py``). Nothing here comes from `derive` or `program`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Harmonic, Signal
from tmm_gen.inputs.waveforms import Chirp
from tmm_gen.reference.chain_linear import Linear, linear_chain
from tmm_gen.reference.cubics import DEGREE, projected
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_CHUNK = 4096
_LEAST_STEPS, _FINEST = 2000, 4000
"""Pieces of time in all over which inputs are cubics, and most of them in a step."""

_SWING = 0.5
"""Radians of a harmonic input in such a piece."""


def exact_angles(scene: Scene, signals: Mapping[str, Signal], step: float, indices: Array) -> Array:
    """Return the angles of hub and links behind some numbers of steps, (k, m), rad.

    Parameters
    ----------
    scene : Scene
        Of kind "chain".
    signals : mapping from str to Signal
        All its inputs by name.
    step : float
        s.
    indices : array, (k,)
        Whole numbers from 0 on, equally far apart.
    """
    linear = linear_chain(scene)
    ordered = [signals[item.name] for item in scene.inputs]
    stride = round(float(indices[1] - indices[0])) if len(indices) > 1 else 1
    at_rest = all(isinstance(s, Constant) for s in ordered)
    # a few long steps may hold many kinks and swings of an input, which no cubic is
    total = (len(indices) - 1) * stride
    swing = max((_fastest(s) for s in ordered), default=0.0) * step / _SWING
    finer = min(_FINEST, max(1, math.ceil(_LEAST_STEPS / max(total, 1)), math.ceil(swing)))
    h, per = (step * stride, 1) if at_rest else (step / finer, stride * finer)
    transition, response = _transition(linear, h)
    found = np.empty((len(indices), len(linear.through)))
    values = np.array([float(s.at(0.0)) for s in ordered])
    state = linear.start + linear.begun @ values
    found[0] = _read(linear, state) + linear.through @ values
    total = (len(indices) - 1) * per
    for first in range(0, total, _CHUNK):
        count = min(_CHUNK, total - first)
        pushed, ends = _pushed(response, ordered, h, first, count)
        for k in range(count):
            state = (
                np.einsum("bij,bj->bi", transition, state) if len(transition) > 1 else state @ transition[0].T
            )
            state = state + pushed[k]
            if (first + k + 1) % per == 0:
                place = (first + k + 1) // per
                found[place] = _read(linear, state) + linear.through @ ends[k]
    return found


def _fastest(signal: Signal) -> float:
    """Return the highest angular frequency an input swings at by itself, rad/s."""
    if isinstance(signal, Chirp):
        return 2.0 * math.pi * max(signal.first, signal.last)
    return signal.frequency if isinstance(signal, Harmonic) else 0.0


def _transition(linear: Linear, h: float) -> tuple[Array, Array]:
    """Return what becomes of a state in a step, and the answer to each power of time of each input.

    Returns
    -------
    transition : array, (b, s, s)
    response : array, (b, s, inputs, powers)
        To ``(t / h)^p`` of an input during the step.
    """
    from scipy.linalg import expm

    blocks, size, inputs = linear.load.shape
    powers = DEGREE + 1
    whole = np.zeros((blocks, size + inputs * powers, size + inputs * powers))
    whole[:, :size, :size] = linear.system * h
    for k in range(inputs):
        at = size + k * powers
        whole[:, :size, at] = linear.load[:, :, k] * h
        whole[:, :size, at + 1] = linear.load_rate[:, :, k]
        for power in range(DEGREE):  # derivatives of the input by t / h
            whole[:, at + power, at + power + 1] = 1.0
    found = expm(whole)
    factorials = np.cumprod([1.0, *range(1, powers)])
    answers = found[:, :size, size:].reshape(blocks, size, inputs, powers) * factorials
    return found[:, :size, :size], answers


def _pushed(response: Array, signals: list[Signal], h: float, first: int, count: int) -> tuple[Array, Array]:
    """Return what inputs add to the states over some steps, (count, b, s), and their values at the ends."""
    blocks, size, inputs, _ = response.shape
    pushed, ends = np.zeros((count, blocks, size)), np.zeros((count, inputs))
    for k, signal in enumerate(signals):
        pushed += np.einsum("cp,bsp->cbs", projected(signal, h, first, count), response[:, :, k])
        ends[:, k] = signal.at(h * (first + 1 + np.arange(count)))
    return pushed, ends


def _read(linear: Linear, state: Array) -> Array:
    return np.asarray(np.einsum("bms,bs->m", linear.angles, state))
