"""Units in the exponents of base units that FMI asks for."""

from __future__ import annotations

from collections import Counter

_BASE: dict[str, dict[str, int]] = {
    "kg": {"kg": 1},
    "m": {"m": 1},
    "s": {"s": 1},
    "rad": {"rad": 1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
}
ORDER = ("kg", "m", "s", "rad")
"""In which FMI lists them."""


def base_exponents(unit: str) -> dict[str, int]:
    """Return the exponents of the base units in a unit.

    Parameters
    ----------
    unit : str
        As programs write it: factors apart by blanks, the ones behind a slash divide, ``^`` raises:
        ``"N m s/rad"``, ``"kg m^2"``, ``"s^-2"``.

    Returns
    -------
    dict from str to int
        Without zeros, in the order of :data:`ORDER`.

    Raises
    ------
    ValueError
        If a factor is not known.
    """
    total: Counter[str] = Counter()
    for part, group in enumerate(unit.split("/")):
        sign = -1 if part else 1
        for factor in group.split():
            name, _, power = factor.partition("^")
            if name == "1":
                continue
            if name not in _BASE:
                raise ValueError(f"unit {unit!r}: {name!r} is not known")
            for base, exponent in _BASE[name].items():
                total[base] += sign * int(power or 1) * exponent
    return {base: total[base] for base in ORDER if total[base]}
