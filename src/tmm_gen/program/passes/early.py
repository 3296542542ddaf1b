"""Binding time over whole loops: what depends on parameters and the step alone leaves the step.

A recursion over stations that nothing changing enters (the impedances of a linear row) moves to prepare with its loop
and its pivots; what later statements read of it is kept in the model, one value a station or one for all.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Repeat, Require, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in

SCRATCH = (Role.LOCAL, Role.WORK)


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
        read = {r.variable.name for s in then.statements for r in _read(s)} if then is not None else set()
        early = _early(sections, read)
        taken, left = _divided(sections, early)
        if not any(taken):
            return sections
        statements = tuple(_lifted([s for group in taken for s in group]))
        if statements not in self._sets:
            self._sets[statements] = self._keep(statements, left)
        kept = self._sets[statements]
        return [_renamed(section, kept) for section in left]

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
            for ref in _read(s)
            if ref.variable.role in SCRATCH
        }
        lengths: dict[Ref, int | None] = {}
        for statement in statements:
            for assign in _assigns((statement,)):
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
            _renamed(Section("factors of the sweep that do not change from step to step", statements), kept)
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
    early = _early(sections)
    taken, left = _divided(sections, early)
    statements = _lifted([s for group in taken for s in group])
    if not statements or any(isinstance(s, Loop) for s in statements):
        return sections
    statements = [s for s in statements if ask or not isinstance(s, Require)]
    targets = {a.target.variable.name: a.target for a in _assigns(statements)}
    names = {
        r: targets[r.variable.name]
        for s in left
        for x in s.statements
        for r in _read(x)
        if r.variable in early
    }
    return [
        Section("what is the same at every station", tuple(statements)),
        *(_renamed(s, names) for s in left),
    ]


def _early(sections: list[Section], late_names: Collection[str] = ()) -> set[Variable]:
    """Return the scratch that depends on what is bound early alone, without what is called late."""
    statements = [s for section in sections for s in section.statements]
    assigns = list(_assigns(statements))
    early = {a.target.variable for a in assigns if a.target.variable.role in SCRATCH}
    early = {v for v in early if v.name not in late_names}
    one_value = _of_one_value(assigns)
    while True:
        late = {
            a.target.variable
            for a in assigns
            if a.target.variable in early
            and any(
                not r.variable.role.bound_at_prepare and r.variable not in early for r in refs_in(a.value)
            )
        }
        staying = early - late
        # what a late statement reads must have one value: a recursion's own variable has many
        for section in sections:
            for statement in section.statements:
                inside = statement.body if isinstance(statement, Loop) else (statement,)
                for inner in inside:
                    if isinstance(inner, Assign) and inner.target.variable in staying:
                        continue
                    if isinstance(inner, Require) and _is_early(inner.value, staying):
                        continue
                    for ref in refs_in(inner.value):
                        if ref.variable in early and ref.variable not in one_value:
                            late.add(ref.variable)
        if not late:
            return _worth_it(early, assigns)
        early -= late


def _worth_it(early: set[Variable], assigns: list[Assign]) -> set[Variable]:
    """Return early variables without those that say nothing, unless others of them read these."""
    found = {a.target.variable for a in assigns if a.target.variable in early and not _trivial(a)}
    while True:
        read = {
            ref.variable
            for a in assigns
            if a.target.variable in found
            for ref in refs_in(a.value)
            if ref.variable in early
        }
        if read <= found:
            return found
        found |= read


def _of_one_value(assigns: list[Assign]) -> set[Variable]:
    """Return the variables that are set once, or alike in every run of stations and never from themselves."""
    settings: dict[Variable, list[Assign]] = {}
    for assign in assigns:
        settings.setdefault(assign.target.variable, []).append(assign)
    return {
        variable
        for variable, mine in settings.items()
        if len(mine) == 1
        or (
            len({a.target for a in mine}) == 1
            and all(variable not in {r.variable for r in refs_in(a.value)} for a in mine)
        )
    }


def _trivial(assign: Assign) -> bool:
    """Whether an assignment takes no arithmetic and says nothing: zeros that walks begin with."""
    return bool(assign.value.is_number)


def _is_early(value: sp.Expr, early: set[Variable]) -> bool:
    return all(r.variable.role.bound_at_prepare or r.variable in early for r in refs_in(value))


def _divided(sections: list[Section], early: set[Variable]) -> tuple[list[list[Statement]], list[Section]]:
    taken: list[list[Statement]] = []
    left: list[Section] = []
    for section in sections:
        mine: list[Statement] = []
        kept: list[Statement] = []
        for statement in section.statements:
            inside = statement.body if isinstance(statement, Loop) else (statement,)
            soon = tuple(
                s
                for s in inside
                if (isinstance(s, Assign) and s.target.variable in early)
                or (isinstance(s, Require) and refs_in(s.value) and _is_early(s.value, early))
            )
            late = tuple(s for s in inside if s not in soon)
            for part, into in ((soon, mine), (late, kept)):
                if part and isinstance(statement, Loop):
                    into.append(replace(statement, body=part))  # type: ignore[arg-type]
                else:
                    into += part
        taken.append(mine)
        if kept:
            left.append(replace(section, statements=tuple(kept)))
    return taken, left


def _lifted(statements: list[Statement]) -> list[Statement]:
    """Take out of loops what is the same at every station."""
    assigns = list(_assigns(statements))
    once = {
        v for v in (a.target.variable for a in assigns) if sum(a.target.variable == v for a in assigns) == 1
    }
    alike: dict[Ref, Ref] = {}
    found: list[Statement] = []
    for statement in statements:
        if not isinstance(statement, Loop):
            found.append(statement)
            continue
        body: list[Assign | Require] = []
        for inner in statement.body:
            value = inner.value.xreplace(alike)
            uniform = not isinstance(inner, Assign) or inner.target.variable in once
            uniform = uniform and all(
                r.variable.length is None
                and (
                    r.variable.role.bound_at_prepare
                    or r in alike.values()
                    or _set_outside(r, statements, once)
                )
                for r in refs_in(value)
            )
            if uniform and isinstance(inner, Require):
                found.append(Require(value))
                continue
            if uniform:
                assert isinstance(inner, Assign)
                scalar = replace(inner.target.variable, role=Role.LOCAL, length=None).ref
                if scalar != inner.target:
                    alike[inner.target] = scalar
                else:
                    alike[scalar] = scalar
                found.append(Assign(scalar, value))
            else:
                body.append(replace(inner, value=value))
        if body:
            found.append(replace(statement, body=tuple(body)))
    return found


def _set_outside(ref: Ref, statements: list[Statement], once: set[Variable]) -> bool:
    return ref.variable in once and any(isinstance(s, Assign) and s.target == ref for s in statements)


def _assigns(statements: Iterable[Statement]) -> Iterable[Assign]:
    for statement in statements:
        for inner in statement.body if isinstance(statement, Loop) else (statement,):
            if isinstance(inner, Assign):
                yield inner


def _read(statement: Statement) -> set[Ref]:
    inside = statement.body if isinstance(statement, Loop) else (statement,)
    return {ref for inner in inside for ref in refs_in(inner.value)}


def _renamed(section: Section, names: dict[Ref, Ref]) -> Section:
    every = dict(names)

    def value(e: sp.Expr) -> sp.Expr:
        found = {r: _moved(r, every) for r in refs_in(e)}
        return e.xreplace({r: f for r, f in found.items() if f is not None})

    def changed(s: Any) -> Any:
        if not isinstance(s, Assign):
            return s if isinstance(s, Repeat) else replace(s, value=value(s.value))
        moved = _moved(s.target, every)
        return Assign(moved if moved is not None else s.target, value(s.value))

    return replace(
        section,
        statements=tuple(
            replace(s, body=tuple(changed(x) for x in s.body)) if isinstance(s, Loop) else changed(s)
            for s in section.statements
        ),
    )


def _moved(ref: Ref, names: dict[Ref, Ref]) -> Ref | None:
    """Return where a value is kept: arrays that turned out alike at every station became scalars."""
    if ref in names:
        return names[ref]
    for other, kept in names.items():  # the same array, looked at from another station
        if (
            other.variable == ref.variable
            and ref.variable.length is not None
            and kept.variable.length is not None
        ):
            return (
                kept.variable.at(ref.offset)
                if ref.offset is not None
                else kept.variable.entry(ref.entry or 0)
            )
    scalar = (
        replace(ref.variable, role=Role.LOCAL, length=None).ref if ref.variable.role is Role.WORK else None
    )
    return names.get(scalar) if scalar is not None else None
