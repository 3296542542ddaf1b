"""Inputs by a name and a few numbers: a step, a ramp, a smooth way, a sine, a chirp."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Signal, Sine, Table
from tmm_gen.inputs.waveforms import Chirp, Smooth, Step


def _ramp(before: float, after: float, duration: float, start: float = 0.0) -> Signal:
    return Table(np.array([start, start + duration]), np.array([before, after]))


def _sine(amplitude: float, frequency: float, phase: float = 0.0) -> Signal:
    return Sine(amplitude, 2.0 * math.pi * frequency, phase)


@dataclass(frozen=True)
class Profile:
    """How a profile is written.

    Parameters
    ----------
    parameters : str
        What stands behind the name; those in brackets may be absent.
    meaning, example : str
        In words; behind ``NAME=``.
    units : tuple of str
        Of each parameter: "" the input's own, "s", "Hz" or "rad".
    make : callable
        From the numbers to the signal.
    """

    parameters: str
    meaning: str
    example: str
    units: tuple[str, ...]
    make: Callable[..., Signal]

    @property
    def fewest(self) -> int:
        """Number of parameters that must be there."""
        return self.parameters.partition("[")[0].count(":")


PROFILES: Mapping[str, Profile] = {
    "step": Profile(":FROM:TO[:AT]", "a jump, at 0 s or AT", "step:0:2:0.1s", ("", "", "s"), Step),
    "ramp": Profile(
        ":FROM:TO:TIME[:START]",
        "straight from value to value in a time",
        "ramp:0:2:0.5s",
        ("", "", "s", "s"),
        _ramp,
    ),
    "smooth": Profile(
        ":FROM:TO:TIME[:START]",
        "the same by a polynomial of degree five, at rest at both ends",
        "smooth:0:1.5:0.8s",
        ("", "", "s", "s"),
        Smooth,
    ),
    "sine": Profile(
        ":AMPLITUDE:FREQUENCY[:PHASE]",
        "a sine, FREQUENCY in Hz, PHASE in rad",
        "sine:0.5:3Hz",
        ("", "Hz", "rad"),
        _sine,
    ),
    "chirp": Profile(
        ":AMPLITUDE:FIRST:LAST:TIME",
        "a sine from one frequency (Hz) to another in a time",
        "chirp:0.5:1Hz:20Hz:5s",
        ("", "Hz", "Hz", "s"),
        Chirp,
    ),
}
"""What ``--input NAME=...`` knows besides numbers and files."""

_FACTORS = {"s": {"": 1.0, "s": 1.0, "ms": 1e-3}, "Hz": {"": 1.0, "Hz": 1.0, "kHz": 1e3}}
_ANGLES = {"": 1.0, "rad": 1.0, "deg": math.pi / 180.0}


def is_profile(text: str) -> bool:
    """Return whether a text is meant as a profile: a known name, or a name with numbers behind colons."""
    name, colon, rest = text.partition(":")
    return name in PROFILES or bool(
        colon and name.isalpha() and len(name) > 1 and rest[:1] in "+-.0123456789"
    )


def profile(text: str, given: str) -> Signal:
    """Return the signal of a profile.

    Parameters
    ----------
    text : str
        Such as ``smooth:0:1.5:0.8s``.
    given : str
        The whole option, for messages.

    Raises
    ------
    UserError
        If there is no such profile, or its numbers do not fit.
    """
    name, *words = text.split(":")
    known = PROFILES.get(name)
    if known is None:
        raise UserError(f"--input {given}: no profile is named '{name}'; there are {', '.join(PROFILES)}.")
    form = f"Write {name}{known.parameters}, for example {known.example}."
    if not known.fewest <= len(words) <= len(known.units):
        raise UserError(f"--input {given}: {name} does not take {len(words)} numbers. {form}")
    numbers = [_number(word, unit, given, form) for word, unit in zip(words, known.units, strict=False)]
    _ordered(known, numbers, f"--input {given}", form)
    return known.make(*numbers)


def made(name: str, numbers: Sequence[float]) -> Signal:
    """Return the signal of a profile by its numbers, all of them.

    Raises
    ------
    UserError
        If a time or a frequency is none that can be.
    """
    known = PROFILES[name]
    _ordered(known, numbers, name, f"Its numbers are {', '.join(_words(known))}.")
    return known.make(*numbers)


def _number(word: str, unit: str, given: str, form: str) -> float:
    """Read a number and its unit."""
    factors = _FACTORS.get(unit, _ANGLES)
    for suffix, factor in sorted(factors.items(), key=lambda item: -len(item[0])):
        if word.endswith(suffix):
            try:
                value = float(word.removesuffix(suffix).strip()) * factor
            except ValueError:
                continue
            if math.isfinite(value):
                return value
    raise UserError(f"--input {given}: '{word}' is not a finite number{_of(factors)}. {form}")


def _of(factors: Mapping[str, float]) -> str:
    return f" ({' or '.join(name for name in factors if name)})" if factors is not _ANGLES else ""


def _ordered(known: Profile, numbers: Sequence[float], given: str, form: str) -> None:
    """Refuse negative times and frequencies, and ways that take no time."""
    for word, unit, number in zip(_words(known), known.units, numbers, strict=False):
        if (unit in ("s", "Hz") and number < 0.0) or (word == "TIME" and number == 0.0):
            least = "positive" if word == "TIME" else "zero or more"
            raise UserError(f"{given}: {word} must be {least}, not {number:g}. {form}")


def _words(known: Profile) -> list[str]:
    """Return what a profile's numbers are called."""
    return known.parameters.replace("[", "").replace("]", "").strip(":").split(":")
