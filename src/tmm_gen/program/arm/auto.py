"""The step that sweeps until one changes next to nothing: for runs on a computer, which may take their time.

Kernels for controllers sweep a fixed number of times. Newton's iteration squares what is wrong: behind a sweep that
has turned the links by d in all, about d^2 is left.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.program.arm.at_places import BASE, hub_unknown, solved_variable
from tmm_gen.program.arm.motion import Moving
from tmm_gen.program.arm.step import StepBuilder
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Statement, Until
from tmm_gen.program.sweeps import LEAST_TURN, SWEEPS
from tmm_gen.program.variables import local
from tmm_gen.scene.model import MOST_SWEEPS

_TURNED = local("turned", "sum of squares of what this sweep changes angles by", "rad^2")


@dataclass(frozen=True)
class AutoStep(StepBuilder):
    """Builds the sections of one scheme's step; fields are those of :class:`StepBuilder`, but iterations."""

    def _swept(self, title: str, begun: Section, walks: Walks, motion: AffineMotion) -> list[Section]:
        rounds = Section(
            title + f"sweeps, until one changes next to nothing, {MOST_SWEEPS} at most",
            (Repeat(MOST_SWEEPS),),
        )
        sweep = [Section(title + s.title, s.statements) for s in self.split(walks.sections())]
        improve = Section(title + "improved prediction", tuple(self._improve(motion)))
        return [begun, rounds, *sweep, improve, self._judged(title, motion)]

    def _stays(self) -> bool:
        return False

    def _judged(self, title: str, motion: AffineMotion) -> Section:
        """Add up how far the sweep has turned the links; a changed rate counts as what it turns them by in a step."""
        n = self.layout.stations
        turn, rate = self._gain(motion, "q"), self._gain(motion, "v") * self.layout.step.ref
        weight = sp.expand(turn**2 + rate**2)
        base = weight * hub_unknown() ** 2 if self._free else sp.Integer(0)
        return Section(
            title + "whether it has changed next to nothing",
            (
                Assign(_TURNED, base),
                Loop(
                    Order.OUTWARD, 0, n, (Assign(_TURNED, _TURNED + weight * solved_variable(n).at() ** 2),)
                ),
                Assign(SWEEPS.ref, SWEEPS.ref + 1),
                Until(_TURNED - LEAST_TURN.ref**2),
            ),
        )

    def _found_of_base(self) -> list[Statement]:
        return []

    def _solved_motion(
        self, motion: AffineMotion, moving: dict[Kind, Moving]
    ) -> tuple[dict[Kind, sp.Expr], dict[Kind, sp.Expr]]:
        """Return what the last improvement made of the prediction: all increments are in it."""
        del motion
        return {k: v.at(1) for k, v in moving.items()}, {k: v.entry(BASE) for k, v in moving.items()}
