"""Motion of stations before, at and after a stage: predictions, stage values, update and ageing of the history."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past, Scheme, past, stage
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.statements import Assign
from tmm_gen.program.variables import Ref, Role, Variable, local, refs_in

Read = Callable[[Variable], Ref]
"""How a variable is referred to: an element of the loop, or a scalar."""


def history_values(state: Mapping[Past, Variable], read: Read) -> dict[sp.Symbol, sp.Expr]:
    """Map an integrator's history symbols to state variables."""
    return {past(p.kind, p.lag): read(variable) for p, variable in state.items()}


def kept_stage_values(
    scheme: Scheme, offsets: Mapping[tuple[int, Kind], sp.Expr]
) -> frozenset[tuple[Kind, int]]:
    """Return the stage values that later stages or the update read after their own stage is solved."""
    last = len(scheme.stages)
    names = {stage(kind, i).name: (kind, i) for kind in KINDS for i in range(1, last)}
    used: set[tuple[Kind, int]] = set()
    for expression in (*offsets.values(), *scheme.update.values()):
        used |= {names[s.name] for s in expression.free_symbols if s.name in names}
    return frozenset(used)


def stage_variable(kind: Kind, index: int, prefix: str, length: int | None) -> Variable:
    """Return the scratch variable that keeps a stage value."""
    name, unit = MOTION_NAMES[kind]
    role = Role.LOCAL if length is None else Role.WORK
    return Variable(f"{prefix}stage{index}_{name}", role, length, f"{name} at stage {index}", unit)


def update_assignments(
    state: Mapping[Past, Variable], new: Mapping[Kind, sp.Expr], read: Read, prefix: str
) -> list[Assign]:
    """Age the history and store the new values, in an order in which nothing is overwritten before it is read."""
    pending: list[Assign] = []
    for p, variable in state.items():
        value = read(state[Past(p.kind, p.lag - 1)]) if p.lag else new[p.kind]
        pending.append(Assign(read(variable), value))
    return in_order(pending, f"new_{prefix}")


def in_order(pending: list[Assign], prefix: str = "new_") -> list[Assign]:
    """Order assignments that take effect at once so that nothing is overwritten before it is read."""
    pending = list(pending)
    ordered: list[Assign] = []
    while pending:
        for index, candidate in enumerate(pending):
            others = pending[:index] + pending[index + 1 :]
            if all(candidate.target not in refs_in(other.value) for other in others):
                ordered.append(pending.pop(index))
                break
        else:  # a cycle: compute the first new value aside
            first = pending[0]
            aside = local(f"{prefix}{first.target.variable.name}", unit=first.target.variable.unit)
            ordered.append(Assign(aside, first.value))
            pending[0] = Assign(first.target, aside)
            pending.append(pending.pop(0))
    return ordered
