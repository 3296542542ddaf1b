"""Names of factors that prepare computes: after what they are, or after what they turn into what."""

from __future__ import annotations

import sympy as sp

from tmm_gen.program.variables import Ref, Role
from tmm_gen.units import quotient

_COUNTS = {
    **{1: "one", 2: "two", 3: "three", 4: "four", 5: "five", 6: "six", 7: "seven", 8: "eight", 9: "nine"},
    **{10: "ten", 11: "eleven", 12: "twelve"},
}
_PARTS = {
    **{2: "half", 3: "third", 4: "quarter", 5: "fifth", 6: "sixth", 7: "seventh", 8: "eighth"},
    **{9: "ninth", 10: "tenth", 12: "twelfth", 16: "sixteenth", 24: "twenty_fourth"},
}
_POWERS = {1: "", 2: "_squared", 3: "_cubed"}


def name_of(factor: sp.Expr, target: Ref | None, of: sp.Expr | None) -> tuple[str, str, str]:
    """Return name, description and unit of a factor.

    Parameters
    ----------
    target : Ref, optional
        What it contributes to.
    of : sympy.Expr, optional
        What it multiplies there.
    """
    return _power_of_step(factor) or _by_use(factor, target, of)


def _power_of_step(factor: sp.Expr) -> tuple[str, str, str] | None:
    number, rest = factor.as_coeff_Mul()
    base, power = rest.as_base_exp()
    if not (isinstance(base, Ref) and base.variable.role is Role.STEP and power.is_Integer):
        return None
    power = int(power)
    if not number.is_Rational or abs(power) not in _POWERS:
        return None
    counts, parts = _COUNTS.get(int(number.p)), _PARTS.get(int(number.q))
    if counts is None or (parts is None and number.q != 1):
        return None
    unit = (
        "s"
        if power == 1
        else f"s^{power}"
        if power > 0
        else quotient("1", "s" if power == -1 else f"s^{-power}")
    )
    step = f"step{_POWERS[abs(power)]}" if abs(power) > 1 else "timestep"  # NAME_step belongs to scenes
    plural = {"half": "halves"}.get(parts or "", f"{parts}s")
    share = counts if number.q == 1 else parts if number.p == 1 else f"{counts}_{plural}"
    if power < 0:
        return f"{share}_over_{step}", str(factor), unit
    return (
        "step" if number == 1 and power == 1 else step if number == 1 else f"{share}_{step}",
        str(factor),
        unit,
    )


def _by_use(factor: sp.Expr, target: Ref | None, of: sp.Expr | None) -> tuple[str, str, str]:
    if target is None:
        return "factor", str(factor), "1"
    name = target.variable.name.removeprefix("hub_")  # stations share the hub's factors
    if isinstance(of, Ref):
        unit = quotient(target.variable.unit, of.variable.unit)
        return f"{name}_per_{of.variable.name.removeprefix('hub_')}", str(factor), unit
    return f"{name}_factor", str(factor), "1" if of is None else target.variable.unit
