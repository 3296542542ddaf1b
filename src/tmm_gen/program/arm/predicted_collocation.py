"""A step whose stages are all solved at once, about predicted motion: simplified Newton iterations.

An iteration walks over the stages for what their equations leave over, side by side, and mends it by sweeps whose
slopes are those at the first stage that is not before the middle of the step. Accelerations begin on the polynomial of
the last step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from tmm_gen.derive.integrators.declaration import KINDS, Kind
from tmm_gen.derive.station.frame import Frame
from tmm_gen.program.arm.at_places import BASE, hub_unknown, solved_variable
from tmm_gen.program.arm.base import base_acceleration, base_change
from tmm_gen.program.arm.collocation import CollocationStep
from tmm_gen.program.arm.collocation_walks import (
    AGAIN,
    MendingAgain,
    MendingWalks,
    ResidualWalks,
    left_at_base,
    left_over,
    over_on_shaft,
)
from tmm_gen.program.arm.loads import Loads
from tmm_gen.program.arm.motion import Moving, motion_variable
from tmm_gen.program.coupled import HALF
from tmm_gen.program.coupled_motion import Place, trial_acceleration
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.passes.shared import shared_arrays, taken_over
from tmm_gen.program.passes.side_by_side import ZERO, SideBySide
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Statement
from tmm_gen.program.variables import Ref, Variable
from tmm_gen.scene.model import MOST_SWEEPS


@dataclass(frozen=True)
class PredictedCollocationStep(CollocationStep):
    """Builds the sections of a coupled scheme's step for a row about predicted motion; fields are those of its base."""

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        found = [
            Section(
                "accelerations ahead on the last step's polynomial",
                tuple(self._everywhere(self.coupled.ahead)),
            )
        ]
        if self.auto:
            title = f"iterations, until one changes next to nothing, {MOST_SWEEPS} at most"
            found += [Section(title, (Repeat(MOST_SWEEPS),)), *self._iterations(1), self._judged()]
        else:
            found += self._iterations(self.iterations)
        found.append(Section("motion at the end of the step", tuple(self._end())))
        return tuple(s for s in found if s.statements)

    def _judged(self) -> Section:
        return self.coupled.judged(self._turning(self.coupled.turned))

    def _iterations(self, count: int) -> list[Section]:
        """Return so many iterations: the first one sweeps, and leaves its factors to the others."""
        n = self.layout.stations
        arrays = [self._at_stages(kind) for kind in KINDS]
        seeds = self.coupled.inputs_at_stages(self.layout.inputs, self.seen)
        residuals, later_residuals = (self._residual_walks(again=again).sections() for again in (False, True))
        stages = SideBySide(self.coupled.stages, seeds, [*arrays, *self._of_base])
        over, over_again = stages.sections(residuals), stages.sections(later_residuals)
        left = [left_over(n).at(), *map(left_at_base, self.layout.row.coordinates)]
        mend = {**self.seeds(), **{ref: self.coupled.combined(self.coupled.each(ref)) for ref in left}}
        walks = self._mending_walks(again=count > 1)
        again = MendingAgain(walks, walks.motion) if count > 1 else None
        mending = walks.sections(again.plain if again else tuple)
        shared = shared_arrays(residuals, mending)
        taken = taken_over(mending, shared, lambda ref: self._at_slopes(ref, shared))
        swept = SideBySide(self.coupled.systems, mend, [over_on_shaft(n)]).sections(taken)
        later = [s for s in swept if s.title.startswith(AGAIN)]
        moving = [*self._turning(self._motion), *self._base_motion()]
        improved = self._everywhere(self.coupled.improved)
        moved = Section("motion at the stages", tuple(moving))
        begun = [moved, *over, *self._over_on_shafts()]
        ended = Section("improved accelerations of the stages", tuple(improved))
        rounds = [
            [*swept[: len(swept) - len(later)], ended],
            *[[moved, *over_again, *later, ended]] * (count - 1),
        ]
        if count == 1:
            return [*begun, *self.split(rounds[0])]
        titled = [
            replace(s, title=f"iteration {index}: {s.title}")
            for index, sections in enumerate(rounds, start=1)
            for s in sections
        ]
        return [*(replace(s, title=f"iteration 1: {s.title}") for s in begun), *self.split(titled)]

    def _over_on_shafts(self) -> list[Section]:
        """Put together for each system what is over of the torques on shafts."""
        gap = over_on_shaft(self.layout.stations).at()
        body = tuple(self.coupled.left_over(gap, gap))
        loops = [Loop(Order.OUTWARD, k + 1, k + 2, body) for k in sorted(self.layout.row.shafts)]
        return (
            [Section("what is over on shafts, in the system of each eigenvalue", tuple(loops))]
            if loops
            else []
        )

    @cached_property
    def _slopes(self) -> int:
        """The stage whose motion gives the slopes of a step: the first one that is not before its middle.

        The middle as predicted would do as well for the whole step, but what is predicted errs the more the later, and
        there slopes behind the middle are the better ones; and what they need is computed anyway.
        """
        nodes = self.coupled.spectrum.nodes
        return next(index for index, node in enumerate(nodes) if node >= HALF)

    def _at_slopes(self, ref: Ref, shared: frozenset[Variable]) -> Ref:
        """Return what stands for a reference at the stage of the slopes."""
        for given in self.layout.inputs:
            if ref == self.seen[given.name]:
                return given.entry(self._slopes)
        moving = {*(self._at_stages(kind) for kind in KINDS), *self._of_base}
        if ref.variable in shared or ref.variable in moving:
            return Ref(self.coupled.stages[self._slopes].of(ref.variable), ref.offset, ref.entry)
        return ref

    # -- what moves ----------------------------------------------------------------------------------------------

    def _everywhere(self, write: Callable[[Place], list[Assign]]) -> list[Statement]:
        """Write assignments for the base, where it moves freely, and in a loop over all stations."""
        return [*(s for place in self._places for s in write(place)), *self._turning(write)]

    def _turning(self, write: Callable[[Place], list[Assign]]) -> list[Statement]:
        """Write them for all that turns: the hub, where it moves freely, and the stations."""
        layout, n = self.layout, self.layout.stations
        found: list[Statement] = []
        if layout.row.boundary == "free":
            trial = trial_acceleration("hub", None)
            found += write(Place(layout.hub, layout.hub_stages, trial, hub_unknown(), "hub_"))
        trial = trial_acceleration("each link", n)
        body = write(Place(layout.state, layout.stages, trial, solved_variable(n).at()))
        return [*found, Loop(Order.OUTWARD, 0, n, tuple(body))]

    @property
    def _places(self) -> list[Place]:
        """Places of a base that floats. Nothing asks where it is at the stages, nor how fast it moves there."""
        layout = self.layout
        return [
            Place(
                layout.floating[c.name],
                layout.floating_stages[c.name],
                base_acceleration(c),
                base_change(c),
                f"base_{c.name}_",
            )
            for c in layout.row.coordinates
            if c.name in layout.floating
        ]

    @property
    def _of_base(self) -> list[Variable]:
        """Accelerations of a base that floats, which are others at each stage."""
        return [place.trial.variable for place in self._places]

    def _motion(self, place: Place) -> list[Assign]:
        """Write motion at the stages by the accelerations so far."""
        found: list[Assign] = []
        for kind in KINDS:
            targets = [lane.of(self._at_stages(kind)) for lane in self.coupled.stages]
            at_stages = [v.entry(BASE) if place.prefix else v.at(1) for v in targets]
            found += self.coupled.moved(place, kind, at_stages)
        return found

    def _base_motion(self) -> list[Statement]:
        """Return the motion of a base that does not move freely."""
        row = self.layout.row
        found: list[Statement] = []
        if row.boundary == "free":
            return []
        for kind in KINDS:
            at_stages = [ZERO] * len(self.coupled.stages)
            if row.boundary == "prescribed":
                at_stages = [Loads(self.layout, i).prescribed[kind] for i in range(len(self.coupled.stages))]
            for lane, value in zip(self.coupled.stages, at_stages, strict=True):
                found.append(Assign(lane.of(self._at_stages(kind)).entry(BASE), value))
        return found

    def _end(self) -> list[Statement]:
        """Take up the accelerations, and write the motion at the end of the step by them."""
        found: list[Statement] = []
        if self.layout.row.boundary == "prescribed":
            last = len(input_instants(self.layout.row, self.scheme)) - 1
            end = Loads(self.layout, last).prescribed
            found += [Assign(v.ref, end[p.kind]) for p, v in self.layout.hub.items()]
        return [*found, *self._everywhere(self.coupled.finished)]

    # -- walks ---------------------------------------------------------------------------------------------------

    def _residual_walks(self, *, again: bool) -> ResidualWalks:
        row = self.layout.row
        frame = Frame(row.coordinates, (ZERO, ZERO, ZERO), frozenset(), row.about, row.sign)
        motion: dict[str, Moving] = {kind: self._at_stages(kind) for kind in KINDS}
        loads = Loads(self.layout, inputs=self.seen)
        stage = self.stage_of()
        return ResidualWalks(self.layout, self.prepared, frame, {}, motion, loads, stage, again=again)

    def _mending_walks(self, *, again: bool) -> MendingWalks:
        frame = replace(self.frame(), predicted=True, residual=True, corrected=again)
        motion: dict[str, Moving] = {kind: self._at_stages(kind) for kind in KINDS}
        loads = Loads(self.layout, inputs=self.seen)
        return MendingWalks(self.layout, self.prepared, frame, self.gains(), motion, loads, self.stage_of())

    def _at_stages(self, kind: Kind) -> Variable:
        return motion_variable(kind, "prediction", self.layout.stations)
