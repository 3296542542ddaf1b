"""Inputs by a few numbers: a step, a ramp, a smooth way, a sine, a chirp."""

from __future__ import annotations

from tmm_gen.api.given import number
from tmm_gen.api.guard import guarded
from tmm_gen.inputs.profiles import made
from tmm_gen.inputs.signals import Signal

__all__ = ["chirp", "ramp", "sine", "smooth", "step"]


def _profile(name: str, **numbers: float) -> Signal:
    return made(name, [number(key, value) for key, value in numbers.items()])


@guarded
def step(before: float, after: float, at: float = 0.0) -> Signal:
    """Return a jump from one value to another at an instant, s."""
    return _profile("step", before=before, after=after, at=at)


@guarded
def ramp(before: float, after: float, time: float, start: float = 0.0) -> Signal:
    """Return a straight way from one value to another in a time, s, that begins at `start`, s."""
    return _profile("ramp", before=before, after=after, time=time, start=start)


@guarded
def smooth(before: float, after: float, time: float, start: float = 0.0) -> Signal:
    """Return a way of degree five from one value to another in a time, s: at rest at both ends."""
    return _profile("smooth", before=before, after=after, time=time, start=start)


@guarded
def sine(amplitude: float, frequency: float, phase: float = 0.0) -> Signal:
    """Return a sine of a frequency in Hz and a phase in rad."""
    return _profile("sine", amplitude=amplitude, frequency=frequency, phase=phase)


@guarded
def chirp(amplitude: float, first: float, last: float, time: float) -> Signal:
    """Return a sine whose frequency goes from the first to the last, Hz, in a time, s."""
    return _profile("chirp", amplitude=amplitude, first=first, last=last, time=time)
