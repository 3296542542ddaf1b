"""Outputs of kernels whose numbers are sums of two: summed up as such, and rounded once when they are handed over."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.program.passes.rewrite import map_references
from tmm_gen.program.statements import Assign, Routine, Section
from tmm_gen.program.variables import Role, local


def rounded_last(routine: Routine) -> Routine:
    """Return a routine that reads none of its outputs: what it adds up there, it adds up in a scalar of its own."""
    held = {
        v.ref: local(f"sum_{v.name}", v.doc, v.unit)
        for v in sorted(routine.read(), key=lambda v: v.name)
        if v.role is Role.OUTPUT
    }
    if not held:
        return routine

    sections = tuple(map_references(s, lambda ref: held.get(ref, ref)) for s in routine.sections)
    end = Section("rounded", tuple(Assign(output, total) for output, total in held.items()))
    return replace(routine, sections=(*sections, end))
