"""Bounds as users write them: errors relative or with a unit, times with a unit."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from tmm_gen.errors import UserError

_LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9}
_ANGLES = {"rad": 1.0, "mrad": 1e-3, "urad": 1e-6, "µrad": 1e-6, "deg": math.pi / 180.0}
_RELATIVE = {"": 1.0, "%": 1e-2, "ppm": 1e-6}
_TIMES = {"": 1.0, "s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9}

_GREEK_MU = "\N{GREEK SMALL LETTER MU}"
"""What some keyboards write for the micro sign."""

_NUMBER = re.compile(r"\s*(?P<number>[-+0-9.eE]+)\s*(?P<unit>[^\s0-9]*)\s*")


@dataclass(frozen=True)
class ErrorBound:
    """How large an error may be.

    Parameters
    ----------
    value : float
        Positive.
    unit : str
        SI unit of the value; empty where it is relative to the travel of the output.
    """

    value: float
    unit: str

    def relative(self, travel: float, unit: str) -> float:
        """Return the bound relative to the travel of an output with some unit.

        Raises
        ------
        UserError
            If the bound has another unit.
        """
        if not self.unit:
            return self.value
        if self.unit != unit:
            raise UserError(
                f"--max-error is in {self.unit}, but the output is in {unit}. Give it in {unit}, or relative to the "
                "travel of the output, such as 1e-3 or 0.1%."
            )
        return self.value / travel


def read_error(text: str) -> ErrorBound:
    """Read ``1e-3``, ``0.1%`` (relative to the travel), ``0.5mm`` or ``2mrad``.

    Raises
    ------
    UserError
        If it is none of these, or not positive.
    """
    number, unit = _split("--max-error", text, "1e-3, 0.1%, 0.5mm or 2mrad")
    for units, base in ((_RELATIVE, ""), (_LENGTHS, "m"), (_ANGLES, "rad")):
        if unit in units:
            return ErrorBound(number * units[unit], base)
    if unit in ("m/s", "rad/s", "m/s^2", "rad/s^2", "N", "N*m", "Nm", "J"):
        return ErrorBound(number, {"N*m": "N m", "Nm": "N m"}.get(unit, unit))
    known = ", ".join(filter(None, _spellings({**_RELATIVE, **_LENGTHS, **_ANGLES})))
    raise UserError(f"--max-error {text}: unknown unit '{unit}'. Use none (relative to the travel), {known}.")


def read_time(text: str) -> float:
    """Read seconds of computing for a simulated second: ``1e-3``, ``200µs``.

    Raises
    ------
    UserError
        If it is no positive time.
    """
    number, unit = _split("--max-time", text, "1e-3 or 200µs")
    if unit not in _TIMES:
        raise UserError(
            f"--max-time {text}: unknown unit '{unit}'. Use {', '.join(filter(None, _spellings(_TIMES)))}."
        )
    return number * _TIMES[unit]


def _spellings(units: Mapping[str, float]) -> list[str]:
    """Return the units, of two spellings of micro the proper one."""
    return [name for name in units if f"µ{name[1:]}" not in units or not name.startswith("u")]


def _split(option: str, text: str, examples: str) -> tuple[float, str]:
    match = _NUMBER.fullmatch(text)
    try:
        number = float(match["number"]) if match else math.nan
    except ValueError:
        number = math.nan
    if match is None or not 0.0 < number < math.inf:
        raise UserError(f"{option} {text}: is no positive number. Write for example {examples}.")
    return number, match["unit"].replace(_GREEK_MU, "µ")
