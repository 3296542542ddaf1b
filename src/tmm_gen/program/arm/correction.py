"""The walks of a correction: motion and forces anew, with the factors that a sweep before it has left.

A sweep solves ``A u = -r`` at the motion before it. At the motion behind it a correction solves that again, with ``r``
exact and ``A`` as it was: pivots, slopes and answers of each station are read, not computed. What is wrong shrinks by
as much as ``A`` has changed in between.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import UNKNOWN, force
from tmm_gen.derive.station.inward import Inward
from tmm_gen.derive.station.lets import Let, Line, Update, needed
from tmm_gen.derive.station.station import outward
from tmm_gen.program.arm.base import Balance
from tmm_gen.program.arm.motion import Moving
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.statements import Section

_TITLES = (
    "accelerations of the nodes",
    "forces of the joints",
    "forces inward, with the factors of the sweep",
    "the base",
    "outward: what each station still lacks",
)


class Correction(Walks):
    """Builds the sections of a correction.

    Parameters
    ----------
    sweep : Walks
        What leaves the factors: its frame is ``corrected``.
    motion : mapping from "q", "v", "a" to Variable or Held
        As the sweep has found it.
    """

    def __init__(self, sweep: Walks, motion: Mapping[str, Moving]) -> None:
        frame = replace(sweep.frame, still=frozenset())
        super().__init__(
            sweep.layout, sweep.prepared, frame, sweep.gains, motion, sweep.loads.standing(), sweep.stage
        )
        self.scratch = sweep.scratch

    def plain(self) -> list[Section]:
        """Return the correction, with scratch of stations as scalars."""
        return [replace(s, title=title) for s, title in zip(super().plain(), _TITLES, strict=True)]

    def ways_out(self, elements: tuple[Element, ...], derived: Inward) -> list[Let]:
        """Return the motion alone: how it answers to unknowns is known."""
        out = outward(elements, self.frame)
        read = {s for value in out.nodes.values() for s in value.free_symbols}
        for line in (*derived.again, *derived.known):
            values = line.values.values() if isinstance(line, Update) else (line.value,)
            read |= {s for value in values for s in sp.sympify(value).free_symbols}
        return [line for line in needed(out.lets, frozenset(read)) if isinstance(line, Let)]

    def ways_ahead(self, derived: Inward) -> Sequence[Line]:
        """Return nothing: what depends on parameters and gains alone is known."""
        del derived
        return ()

    def ways_in(self, derived: Inward) -> Sequence[Line]:
        """Return forces alone."""
        return derived.again

    def carried_inward(self) -> list[sp.Symbol]:
        """Return forces alone."""
        return [force(c) for c in self.frame.coordinates]

    def _balance(self) -> Balance:
        return replace(super()._balance(), factors=())

    def _free_base(self) -> list[Line]:
        return [x for x in super()._free_base() if isinstance(x, Update) and UNKNOWN in x.values]
