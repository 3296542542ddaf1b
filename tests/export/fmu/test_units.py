"""Units in base units."""

from __future__ import annotations

import pytest

from tmm_gen.export.fmu.units import base_exponents


@pytest.mark.parametrize(
    ("unit", "exponents"),
    [
        ("1", {}),
        ("rad", {"rad": 1}),
        ("N m s/rad", {"kg": 1, "m": 2, "s": -1, "rad": -1}),
        ("kg m^2", {"kg": 1, "m": 2}),
        ("m/s^2", {"m": 1, "s": -2}),
        ("s^-2", {"s": -2}),
        ("J", {"kg": 1, "m": 2, "s": -2}),
    ],
)
def test_exponents(unit: str, exponents: dict[str, int]) -> None:
    assert base_exponents(unit) == exponents


def test_what_is_no_unit_is_refused() -> None:
    with pytest.raises(ValueError, match="furlong"):
        base_exponents("N furlong")
