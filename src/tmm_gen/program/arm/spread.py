"""What one loop over stations sets and another reads becomes an array; all else stays a scalar."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.program.arm.binding import Scratch
from tmm_gen.program.passes.rewrite import map_references
from tmm_gen.program.statements import Assign, Loop, Section
from tmm_gen.program.variables import Role, Variable, refs_in


def spread(sections: list[Section], scratch: Scratch, n: int) -> list[Section]:
    """Keep in arrays what one loop sets at each station and another reads."""
    names: set[Variable] = set()
    for section in sections:
        for statement in section.statements:
            written: set[Variable] = set()
            for inner in statement.body if isinstance(statement, Loop) else (statement,):
                for ref in refs_in(inner.value):
                    kept = ref.variable.name in scratch.lets and ref.variable.role is Role.LOCAL
                    if kept and ref.variable not in written:
                        names.add(ref.variable)
                if isinstance(inner, Assign):
                    written.add(inner.target.variable)
    set_in_loops = {
        inner.target.variable
        for section in sections
        for statement in section.statements
        if isinstance(statement, Loop)
        for inner in statement.body
        if isinstance(inner, Assign)
    }
    arrays = {v.ref: replace(v, role=Role.WORK, length=n).at() for v in names & set_in_loops}

    return [map_references(section, lambda ref: arrays.get(ref, ref)) for section in sections]
