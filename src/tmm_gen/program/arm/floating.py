"""Where a base that floats has been and goes: accelerations that sweeps find, integrated like angles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Scheme, stage
from tmm_gen.derive.integrators.relations import AffineMotion, affine_motion
from tmm_gen.derive.station.lets import Coordinate
from tmm_gen.program.arm.base import base_acceleration, base_change
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.motion import KNOWN_RATE, starting_point
from tmm_gen.program.motion import kept_stage_values, update_assignments
from tmm_gen.program.statements import Assign, Statement
from tmm_gen.program.variables import Variable, local

_WORDS: dict[Kind, tuple[str, str]] = {
    "q": ("place", "m"),
    "v": ("velocity", "m/s"),
    "a": ("acceleration", "m/s^2"),
}


@dataclass(frozen=True)
class Floating:
    """Statements for the place of a base, around the sweeps of a scheme's stages; none where it does not float.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    scheme : Scheme
    sources : mapping from str to mapping from sympy.Symbol to sympy.Expr
        Where history is read from, by coordinate.
    held : bool
        Whether a stage is predicted with the newest acceleration instead of none.
    """

    layout: Layout
    scheme: Scheme
    sources: Mapping[str, Mapping[sp.Symbol, sp.Expr]]
    held: bool = True

    def begin(self, index: int) -> list[Statement]:
        """Predict the acceleration of a stage, counted from 1: that of the instant solved before, or none."""
        motion = affine_motion(self.scheme, index, "acceleration")
        guess = starting_point(motion, index - 1, self.layout.row.about, held=self.held).values["a"]
        return [Assign(base_acceleration(c), self._written(guess, c)) for c in self._coordinates]

    def improve(self) -> list[Statement]:
        """Take up what a sweep has found."""
        return [
            Assign(base_acceleration(c), base_acceleration(c) + base_change(c)) for c in self._coordinates
        ]

    def keep(self, index: int) -> list[Statement]:
        """Keep what later stages read of a stage."""
        mine = sorted((kind, i) for kind, i in self._kept if i == index)
        return [
            Assign(self._stage(kind, i, c).ref, self._at(index, c)[kind])
            for c in self._coordinates
            for kind, i in mine
        ]

    def finish(self) -> list[Statement]:
        """Set the motion at the end of the step."""
        last = len(self.scheme.stages)
        found: list[Statement] = []
        for c in self._coordinates:
            own = {stage(kind, last): value for kind, value in self._at(last, c).items()}
            new = {
                kind: sp.expand(self._written(sp.sympify(self.scheme.update[kind]).xreplace(own), c))
                for kind in KINDS
            }
            found += update_assignments(self.layout.floating[c.name], new, lambda v: v.ref, "")
        return found

    @property
    def _coordinates(self) -> list[Coordinate]:
        return [c for c in self.layout.row.coordinates if c.name in self.layout.floating]

    @property
    def _kept(self) -> frozenset[tuple[Kind, int]]:
        offsets: dict[tuple[int, Kind], sp.Expr] = {}
        for i in range(len(self.scheme.stages)):
            motion = affine_motion(self.scheme, i + 1, "acceleration")
            offsets |= {(i, kind): motion.offset[kind] for kind in KINDS}
            guess = starting_point(motion, i, self.layout.row.about, held=self.held).values["a"]
            offsets[i, "a"] = offsets[i, "a"] + guess
        return kept_stage_values(self.scheme, offsets)

    def _at(self, index: int, c: Coordinate) -> dict[Kind, sp.Expr]:
        """Return the motion of a stage by its acceleration."""
        motion: AffineMotion = affine_motion(self.scheme, index, "acceleration")
        found = base_acceleration(c)
        unknown = (found - motion.offset["a"]) / motion.gain["a"]
        return {
            kind: self._written(sp.expand(motion.offset[kind] + motion.gain[kind] * unknown), c)
            for kind in KINDS
        }

    def _written(self, value: sp.Expr, c: Coordinate) -> sp.Expr:
        stages = {
            stage(kind, i): self._stage(kind, i, c).ref
            for kind in KINDS
            for i in range(1, len(self.scheme.stages))
        }
        assert not value.has(KNOWN_RATE)
        return value.xreplace({STEP: self.layout.step.ref, **self.sources[c.name], **stages})

    def _stage(self, kind: Kind, index: int, c: Coordinate) -> Variable:
        word, unit = _WORDS[kind]
        doc = f"{word} of the base along {c.name} at stage {index}"
        return local(f"base_stage{index}_{word}_{c.name}", doc, unit).variable
