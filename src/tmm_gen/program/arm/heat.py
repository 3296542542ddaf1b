"""Energy that a step turns to heat, by the power and its slope before and after it."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP
from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.reading import (
    POWER_AFTER,
    POWER_BEFORE,
    SLOPE_AFTER,
    SLOPE_BEFORE,
    energy_of_step,
)
from tmm_gen.program.arm.at_state import AtState
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.statements import Assign, Section, Statement
from tmm_gen.program.variables import local


def heat_before(layout: Layout) -> tuple[Section, ...]:
    """Return the share of the step's heat that the motion before the step contributes."""
    return _heat(layout, POWER_BEFORE, SLOPE_BEFORE, "before")


def heat_after(layout: Layout) -> tuple[Section, ...]:
    """Return the share of the step's heat that the motion after the step contributes."""
    return _heat(layout, POWER_AFTER, SLOPE_AFTER, "after")


def _heat(layout: Layout, power: sp.Symbol, slope: sp.Symbol, when: str) -> tuple[Section, ...]:
    if layout.dissipated is None:
        return ()
    rule = energy_of_step().subs(STEP, layout.step.ref)
    share = partial(rule, power) * power + partial(rule, slope) * slope
    named = {
        power: local("heating", "power turned to heat", "W"),
        slope: local("heating_slope", unit="W/s"),
    }
    at_state = AtState(layout)
    statements: list[Statement] = []
    for symbol, energy in ((power, "heat"), (slope, "slope")):
        statements += at_state.summed(energy, named[symbol])
    heat = layout.dissipated.ref
    statements.append(Assign(heat, heat + share.subs(named)))
    return (Section(f"energy turned to heat: share of the motion {when} the step", tuple(statements)),)
