"""Sweeps until one changes next to nothing: what a step that takes so many counts, and is told."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from tmm_gen.program.statements import Assign, Routine, Section
from tmm_gen.program.variables import Role, Variable

LEAST_TURN = Variable(
    "least_turn",
    Role.PARAMETER,
    doc="a sweep that turns the links by less in all, squares summed, is the last of a stage",
    unit="rad",
    default=1e-4,
)
"""May be made smaller where the equations are to be solved better than steps usually need."""

SWEEPS = Variable("sweeps", Role.STATE, doc="sweeps taken so far")
"""Counted by the step."""


def none_taken(initialise: Routine) -> Routine:
    """Return a start that has taken no sweep."""
    none = Section("no sweep has been taken yet", (Assign(SWEEPS.ref, sp.Integer(0)),))
    return replace(initialise, sections=(*initialise.sections, none))
