"""What of a sweep depends on parameters and the step alone, over whole loops."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import sympy as sp

from tmm_gen.program.passes.look import assigns_of, inside
from tmm_gen.program.statements import Assign, Require, Section
from tmm_gen.program.variables import SCRATCH, Variable, refs_in, variables_in


def bound_early(sections: list[Section], late_names: Collection[str] = ()) -> set[Variable]:
    """Return the scratch that depends on what is bound early alone, without what is called late."""
    assigns = list(assigns_of(s for section in sections for s in section.statements))
    early = {a.target.variable for a in assigns if a.target.variable.role in SCRATCH}
    early = {v for v in early if v.name not in late_names}
    one_value = _of_one_value(assigns)
    values = [_Value.of(inner) for section in sections for s in section.statements for inner in inside(s)]
    while True:
        late = {
            v.target for v in values if v.target is not None and v.target in early and not v.open <= early
        }
        staying = early - late
        # what a late statement reads must have one value: a recursion's own variable has many
        for value in values:
            if value.target is not None and value.target in staying:
                continue
            if value.asks and value.open <= staying:
                continue
            late |= (value.read & early) - one_value
        if not late:
            return _worth_it(early, assigns)
        early -= late


@dataclass(frozen=True)
class _Value:
    """What a statement computes: looked at in every round, so that it is taken apart once.

    Parameters
    ----------
    target : Variable or None
        What is set.
    asks : bool
        Whether it is a requirement.
    read : frozenset of Variable
        What is read.
    open : frozenset of Variable
        What of that is not bound by its role.
    """

    target: Variable | None
    asks: bool
    read: frozenset[Variable]
    open: frozenset[Variable]

    @classmethod
    def of(cls, statement: Any) -> _Value:
        """Take a statement apart."""
        read = variables_in(statement.value)
        return cls(
            statement.target.variable if isinstance(statement, Assign) else None,
            isinstance(statement, Require),
            read,
            frozenset(v for v in read if not v.role.bound_at_prepare),
        )


def _worth_it(early: set[Variable], assigns: list[Assign]) -> set[Variable]:
    """Return early variables without those that say nothing, unless others of them read these."""
    found = {a.target.variable for a in assigns if a.target.variable in early and not _trivial(a)}
    while True:
        read = early.intersection(
            set[Variable]().union(*(variables_in(a.value) for a in assigns if a.target.variable in found))
        )
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
        or (len({a.target for a in mine}) == 1 and all(variable not in variables_in(a.value) for a in mine))
    }


def _trivial(assign: Assign) -> bool:
    """Whether an assignment takes no arithmetic and says nothing: zeros that walks begin with."""
    return bool(assign.value.is_number)


def is_early(value: sp.Expr, early: set[Variable]) -> bool:
    """Whether an expression reads nothing but what is bound by its role, or early."""
    return all(r.variable.role.bound_at_prepare or r.variable in early for r in refs_in(value))
