"""Input shapers leave no vibration of the mode they are made for."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.control.laws.shaper import shaper, slowest_vibration

TIME = 1e-3


def residual(impulses: np.ndarray, frequency: float, damping: float) -> float:
    """Amplitude an oscillator keeps after a step shaped by impulses, relative to that after a plain step."""
    pole = complex(-damping * frequency, frequency * math.sqrt(1.0 - damping**2))
    times = TIME * np.arange(len(impulses))
    return abs(np.sum(impulses * np.exp(-pole * times))) / abs(np.exp(-pole * times[-1]))


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.3])
def test_the_mode_is_left_at_rest(damping: float) -> None:
    for kind in ("zv", "zvd"):
        impulses = shaper(kind, 30.0, damping, TIME)
        assert impulses.sum() == pytest.approx(1.0)
        assert np.all(impulses >= 0.0)
        assert residual(impulses, 30.0, damping) < 1e-3


def test_the_longer_shaper_forgives_more() -> None:
    off = {kind: residual(shaper(kind, 30.0, 0.02, TIME), 33.0, 0.02) for kind in ("zv", "zvd")}
    assert off["zvd"] < 0.2 * off["zv"]


def test_the_closed_loops_slowest_vibration_is_found(bench: Bench) -> None:
    """With a stiff hub the arm swings as a clamped one does, a little slower: 1.8 to 2.2 Hz with this payload."""
    frequency, damping = slowest_vibration(bench.modes, bench.problem, np.array([60.0]), np.array([1.0]))
    assert 1.5 < frequency / (2.0 * math.pi) < 6.0
    assert 0.0 <= damping < 0.7
