"""The tangent of any step: each of its assignments is differentiated as it stands, and keeps what its slopes are.

A step with corrections takes forces across stations with factors that an earlier sweep has left, at a motion that has
moved on since: what it finds is the solution of no linear equation, and its derivative needs that of every factor.
This pass asks nothing of a step but that it is straight on, loops over stations included. What a slope is does not
depend on the direction: it is computed once, beside the step, and read for each direction. What follows one other
thing alone, as sine and cosine follow an angle, has no change of its own: slopes are by the angle then.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.sensitivities.reduced import reduced
from tmm_gen.program.sensitivities.slopes import Slopes
from tmm_gen.program.sensitivities.twins import LINEARISE_DOC, TANGENT_DOC, change_of, changes_of
from tmm_gen.program.statements import Assign, Loop, Program, Require, Routine, Section, Sensitivities
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable, refs_in

_MOVED = frozenset({Role.STATE, Role.INPUT})


def differentiated(program: Program, hoister: Hoister) -> Sensitivities:
    """Return the sensitivities of a program's step.

    Parameters
    ----------
    program : Program
        Whose main step goes straight on: nothing in it is repeated until it suits.
    hoister : Hoister
        Of the program: what is bound early moves to prepare.
    """
    found = _Differentiation(program)
    linearise, tangent = found.routines()
    state = changes_of(program.state)
    tangent = prune(hoister.hoist(tangent), frozenset(state))
    needed = _points(tangent)
    linearise = prune(hoister.hoist(linearise), frozenset(program.state) | needed)
    needed |= _points(linearise)  # slopes by what something follows have its own slope in them
    whole = Sensitivities(
        point=tuple(v for v in found.slopes.kept if v in needed),
        state=state,
        inputs=changes_of(program.inputs),
        linearise=linearise,
        tangent=tangent,
    )
    return replace(whole, reduced=reduced(whole, program.stations))


def _points(routine: Routine) -> frozenset[Variable]:
    return frozenset(v for v in routine.read() if v.role is Role.POINT)


class _Differentiation:
    """Goes through a step once, and writes it with what it keeps, and its tangent."""

    def __init__(self, program: Program) -> None:
        self._main = program.main
        self._moving = _moving(program.main)
        self.slopes = Slopes(program.stations)

    def routines(self) -> tuple[Routine, Routine]:
        """Return the step that keeps its point, and its tangent."""
        kept, changed = [], []
        for section in self._main.sections:
            with_slopes: list[Assign | Require | Loop] = []
            changes: list[Assign | Require | Loop] = []
            for statement in section.statements:
                assert isinstance(statement, Assign | Require | Loop), "nothing is repeated in such a step"
                if not isinstance(statement, Loop):
                    both = self._both(statement, None)
                    with_slopes += both[0]
                    changes += both[1]
                    continue
                self.slopes.enter(statement)
                parts = [self._both(inner, statement) for inner in statement.body]
                with_slopes.append(replace(statement, body=tuple(x for part in parts for x in part[0])))
                body = tuple(x for part in parts for x in part[1])
                if body:
                    changes.append(replace(statement, body=body))
                self.slopes.enter(None)
            kept.append(Section(section.title, tuple(with_slopes)))
            if changes:
                changed.append(Section(f"change of: {section.title}", tuple(changes)))
        return (
            Routine("linearise", LINEARISE_DOC, tuple(kept)),
            Routine("tangent", TANGENT_DOC, tuple(changed)),
        )

    def _both(
        self, statement: Assign | Require, loop: Loop | None
    ) -> tuple[list[Assign | Require], list[Assign]]:
        """Return a statement behind what is kept for it, and what changes by it."""
        if isinstance(statement, Require):
            return [statement], []
        target = statement.target
        before: list[Assign | Require] = []
        slopes: dict[Ref, sp.Expr] = {}
        for ref in sorted(refs_in(statement.value), key=lambda r: r.name):
            if ref.variable in self._moving:
                leader, factor = self.slopes.led(ref, loop)
                slopes[leader] = slopes.get(leader, sp.Integer(0)) + sp.diff(statement.value, ref) * factor
        change = sp.Integer(0)
        for leader, value in slopes.items():
            slope, kept = self.slopes.of(target, leader, value, loop)
            before += kept
            change += slope * _changed(leader)
        self.slopes.assigned(target, loop)
        if len(slopes) == 1:
            self.slopes.follows(target, next(iter(slopes)), slope, loop)
        moves = target.variable in self._moving
        return [*before, statement], [Assign(_changed(target), change)] if moves else []


def _moving(main: Routine) -> frozenset[Variable]:
    """Return what changes with state and inputs."""
    found = {v for v in main.read() | main.written() if v.role in _MOVED}
    while True:
        more = {
            a.target.variable
            for a in main.assignments()
            if a.target.variable not in found and any(r.variable in found for r in refs_in(a.value))
        }
        if not more:
            return frozenset(found)
        found |= more


def _changed(ref: Ref) -> Ref:
    if ref.variable.role in SCRATCH or ref.variable.role in _MOVED:
        return Ref(change_of(ref.variable), ref.offset, ref.entry)
    return ref
