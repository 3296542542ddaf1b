"""Units of quotients, so that a factor says what it is in."""

from __future__ import annotations

import re


def quotient(above: str, below: str) -> str:
    """Return the unit of a quotient; "1" where nothing is left.

    Parameters
    ----------
    above, below : str
        Such as "N m", "rad/s^2", "1".
    """
    powers = _powers(above)
    for unit, power in _powers(below).items():
        powers[unit] = powers.get(unit, 0) - power
    over = [_written(unit, power) for unit, power in powers.items() if power > 0]
    under = [_written(unit, -power) for unit, power in powers.items() if power < 0]
    text = " ".join(over) or "1"
    if not under:
        return text
    return text + "/" + (under[0] if len(under) == 1 else f"({' '.join(under)})")


def _powers(unit: str) -> dict[str, int]:
    found: dict[str, int] = {}
    sign = 1
    for token in re.findall(r"[A-Za-z]+(?:\^-?\d+)?|/", unit):
        if token == "/":
            sign = -1
            continue
        name, _, power = token.partition("^")
        found[name] = found.get(name, 0) + sign * int(power or 1)
    return found


def _written(unit: str, power: int) -> str:
    return unit if power == 1 else f"{unit}^{power}"
