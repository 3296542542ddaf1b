"""What joints, gears and motors do beyond springs and viscous dampers: that it is not modelled, and what to do."""

from __future__ import annotations

_SPRINGS = "is not modelled: springs and dampers are linear"
_PLAY = (
    "is not modelled: teeth are always in mesh",
    "Remove it; write the `stiffness` that teeth have under load, and again one softened by the play, and compare.",
)
_FRICTION = (
    "is not modelled: damping is viscous",
    "Remove it; write `damping` that turns as much to heat at the rate that matters (torque over rate), or let an "
    "[[input]] with the torque act.",
)
_STIFFENING = (
    _SPRINGS,
    "Remove it; write the `stiffness` at the torque that acts, the slope of torque by angle, and try others as well.",
)

_WORDS = {
    "backlash": _PLAY,
    "play": _PLAY,
    "dead": _PLAY,
    "clearance": _PLAY,
    "friction": _FRICTION,
    "coulomb": _FRICTION,
    "stiction": _FRICTION,
    "stribeck": _FRICTION,
    "breakaway": _FRICTION,
    "cubic": _STIFFENING,
    "quadratic": _STIFFENING,
    "hardening": _STIFFENING,
    "softening": _STIFFENING,
    "nonlinear": _STIFFENING,
    "hysteresis": _STIFFENING,
}


def nonlinear(key: str) -> tuple[str, str] | None:
    """Return what to say of a key that asks for a nonlinear joint, gear or motor, and what to do; else None."""
    words = key.lower().replace("-", "_")
    return next((told for word, told in _WORDS.items() if word in words), None)
