"""A step whose stages are all solved at once: one real or complex sweep for each eigenvalue of its weights.

About known motion (a linear row) the systems of the eigenvalues are solved for the motion itself, as any stage is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past, Scheme
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.derive.station.frame import GAINS, Frame
from tmm_gen.program.arm.at_places import BASE, hub_unknown, solved_variable
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.loads import Loads
from tmm_gen.program.arm.motion import StageOf, motion_variable
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.coupled import GAIN_OF, Coupled, seen
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.motion import update_assignments
from tmm_gen.program.passes.side_by_side import ZERO, Pair, SideBySide
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Ref, Variable


@dataclass(frozen=True)
class CollocationStep:
    """Builds the sections of a coupled scheme's step for a row about known motion.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    prepared : mapping from str to Variable
        Combinations of parameters.
    scheme : Scheme
        What to step with.
    iterations : int
        Of Newton's method, each with all sweeps.
    auto : bool
        Whether to iterate until that changes next to nothing instead.
    split : callable
        Takes from a sweep's sections what is bound early.
    """

    layout: Layout
    prepared: Mapping[str, Variable]
    scheme: Scheme
    iterations: int = 1
    auto: bool = False
    split: Callable[[list[Section]], list[Section]] = list

    @cached_property
    def coupled(self) -> Coupled:
        """Sums over the scheme's stages."""
        return Coupled(self.scheme, self.step)

    @property
    def step(self) -> Ref:
        """The time step."""
        return self.layout.step.ref

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        known = Section(
            "motion known before the sweeps, in the system of each eigenvalue", tuple(self._known())
        )
        swept = SideBySide(self.coupled.systems, self.seeds(), self._differing).sections(
            self._walks().sections()
        )
        found = [known, *self.split(swept), self._finish()]
        return tuple(s for s in found if s.statements)

    # -- systems of the eigenvalues ------------------------------------------------------------------------------

    def seeds(self) -> dict[Ref, list[Pair]]:
        """Return what differs from system to system: gains, and inputs, each by those of all stages."""
        seeds = self.coupled.gains()
        for given in self.layout.inputs:
            seeds[self.seen[given.name]] = self.coupled.combined(
                [given.entry(i) for i in range(len(self.coupled.stages))]
            )
        return seeds

    @cached_property
    def seen(self) -> dict[str, Ref]:
        """What stands for the inputs while walks are written."""
        return seen(self.layout.inputs)

    def frame(self, *, still: frozenset[str] = frozenset()) -> Frame:
        """Return what the sweep of each system is derived for."""
        row = self.layout.row
        return Frame(row.coordinates, (GAINS["q"], GAINS["v"], sp.S.One), still, row.about, row.sign)

    def gains(self) -> dict[sp.Symbol, sp.Expr]:
        """Return what stands for the gains of that frame."""
        return {GAINS["q"]: GAIN_OF["q"], GAINS["v"]: GAIN_OF["v"], GAINS["a"]: sp.S.One}

    def stage_of(self) -> StageOf:
        """Return what walks are told of the scheme."""
        nothing = dict.fromkeys(KINDS, ZERO)
        return StageOf(self.scheme, len(self.scheme.stages), AffineMotion(nothing, nothing), {})

    # -- about known motion ----------------------------------------------------------------------------------------

    def _walks(self) -> Walks:
        motion = {"q": self._angle(), "v": self._rate()}
        frame, loads = self.frame(still=frozenset("a")), Loads(self.layout, inputs=self.seen)
        return Walks(self.layout, self.prepared, frame, self.gains(), motion, loads, self.stage_of())

    def _angle(self) -> Variable:
        return motion_variable("q", "known", self.layout.stations)

    def _rate(self) -> Variable:
        return motion_variable("v", "known", self.layout.stations)

    def _known(self) -> list[Statement]:
        """Write the motion without accelerations: the rate is that of the step's start in each system."""
        layout, n = self.layout, self.layout.stations
        angle, rate = (layout.state[Past(kind, 0)].at() for kind in ("q", "v"))
        body = self._moved((self._angle().at(1), self._rate().at(1)), *self._from(angle, rate))
        base = (self._angle().entry(BASE), self._rate().entry(BASE))
        if layout.row.boundary == "free":
            begun = self._from(*(layout.hub[Past(kind, 0)].ref for kind in ("q", "v")))
        elif layout.row.boundary == "prescribed":
            given = [Loads(layout, i).prescribed for i in range(len(self.coupled.spectrum.nodes))]
            begun = [self.coupled.combined([each[kind] for each in given]) for kind in ("q", "v")]
        else:
            begun = self._from(ZERO, ZERO)
        return [*self._moved(base, *begun), Loop(Order.OUTWARD, 0, n, tuple(body))]

    def _from(self, angle: sp.Expr, rate: sp.Expr) -> list[list[Pair]]:
        """Return angle and rate in each system, by those at the start of the step."""
        angles = [
            (angle + self.step * re * rate, self.step * im * rate) for re, im in self.coupled.spectrum.values
        ]
        return [angles, [(rate, ZERO)] * len(angles)]

    def _moved(self, targets: tuple[Ref, Ref], angles: Sequence[Pair], rates: Sequence[Pair]) -> list[Assign]:
        found: list[Assign] = []
        for target, values in zip(targets, (angles, rates), strict=True):
            if target.variable not in self._differing:
                found.append(Assign(target, values[0][0]))
                continue
            for lane, pair in zip(self.coupled.systems, values, strict=True):
                places = zip(lane.ref(target), pair, strict=True)
                found += [Assign(ref, value) for ref, value in places if isinstance(ref, Ref)]
        return found

    @property
    def _differing(self) -> list[Variable]:
        """Known motion that is another one in each system: rates are where a base is moved as prescribed."""
        prescribed = self.layout.row.boundary == "prescribed"
        return [self._angle(), self._rate()] if prescribed else [self._angle()]

    def _finish(self) -> Section:
        n = self.layout.stations
        statements: list[Statement] = []
        if self.layout.row.boundary == "free":
            new = self._new(self.layout.hub, lambda v: v.ref, hub_unknown())
            statements += update_assignments(self.layout.hub, new, lambda v: v.ref, "")
        elif self.layout.row.boundary == "prescribed":
            last = len(input_instants(self.layout.row, self.scheme)) - 1
            end = Loads(self.layout, last).prescribed
            statements += [Assign(v.ref, end[p.kind]) for p, v in self.layout.hub.items()]
        new = self._new(self.layout.state, lambda v: v.at(), solved_variable(n).at())
        body = tuple(update_assignments(self.layout.state, new, lambda v: v.at(), ""))
        statements.append(Loop(Order.OUTWARD, 0, n, body))
        return Section("motion at the end of the step", tuple(statements))

    def _new(
        self, history: Mapping[Past, Variable], read: Callable[[Variable], Ref], found: Ref
    ) -> dict[Kind, sp.Expr]:
        """Return the motion at the end of the step by what the systems have found."""
        angle, rate = (read(history[Past(kind, 0)]) for kind in ("q", "v"))
        return {
            "q": angle
            + self.step * rate
            + self.step**2 * self.coupled.from_systems(self.coupled.spectrum.ends["q"], found),
            "v": rate + self.step * self.coupled.from_systems(self.coupled.spectrum.ends["v"], found),
            "a": self.coupled.from_systems(self.coupled.spectrum.ends["a"], found),
        }
