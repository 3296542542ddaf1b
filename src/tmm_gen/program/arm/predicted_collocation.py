"""A step whose stages are all solved at once, about predicted motion: simplified Newton iterations.

An iteration walks over the stages for what their equations leave over, side by side, and mends it by sweeps whose
slopes are those at the middle of the step. Accelerations begin on the last step's polynomial.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind
from tmm_gen.derive.station.frame import Frame
from tmm_gen.program.arm.at_places import BASE, hub_unknown, solved_variable
from tmm_gen.program.arm.collocation import CollocationStep
from tmm_gen.program.arm.collocation_walks import LEFT_AT_HUB, MendingWalks, ResidualWalks, left_over
from tmm_gen.program.arm.loads import Loads
from tmm_gen.program.arm.motion import Moving, motion_variable
from tmm_gen.program.coupled import ZERO, Place, trial_acceleration
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.passes.side_by_side import SideBySide
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, local
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
            found += [
                Section(title, (Repeat(MOST_SWEEPS),)),
                *self._iteration(),
                self._judged(),
            ]
        else:
            for index in range(self.iterations):
                again = f"iteration {index + 1}: " if self.iterations > 1 else ""
                found += [replace(s, title=again + s.title) for s in self._iteration()]
        found.append(Section("motion at the end of the step", tuple(self._end())))
        return tuple(s for s in found if s.statements)

    def _judged(self) -> Section:
        return self.coupled.judged(self._everywhere(self.coupled.turned))

    def _iteration(self) -> list[Section]:
        n = self.layout.stations
        arrays = [self._at_stages(kind) for kind in KINDS]
        seeds = self.coupled.inputs_at_stages(self.layout.inputs, self.seen)
        over = SideBySide(self.coupled.stages, seeds, arrays).sections(self._residual_walks().sections())
        at_stages = [lane.ref(left_over(n).at())[0] for lane in self.coupled.stages]
        of_hub = [lane.ref(LEFT_AT_HUB)[0] for lane in self.coupled.stages]
        mend = {
            **self.seeds(),
            left_over(n).at(): self.coupled.combined(at_stages),
            LEFT_AT_HUB: self.coupled.combined(of_hub),
        }
        sweep = SideBySide(self.coupled.systems, mend).sections(self._mending_walks().sections())
        moving = [*self._middle_inputs(), *self._everywhere(self._motion), *self._base_motion()]
        return [
            Section("motion at the stages, and at the middle of the step", tuple(moving)),
            *over,
            *self.split(sweep),
            Section("improved accelerations of the stages", tuple(self._everywhere(self.coupled.improved))),
        ]

    # -- what moves ----------------------------------------------------------------------------------------------

    def _everywhere(self, write: Callable[[Place], list[Assign]]) -> list[Statement]:
        """Write assignments for the hub, where it moves freely, and in a loop over all stations."""
        layout, n = self.layout, self.layout.stations
        found: list[Statement] = []
        if layout.row.boundary == "free":
            trial = trial_acceleration("hub", None)
            found += write(Place(layout.hub, layout.hub_stages, trial, hub_unknown(), "hub_"))
        trial = trial_acceleration("each link", n)
        body = write(Place(layout.state, layout.stages, trial, solved_variable(n).at()))
        return [*found, Loop(Order.OUTWARD, 0, n, tuple(body))]

    def _motion(self, place: Place) -> list[Assign]:
        """Write motion at the stages and at the middle by the accelerations so far."""
        found: list[Assign] = []
        for kind in KINDS:
            targets = [lane.of(self._at_stages(kind)) for lane in self.coupled.stages]
            *at_stages, middle = (
                v.entry(BASE) if place.prefix else v.at(1) for v in (*targets, self._at_middle(kind))
            )
            found += self.coupled.moved(place, kind, at_stages, middle)
        return found

    def _base_motion(self) -> list[Statement]:
        """Return the motion of a base that does not move freely."""
        row = self.layout.row
        found: list[Statement] = []
        if row.boundary == "free":
            return []
        for kind in KINDS:
            at_stages = [ZERO] * len(self.coupled.stages)
            middle: sp.Expr = ZERO
            if row.boundary == "prescribed":
                at_stages = [Loads(self.layout, i).prescribed[kind] for i in range(len(self.coupled.stages))]
                middle = Loads(self.layout, inputs=self._middle).prescribed[kind]
            for lane, value in zip(self.coupled.stages, at_stages, strict=True):
                found.append(Assign(lane.of(self._at_stages(kind)).entry(BASE), value))
            found.append(Assign(self._at_middle(kind).entry(BASE), middle))
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

    def _residual_walks(self) -> ResidualWalks:
        row = self.layout.row
        frame = Frame(row.coordinates, (ZERO, ZERO, ZERO), frozenset(), row.about, row.sign)
        motion: dict[str, Moving] = {kind: self._at_stages(kind) for kind in KINDS}
        loads = Loads(self.layout, inputs=self.seen)
        return ResidualWalks(self.layout, self.prepared, frame, {}, motion, loads, self.stage_of())

    def _mending_walks(self) -> MendingWalks:
        frame = replace(self.frame(), predicted=True, residual=True)
        motion: dict[str, Moving] = {kind: self._at_middle(kind) for kind in KINDS}
        loads = Loads(self.layout, inputs=self._middle)
        return MendingWalks(self.layout, self.prepared, frame, self.gains(), motion, loads, self.stage_of())

    @cached_property
    def _middle(self) -> dict[str, Ref]:
        """Inputs at the middle of the step."""
        return {
            v.name: local(f"middle_{v.name}", f"{v.name} at the middle of the step", v.unit)
            for v in self.layout.inputs
        }

    def _middle_inputs(self) -> list[Statement]:
        weights = self.coupled.spectrum.middle["a"]
        return [
            Assign(self._middle[v.name], sp.Add(*(w * v.entry(i) for i, w in enumerate(weights))))
            for v in self.layout.inputs
        ]

    def _at_stages(self, kind: Kind) -> Variable:
        return motion_variable(kind, "prediction", self.layout.stations)

    def _at_middle(self, kind: Kind) -> Variable:
        name, unit = MOTION_NAMES[kind]
        doc = f"{name} of base and links at the middle of the step"
        return Variable(f"middle_{name}", Role.WORK, self.layout.stations + 1, doc, unit)
