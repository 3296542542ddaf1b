"""Binding time over whole loops: what depends on parameters and the step alone leaves the step.

A recursion over stations that nothing changing enters (the impedances of a linear row) moves to prepare with its loop
and its pivots; what later statements read of it is kept in the model, one value a station or one for all.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from tmm_gen.program.passes.bound_early import bound_early
from tmm_gen.program.passes.divide import divided, out_of_loops
from tmm_gen.program.passes.kept import kept_as
from tmm_gen.program.passes.look import assigns_of, read_by
from tmm_gen.program.statements import Loop, Require, Section, Statement
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable


@dataclass
class EarlySets:
    """What has left steps for prepare; sweeps whose early parts are alike share it."""

    _sets: dict[tuple[Statement, ...], dict[Ref, Ref]] = field(default_factory=dict)
    _sections: list[Section] = field(default_factory=list)
    _coefficients: list[Variable] = field(default_factory=list)

    def split(self, sections: list[Section], then: Section | None = None) -> list[Section]:
        """Return the sections of a sweep without what is bound early.

        Parameters
        ----------
        sections : list of Section
            The sweep.
        then : Section, optional
            Follows it and stays as it is: what it reads does not leave the sweep, even where nothing changes it.
        """
        read = {r.variable.name for s in then.statements for r in read_by(s)} if then is not None else set()
        early = bound_early(sections, read)
        taken, left = divided(sections, early)
        if not any(taken):
            return sections
        statements = tuple(out_of_loops([s for group in taken for s in group]))
        if statements not in self._sets:
            self._sets[statements] = self._keep(statements, left)
        kept = self._sets[statements]
        return [kept_as(section, kept) for section in left]

    @property
    def sections(self) -> tuple[Section, ...]:
        """Statements of prepare."""
        return tuple(self._sections)

    @property
    def coefficients(self) -> tuple[Variable, ...]:
        """What is kept in the model."""
        return tuple(self._coefficients)

    def _keep(self, statements: tuple[Statement, ...], left: list[Section]) -> dict[Ref, Ref]:
        # by name: what turned out alike at every station is a scalar now, and an array where it is read
        crossing = {
            ref.variable.name
            for section in left
            for s in section.statements
            for ref in read_by(s)
            if ref.variable.role in SCRATCH
        }
        lengths: dict[Ref, int | None] = {}
        for statement in statements:
            for assign in assigns_of((statement,)):
                variable = assign.target.variable
                if variable.name not in crossing:
                    continue
                length = variable.length
                if length is None and isinstance(statement, Loop):  # runs of unlike stations share an array
                    length = max(statement.stop, lengths.get(assign.target) or 0)
                lengths[assign.target] = length
        kept = {
            target: self._variable(target.variable, length).at(target.offset or 0)
            for target, length in lengths.items()
        }
        self._coefficients += dict.fromkeys(ref.variable for ref in kept.values())
        self._sections.append(
            kept_as(Section("factors of the sweep that do not change from step to step", statements), kept)
        )
        return kept

    def _variable(self, variable: Variable, length: int | None) -> Variable:
        names = {v.name for v in self._coefficients}
        name, number = variable.name, 2
        while name in names:
            name, number = f"{variable.name}_{number}", number + 1
        return replace(variable, name=name, role=Role.COEFFICIENT, length=length)


def lifted(sections: list[Section], *, ask: bool) -> list[Section]:
    """Return sections in which what is alike at every station, and bound early, is computed once, before loops.

    For routines that keep nothing: where it takes a loop of its own, it stays where it is.

    Parameters
    ----------
    ask : bool
        Whether pivots of parameters alone are asked for; otherwise what is wrong with them shows in the state.
    """
    early = bound_early(sections)
    taken, left = divided(sections, early)
    statements = out_of_loops([s for group in taken for s in group])
    if not statements or any(isinstance(s, Loop) for s in statements):
        return sections
    statements = [s for s in statements if ask or not isinstance(s, Require)]
    targets = {a.target.variable.name: a.target for a in assigns_of(statements)}
    names = {
        r: targets[r.variable.name]
        for s in left
        for x in s.statements
        for r in read_by(x)
        if r.variable in early
    }
    return [
        Section("what is the same at every station", tuple(statements)),
        *(kept_as(s, names) for s in left),
    ]
