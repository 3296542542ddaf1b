"""A linear row: its tangent is its step."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.program.sensitivities.twins import as_tangent, changes_of
from tmm_gen.program.statements import Routine, Sensitivities
from tmm_gen.program.variables import Variable


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
