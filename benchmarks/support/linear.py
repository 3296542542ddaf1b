"""Amplification of the integrators with the parameters they have unless told, each derived once and when asked for."""

from __future__ import annotations

from functools import cache

from tmm_gen.derive.integrators.amplification import Amplification, amplification
from tmm_gen.derive.integrators.registry import integrator


@cache
def linear_of(name: str) -> Amplification:
    """Return what one step of an integrator makes of a linear oscillator."""
    return amplification(integrator(name).main)
