"""The step of an arm in space whose stages are all solved at once, in vectors of stages and of systems."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from tmm_gen.derive.space.outward import COSINE, SINE
from tmm_gen.program.coupled_vectors import CoupledVectors
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.passes.zeros import without_zeros
from tmm_gen.program.space.collocation import SpaceCollocation
from tmm_gen.program.statements import Assign, Loop, Order, Program, Section, Vectors


@dataclass(frozen=True)
class VectorCollocation(SpaceCollocation):
    """Builds the same sections in vectors; nothing of them is bound early."""

    @cached_property
    def coupled(self) -> CoupledVectors:
        """Sums over the scheme's stages."""
        return CoupledVectors(self.scheme, self.layout.step.ref)

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        found = super().sections()
        return (self.coupled.numbers(), *found)

    def _circles(self) -> Section:
        """Return what sets the sines by which the sweeps go: where vectors have room, those of all stages hold them."""
        if not self.coupled.spare:
            return super()._circles()
        body = tuple(
            Assign(self._mend.array(s).at(), self.coupled.at_middle(self._over.array(s).at()))
            for s in (SINE, COSINE)
        )
        stretches = self.layout.tree.stretches
        return Section(
            "sines of the angles at the middle of the step",
            tuple(Loop(Order.OUTWARD, start, stop, body) for start, stop in stretches),
        )


def in_vectors(program: Program, step: VectorCollocation, hold: tuple[Section, ...]) -> Vectors:
    """Return the step of a program in vectors.

    Parameters
    ----------
    program : Program
        Whose step it is.
    step : VectorCollocation
        What builds it.
    hold : tuple of Section
        What keeps inputs for outputs.
    """
    routine = replace(program.main, sections=(*step.sections(), *hold))
    return Vectors(prune(without_zeros(routine), frozenset(program.state)), step.coupled.parts)
