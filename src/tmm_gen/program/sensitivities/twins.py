"""Variables that hold changes of others, and the routines that compute with them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from tmm_gen.program.passes.rewrite import map_references
from tmm_gen.program.statements import Routine, Sensitivities
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable

_ROLES = {Role.STATE: Role.TANGENT, Role.INPUT: Role.INPUT_TANGENT}


def change_of(variable: Variable) -> Variable:
    """Return the change of a state variable, an input, or a scratch variable; others do not change."""
    doc = f"change of {variable.doc}" if variable.doc else ""
    if variable.role in SCRATCH:
        return replace(variable, name=f"d_{variable.name}", doc=doc)
    return replace(variable, role=_ROLES[variable.role], doc=doc)


def changes_of(variables: Iterable[Variable]) -> tuple[Variable, ...]:
    """Return the changes of several variables."""
    return tuple(change_of(v) for v in variables)


def as_tangent(routine: Routine) -> Routine:
    """Return a routine that is linear in state, inputs and scratch as the same routine on their changes."""

    def changed(ref: Ref) -> Ref:
        if ref.variable.role in SCRATCH or ref.variable.role in _ROLES:
            return Ref(change_of(ref.variable), ref.offset, ref.entry)
        return ref

    return replace(routine, sections=tuple(map_references(s, changed) for s in routine.sections))


def linear_sensitivities(
    main: Routine, state: tuple[Variable, ...], inputs: tuple[Variable, ...]
) -> Sensitivities:
    """Return the sensitivities of a linear step.

    Parameters
    ----------
    main : Routine
        The step.
    state, inputs : tuple of Variable
        Of the program.
    """
    tangent = replace(as_tangent(main), name="tangent", doc=TANGENT_DOC)
    linearise = replace(main, name="linearise", doc=LINEARISE_DOC)
    return Sensitivities((), changes_of(state), changes_of(inputs), linearise, tangent)


TANGENT_DOC = "Carry a change of state and inputs over the step that was linearised last."
LINEARISE_DOC = "Advance the state by one step and keep what tangents need."
