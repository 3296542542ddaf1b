"""Sensitivities of a row's main step: the step with its factors kept, and its tangent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from tmm_gen.program.arm.step import StepBuilder
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.sensitivities.changes import TangentWalks
from tmm_gen.program.sensitivities.linearised import LinearisedWalks
from tmm_gen.program.sensitivities.point import Point
from tmm_gen.program.sensitivities.twins import LINEARISE_DOC, TANGENT_DOC, as_tangent, changes_of
from tmm_gen.program.statements import Routine, Section, Sensitivities
from tmm_gen.program.variables import Role, Variable


def step_sensitivities(
    step: StepBuilder,
    after: tuple[Section, ...],
    state: tuple[Variable, ...],
    inputs: tuple[Variable, ...],
    hoister: Hoister,
) -> Sensitivities:
    """Return the sensitivities of a step.

    Parameters
    ----------
    step : StepBuilder
        Builds the step itself.
    after : tuple of Section
        What the step does last, linear too.
    state, inputs : tuple of Variable
        Of the program.
    hoister : Hoister
        Of the program: what is bound early moves to prepare.
    """
    sweeps = len(step.scheme.stages) * step.iterations
    points = tuple(Point(step.layout.stations, sweeps, k + 1) for k in range(sweeps))
    linearised = _walked(step, LinearisedWalks, points)
    linearise = Routine("linearise", LINEARISE_DOC, (*linearised, *after))
    changed = _walked(step, TangentWalks, points)
    tangent = Routine("tangent", TANGENT_DOC, (*changed, *after))
    tangent = prune(as_tangent(hoister.hoist(tangent)), frozenset(changes_of(state)))
    needed = frozenset(v for v in tangent.read() if v.role is Role.POINT)
    return Sensitivities(
        point=tuple(v for point in points for v in point.variables if v in needed),
        state=changes_of(state),
        inputs=changes_of(inputs),
        linearise=prune(hoister.hoist(linearise), frozenset(state) | needed),
        tangent=tangent,
    )


def _walked(
    step: StepBuilder, walks: Callable[..., LinearisedWalks | TangentWalks], points: tuple[Point, ...]
) -> tuple[Section, ...]:
    """Build a step whose sweeps take other walks, each with its own point."""
    left = [list(points[k : k + step.iterations]) for k in range(0, len(points), step.iterations)]

    def make(*arguments: object) -> LinearisedWalks | TangentWalks:
        found = walks(*arguments)
        found.points = tuple(left.pop(0))
        return found

    return replace(step, walks=make).sections()
