"""Stages that are solved at once as parts of vectors, and so systems, for processors that do several numbers at a time.

A vector of stages has one part for each; one of systems has two, the real and the imaginary one, which is zero where
the eigenvalue is real. What a step adds up over stages or systems is a sum of constant vectors times single parts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind
from tmm_gen.derive.integrators.spectrum import fraction
from tmm_gen.program.coupled import GAIN_OF, HALF, Coupled
from tmm_gen.program.coupled_motion import Place
from tmm_gen.program.parts import Part, Vector
from tmm_gen.program.passes.side_by_side import ZERO, Lane, Pair
from tmm_gen.program.statements import Assign, Section
from tmm_gen.program.variables import Ref, Role, Spread, Variable


@dataclass(frozen=True)
class CoupledVectors(Coupled):
    """The sums of a coupled scheme, and its step, in vectors."""

    _numbers: dict[str, Assign] = field(default_factory=dict, init=False, compare=False)

    @property
    def parts(self) -> int:
        """How many parts a vector has: a power of two."""
        most = max(len(self.spectrum.nodes), 2 * len(self.spectrum.values))
        return 1 << (most - 1).bit_length()

    @cached_property
    def systems(self) -> tuple[Lane, ...]:
        """One for the systems of all eigenvalues."""
        found: list[sp.Expr] = []
        for re, im in self.spectrum.values:
            found += [re, -im] if im != 0 else [sp.S.One, ZERO]
        facing = self._number("facing", "what turns pivots to where their real parts are positive", *found)
        return (Lane("_systems", "in all systems", spread=Spread.SYSTEMS, facing=facing),)

    @cached_property
    def stages(self) -> tuple[Lane, ...]:
        """One for all stages."""
        return (Lane("_stages", "at all stages", spread=Spread.STAGES),)

    def numbers(self) -> Section:
        """Return what sets the constant vectors that have been asked for."""
        return Section("numbers of the method", tuple(self._numbers.values()))

    def gains(self) -> dict[Ref, list[Pair]]:
        """Return the gains of the systems."""
        rate, angle = [], []
        for re, im in self.spectrum.values:
            rate += [re, im]
            angle += [fraction(re**2 - im**2), fraction(2 * re * im)]
        words = "per unknown in all systems, in steps"
        return {
            GAIN_OF["v"]: [
                (self.step * self._number("rate_gains", f"rate {words}", *rate, systems=True), ZERO)
            ],
            GAIN_OF["q"]: [
                (self.step**2 * self._number("angle_gains", f"angle {words}", *angle, systems=True), ZERO)
            ],
        }

    def at_stages(self, value: Callable[[int], sp.Expr]) -> list[sp.Expr]:
        """Return what has a value at each stage."""
        return [Vector(*map(value, range(len(self.spectrum.nodes))))]

    def each(self, value: Ref) -> list[sp.Expr]:
        """Return what a value is at each stage."""
        return self._parts(self.stages[0].ref(value)[0])

    def left_over(self, lacking: Ref, torque: Ref) -> list[Assign]:
        """Put together for each system what torques lack at the stages."""
        found = self.each(lacking)
        rows = [[row[k][part] for row in self.spectrum.into for part in (0, 1)] for k in range(len(found))]
        value = self._columns(
            "system_by_stage", "what a stage adds to each system", rows, found, systems=True
        )
        return [Assign(self.systems[0].ref(torque)[0], value)]

    def from_systems(self, weights: Sequence[sp.Expr], found: Ref) -> sp.Expr:
        """Return a weighted sum of the stages by what the systems have found."""
        columns, parts = self._back(found)
        sums = [fraction(sp.Add(*(w * x for w, x in zip(weights, c, strict=True)))) for c in columns]
        return sp.Add(*(weight * part for weight, part in zip(sums, parts, strict=True)))

    # -- motion at a place ---------------------------------------------------------------------------------------

    def ahead(self, place: Place) -> list[Assign]:
        """Begin on the polynomial of the last step."""
        kept = [v.at() for v in place.stages]
        words = "what a stage of the last step adds to what its polynomial predicts"
        return [Assign(self._whole(place), self._by_stage("ahead", words, self.spectrum.ahead, kept))]

    def moved(
        self, place: Place, kind: Kind, at_stages: Sequence[Ref], at_middle: Ref | None = None
    ) -> list[Assign]:
        """Write motion at the stages, and at the middle of the step, by the accelerations so far."""
        (target,) = at_stages
        trials = self.trials(place)
        if kind == "a":
            value: sp.Expr = self._whole(place)
        elif kind == "v":
            words = "what a stage adds to rates, in steps"
            gained = self._by_stage("rate", words, self.spectrum.matrix, trials)
            value = place.before("v") + self.step * gained
        else:
            rows, nodes = self.spectrum.squared, self.spectrum.nodes
            if at_middle is None and self.spare:
                rows, nodes = rows.col_join(sp.Matrix([self.spectrum.middle["q"]])), (*nodes, HALF)
            words = "what a stage adds to angles, in squares of steps"
            gained = self._by_stage("angle", words, rows, trials)
            instants = self._number("instants", "instants of the stages, in steps", *nodes)
            value = place.before("q") + self.step * (place.before("v") * instants + self.step * gained)
        found = [Assign(target, value)]
        if at_middle is not None:
            gained = sp.Add(*(w * trial for w, trial in zip(self.spectrum.middle[kind], trials, strict=True)))
            found.append(Assign(at_middle, self._by(place, kind, gained, HALF)))
        return found

    @property
    def spare(self) -> bool:
        """Whether vectors have a part beyond the stages: angles have the middle of the step there."""
        return self.parts > len(self.spectrum.nodes)

    def at_middle(self, at_stages: Ref) -> sp.Expr:
        """Return what follows of an angle at the middle of the step, where vectors have it."""
        return Part(self.stages[0].ref(at_stages)[0], len(self.spectrum.nodes))

    def improved(self, place: Place) -> list[Assign]:
        """Take up what the systems have found."""
        whole = self._whole(place)
        return [Assign(whole, whole + change) for change in self.changes(place.solved)]

    def changes(self, found: Ref) -> list[sp.Expr]:
        """Return what the systems have found to change at the stages."""
        words = "what part of a system adds to each stage"
        return [self._columns("stage_by_part", words, *self._back(found))]

    # -- vectors -------------------------------------------------------------------------------------------------

    def _whole(self, place: Place) -> Ref:
        whole = self.stages[0].ref(place.trial)[0]
        assert isinstance(whole, Ref)
        return whole

    def _parts(self, whole: Ref) -> list[sp.Expr]:
        return [Part(whole, k) for k in range(len(self.spectrum.nodes))]

    def _back(self, found: Ref) -> tuple[list[list[sp.Expr]], list[sp.Expr]]:
        """Return what each part of each system adds to the stages, and these parts."""
        columns: list[list[sp.Expr]] = []
        parts: list[sp.Expr] = []
        whole = self.systems[0].ref(found)[0]
        for index, (_, own) in enumerate(self.spectrum.values):
            for part, sign in ((0, 1), (1, -1)):
                if part == 0 or own != 0:
                    columns.append([sign * row[index][part] for row in self.spectrum.back])
                    parts.append(Part(whole, 2 * index + part))
        return columns, parts

    def _by_stage(self, name: str, words: str, matrix: sp.Matrix, values: Sequence[sp.Expr]) -> sp.Expr:
        columns = [list(matrix.col(k)) for k in range(matrix.cols)]
        return self._columns(f"{name}_by_stage", words, columns, values)

    def _columns(
        self,
        name: str,
        words: str,
        columns: Sequence[Sequence[sp.Expr]],
        values: Sequence[sp.Expr],
        *,
        systems: bool = False,
    ) -> sp.Expr:
        """Return constant vectors times numbers, added up."""
        return sp.Add(
            *(
                self._number(f"{name}{k + 1}", words, *column, systems=systems) * value
                for k, (column, value) in enumerate(zip(columns, values, strict=True))
            )
        )

    def _number(self, name: str, words: str, *values: sp.Expr, systems: bool = False) -> Ref:
        """Return what stands for a constant vector, which is written before everything else."""
        spread = Spread.SYSTEMS if systems else Spread.STAGES
        ref = Variable(name, Role.LOCAL, doc=words, spread=spread).ref
        self._numbers[name] = Assign(ref, Vector(*values))
        return ref
