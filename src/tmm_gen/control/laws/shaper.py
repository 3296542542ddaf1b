"""Input shapers: a step becomes a few smaller ones that leave no vibration of one mode behind.

N. C. Singer, W. P. Seering, Preshaping command inputs to reduce system vibration, J. Dyn. Sys. Meas. Control 112
(1990), eqs. 8 and 12.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.problem import ControlProblem

Array = NDArray[np.float64]
Kind = Literal["zv", "zvd"]


def shaper(kind: Kind, frequency: float, damping: float, sample_time: float) -> Array:
    """Return a shaper's impulses, one per sample, sum 1.

    An impulse between two samples is shared by them in proportion to their nearness.

    Parameters
    ----------
    kind : {"zv", "zvd"}
        Zero vibration; or zero vibration and zero derivative by the frequency, more robust and longer.
    frequency : float
        Natural angular frequency of the mode, rad/s.
    damping : float
        Its damping ratio, 0 to 1.
    sample_time : float
        s.
    """
    root = math.sqrt(max(1.0 - damping**2, 1e-6))
    half = math.pi / (frequency * root)
    ratio = math.exp(-damping * math.pi / root)
    weights = np.array([1.0, ratio] if kind == "zv" else [1.0, 2.0 * ratio, ratio**2])
    weights /= weights.sum()
    places = half * np.arange(len(weights)) / sample_time
    found = np.zeros(math.ceil(places[-1]) + 2)
    for weight, place in zip(weights, places, strict=True):
        before = math.floor(place)
        found[before] += weight * (1.0 - (place - before))
        found[before + 1] += weight * (place - before)
    return np.trim_zeros(found, "b")


def slowest_vibration(
    model: LinearModel, problem: ControlProblem, proportional: Array, derivative: Array
) -> tuple[float, float]:
    """Return natural frequency (rad/s) and damping ratio of the vibration that dies out last under PD control.

    What is damped more than 71 % needs no shaping. Where nothing vibrates, a fast mode is made up.

    Parameters
    ----------
    model : LinearModel
        Of the arm.
    problem : ControlProblem
        Sample time.
    proportional, derivative : array, (m,)
        Gains on the hubs' angles and their differences over a sample, N m/rad and N m s/rad.
    """
    size, count, period = model.size, model.count, problem.sample_time
    closed = np.zeros((size + count, size + count))
    closed[:size, :size] = model.transition
    closed[:size, :size] -= (model.drive * (proportional + derivative / period)) @ model.hub
    closed[:size, size:] = derivative / period * model.drive
    closed[size:, :size] = model.hub
    poles = np.linalg.eigvals(closed).astype(complex)
    logarithms = np.log(poles[np.abs(poles) > 1e-6]) / period
    swinging = [pole for pole in logarithms if -pole.real < pole.imag < 0.95 * math.pi / period]
    if not swinging:
        return 2.0 * math.pi / (8.0 * period), 0.0
    slowest = max(swinging, key=lambda pole: pole.real)
    frequency = abs(slowest)
    return frequency, float(np.clip(-slowest.real / frequency, 0.0, 0.99))
