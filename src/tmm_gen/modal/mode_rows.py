"""What is known of each mode, as rows of a table: the same of all kinds of arms, and more of those in space."""

from __future__ import annotations

import numpy as np

from tmm_gen.modal.modes import Mode
from tmm_gen.modal.space.shares import shares
from tmm_gen.modal.space.situation import RestingArm

_TOLD = 3
"""Parts that a table names for a mode, as far as they have a share worth naming."""
_LEAST = 0.1


def mode_row(number: int, mode: Mode) -> dict[str, object]:
    """Return what is known of a mode, counted from 0."""
    return {
        "mode": number + 1,
        "frequency_hz": mode.hertz,
        "angular_frequency": mode.frequency,
        "damping_ratio": mode.damping_ratio,
        "poles": [{"real": pole.real, "imaginary": pole.imag} for pole in mode.poles],
        "motion": mode.motion,
        "shape": mode.shape,
        "error_bound": mode.bound,
    }


def space_mode_row(resting: RestingArm, number: int, mode: Mode) -> dict[str, object]:
    """Return what is known of a mode of an arm in space, counted from 0."""
    parts = shares(resting.still, mode.shape)
    told = [each for each in parts[:_TOLD] if each.share >= _LEAST]
    frames = []
    for frame in resting.arm.frames:
        moved, turned = resting.still.moved(frame)
        frames.append({"name": frame.name, "moved": moved @ mode.shape, "turned": turned @ mode.shape})
    return {
        **mode_row(number, mode),
        "shape": mode.shape[6:],
        "motion": "moves along freely"
        if np.any(mode.shape[:3]) and not np.any(mode.shape[3:])
        else mode.motion,
        "base_shape": mode.shape[:6] if resting.still.numbers.floats else None,
        "mostly": ", ".join(f"{each.what} {100.0 * each.share:.0f} %" for each in told),
        "shares": [{"what": each.what, "share": each.share} for each in parts],
        "frames": frames,
    }
