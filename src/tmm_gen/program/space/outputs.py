"""Outputs of an arm in space, read off the state."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Past
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.statements import Assign, Routine, Section, Statement

_KIND = {"angle": "q", "rate": "v", "acceleration": "a"}


def output_routine(layout: SpaceLayout) -> Routine:
    """Build the outputs from the state."""
    by_name = {v.name: v.ref for v in layout.outputs}
    sections = []
    for output in layout.arm.outputs:
        statements: list[Statement] = []
        if output.of in _KIND:
            source = layout.state[Past(_KIND[output.of], 0)].entry(output.joint - 1)  # type: ignore[arg-type]
            statements = [Assign(by_name[output.name], source)]
        sections.append(Section(f"{output.name}: {output.of.replace('_', ' ')}", tuple(statements)))
    return Routine("output", "Read the outputs off the state.", tuple(sections))


assert KINDS
assert sp
