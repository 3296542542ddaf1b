"""The planar step that sweeps until one changes next to nothing: for runs on a computer, which may take their time.

Kernels for controllers sweep a fixed number of times. Newton's iteration squares what is wrong: behind a sweep that
has turned the links by d in all, about d^2 is left.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.program.planar.scratch import HUB_UNKNOWN, predicted, solved
from tmm_gen.program.planar.step import PlanarStep
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Until
from tmm_gen.program.variables import Ref, Role, Variable, local

MOST_SWEEPS = 12
"""A step that so many sweeps do not solve is not solved by more: what they left is weighed when all is done."""

LEAST_TURN = Variable(
    "least_turn",
    Role.PARAMETER,
    doc="a sweep that turns the links by less in all, squares summed, is the last of a stage",
    unit="rad",
    default=1e-4,
)
"""May be made smaller where the equations are to be solved better than steps usually need."""

SWEEPS = Variable("sweeps", Role.STATE, doc="sweeps taken so far")
"""Counted by the step."""

_TURNED = local("turned", "sum of squares of what this sweep changes angles by", "rad^2")


@dataclass(frozen=True)
class AutoStep(PlanarStep):
    """Builds the sections of one scheme's step; fields are those of :class:`PlanarSweep`, but iterations."""

    def _swept(self, title: str, index: int, motion: AffineMotion) -> list[Section]:
        begin = Section(
            title + f"sweeps, until one changes next to nothing, {MOST_SWEEPS} at most",
            (Repeat(MOST_SWEEPS),),
        )
        sweep = [Section(title + s.title, s.statements) for s in self._sweep(index, 0, motion)]
        improve = Section(title + "improved prediction", tuple(self._improve(motion)))
        return [begin, *sweep, improve, self._judged(title, motion)]

    def _judged(self, title: str, motion: AffineMotion) -> Section:
        """Add up how far the sweep has turned the links; a changed rate counts as what it turns them by in a step."""
        n = self.layout.stations
        turn, rate = self._gain(motion, "q"), self._gain(motion, "v") * self.layout.step.ref
        weight = sp.expand(turn**2 + rate**2)
        base = weight * HUB_UNKNOWN**2 if self.base == "motor" else sp.Integer(0)
        return Section(
            title + "whether it has changed next to nothing",
            (
                Assign(_TURNED, base),
                Loop(Order.OUTWARD, 0, n, (Assign(_TURNED, _TURNED + weight * solved(n).at() ** 2),)),
                Assign(SWEEPS.ref, SWEEPS.ref + 1),
                Until(_TURNED - LEAST_TURN.ref**2),
            ),
        )

    def _solved_motion(self, motion: AffineMotion) -> tuple[Mapping[Kind, sp.Expr], Mapping[Kind, sp.Expr]]:
        """Return what the last improvement made of the prediction: all increments are in it."""
        n = self.layout.stations

        def at(place: int | None) -> dict[Kind, Ref]:
            variables = {kind: predicted(kind, n) for kind in ("q", "v", "a")}
            return {k: v.at(1) if place is None else v.entry(place) for k, v in variables.items()}  # type: ignore[misc]

        return at(None), at(0)
