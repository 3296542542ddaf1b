"""A step whose stages are all solved at once, about predicted motion: simplified Newton iterations.

An iteration walks over the stages for what their equations leave over, side by side, and mends it by sweeps whose
slopes are those at the middle of the step. Accelerations begin on the last step's polynomial.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past
from tmm_gen.derive.station.frame import Frame
from tmm_gen.program.arm.at_places import BASE, hub_unknown, solved_variable
from tmm_gen.program.arm.collocation import CollocationStep
from tmm_gen.program.arm.collocation_walks import LEFT_AT_HUB, MendingWalks, ResidualWalks, left_over
from tmm_gen.program.arm.loads import Loads
from tmm_gen.program.arm.motion import Moving, motion_variable
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.motion import update_assignments
from tmm_gen.program.passes.side_by_side import Lane, Pair, SideBySide
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Statement, Until
from tmm_gen.program.sweeps import LEAST_TURN, MOST_SWEEPS, SWEEPS
from tmm_gen.program.variables import Ref, Role, Variable, local

ZERO = sp.Integer(0)
_TURNED = local("turned", "sum of squares of what this iteration changes angles by", "rad^2")


@dataclass(frozen=True)
class _Place:
    """Where motion stands of the stations, in a loop over them, or of the hub.

    Parameters
    ----------
    history : mapping from Past to Ref
    stages : tuple of Ref
        Accelerations at the stages of the last step.
    trial : Ref
        Acceleration as known so far, one for each lane.
    solved : Ref
        What sweeps find.
    """

    history: Mapping[Past, Ref]
    stages: tuple[Ref, ...]
    trial: Ref
    solved: Ref

    def before(self, kind: Kind) -> Ref:
        """Return the motion at the start of the step."""
        return self.history[Past(kind, 0)]


@dataclass(frozen=True)
class PredictedCollocationStep(CollocationStep):
    """Builds the sections of a coupled scheme's step for a row about predicted motion; fields are those of its base."""

    @cached_property
    def stages(self) -> tuple[Lane, ...]:
        """One for each stage."""
        count = range(1, len(self.spectrum.nodes) + 1)
        return tuple(Lane(f"_stage{index}", f"at stage {index}") for index in count)

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        found = [
            Section("accelerations ahead on the last step's polynomial", tuple(self._everywhere(self._ahead)))
        ]
        if self.auto:
            title = f"iterations, until one changes next to nothing, {MOST_SWEEPS} at most"
            found += [Section(title, (Repeat(MOST_SWEEPS),)), *self._iteration(), self._judged()]
        else:
            for index in range(self.iterations):
                again = f"iteration {index + 1}: " if self.iterations > 1 else ""
                found += [replace(s, title=again + s.title) for s in self._iteration()]
        found.append(Section("motion at the end of the step", tuple(self._end())))
        return tuple(s for s in found if s.statements)

    def _iteration(self) -> list[Section]:
        n = self.layout.stations
        arrays = [self._at_stages(kind) for kind in KINDS]
        seeds = self._inputs_at_stages()
        over = SideBySide(self.stages, seeds, arrays).sections(self._residual_walks().sections())
        at_stages = [lane.ref(left_over(n).at())[0] for lane in self.stages]
        of_hub = [lane.ref(LEFT_AT_HUB)[0] for lane in self.stages]
        mend = {
            **self.seeds(),
            left_over(n).at(): self.combined(at_stages),
            LEFT_AT_HUB: self.combined(of_hub),
        }
        sweep = SideBySide(self.systems, mend).sections(self._mending_walks().sections())
        moving = [*self._middle_inputs(), *self._everywhere(self._motion), *self._base_motion()]
        return [
            Section("motion at the stages, and at the middle of the step", tuple(moving)),
            *over,
            *self.split(sweep),
            Section("improved accelerations of the stages", tuple(self._everywhere(self._improved))),
        ]

    # -- what moves ----------------------------------------------------------------------------------------------

    def _everywhere(self, write: Callable[[_Place, bool], list[Assign]]) -> list[Statement]:
        """Write assignments for the hub, where it moves freely, and in a loop over all stations."""
        n = self.layout.stations
        found: list[Statement] = []
        if self.layout.row.boundary == "free":
            history = {p: v.ref for p, v in self.layout.hub.items()}
            stages = tuple(v.ref for v in self.layout.hub_stages)
            trial = local("hub_trial_acceleration", "acceleration of the hub as known so far", "rad/s^2")
            found += write(_Place(history, stages, trial, hub_unknown()), True)
        history = {p: v.at() for p, v in self.layout.state.items()}
        stages = tuple(v.at() for v in self.layout.stages)
        doc = "acceleration of each link as known so far"
        trial = Variable("trial_acceleration", Role.WORK, n, doc, "rad/s^2").at()
        body = write(_Place(history, stages, trial, solved_variable(n).at()), False)
        return [*found, Loop(Order.OUTWARD, 0, n, tuple(body))]

    def _trials(self, place: _Place) -> list[Ref]:
        return [lane.ref(place.trial)[0] for lane in self.stages]

    def _ahead(self, place: _Place, base: bool) -> list[Assign]:
        del base
        rows = self.spectrum.ahead
        return [
            Assign(trial, sp.Add(*(w * a for w, a in zip(rows.row(i), place.stages, strict=True))))
            for i, trial in enumerate(self._trials(place))
        ]

    def _motion(self, place: _Place, base: bool) -> list[Assign]:
        """Write motion at the stages and at the middle by the accelerations so far."""
        found: list[Assign] = []
        trials = self._trials(place)
        weights = {
            "q": [*(self.spectrum.squared.row(i) for i in range(len(trials))), self.spectrum.middle["q"]],
            "v": [*(self.spectrum.matrix.row(i) for i in range(len(trials))), self.spectrum.middle["v"]],
            "a": [*sp.eye(len(trials)).tolist(), self.spectrum.middle["a"]],
        }
        instants = [*self.spectrum.nodes, sp.Rational(1, 2)]
        angle, rate = place.before("q"), place.before("v")
        for kind in KINDS:
            targets = [lane.of(self._at_stages(kind)) for lane in self.stages]
            for target, row, instant in zip(
                [*targets, self._at_middle(kind)], weights[kind], instants, strict=True
            ):
                gained = sp.Add(*(weight * trial for weight, trial in zip(row, trials, strict=True)))
                value = {
                    "q": angle + instant * self.step * rate + self.step**2 * gained,
                    "v": rate + self.step * gained,
                    "a": gained,
                }[kind]
                found.append(Assign(target.entry(BASE) if base else target.at(1), value))
        return found

    def _base_motion(self) -> list[Statement]:
        """Return the motion of a base that does not move freely."""
        row = self.layout.row
        found: list[Statement] = []
        if row.boundary == "free":
            return []
        for kind in KINDS:
            at_stages = [ZERO] * len(self.stages)
            middle: sp.Expr = ZERO
            if row.boundary == "prescribed":
                at_stages = [Loads(self.layout, i).prescribed[kind] for i in range(len(self.stages))]
                middle = Loads(self.layout, inputs=self._middle).prescribed[kind]
            for lane, value in zip(self.stages, at_stages, strict=True):
                found.append(Assign(lane.of(self._at_stages(kind)).entry(BASE), value))
            found.append(Assign(self._at_middle(kind).entry(BASE), middle))
        return found

    def _improved(self, place: _Place, base: bool) -> list[Assign]:
        del base
        size = len(self.stages)
        return [
            Assign(trial, trial + self.from_systems(sp.eye(size).row(i), place.solved))
            for i, trial in enumerate(self._trials(place))
        ]

    def _end(self) -> list[Statement]:
        """Take up the accelerations, and write the motion at the end of the step by them."""
        found: list[Statement] = []
        if self.layout.row.boundary == "prescribed":
            last = len(input_instants(self.layout.row, self.scheme)) - 1
            end = Loads(self.layout, last).prescribed
            found += [Assign(v.ref, end[p.kind]) for p, v in self.layout.hub.items()]
        return [*found, *self._everywhere(self._finished)]

    def _finished(self, place: _Place, base: bool) -> list[Assign]:
        trials, step = self._trials(place), self.step
        angle, rate = place.before("q"), place.before("v")
        gained = {
            kind: sp.Add(*(w * trial for w, trial in zip(weights, trials, strict=True)))
            for kind, weights in self.spectrum.ends.items()
        }
        new: dict[Kind, sp.Expr] = {
            "q": angle + step * rate + step**2 * gained["q"],
            "v": rate + step * gained["v"],
            "a": gained["a"],
        }
        history = self.layout.hub if base else self.layout.state
        found = update_assignments(history, new, lambda v: v.at(), "hub_" if base else "")
        kept = [Assign(ref, trial) for ref, trial in zip(place.stages, trials, strict=True)]
        return [*found, *(a for a in kept if a.target not in place.history.values())]

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

    def _inputs_at_stages(self) -> dict[Ref, Sequence[Pair]]:
        return {
            self.seen[given.name]: [(given.entry(i), ZERO) for i in range(len(self.stages))]
            for given in self.layout.inputs
        }

    @cached_property
    def _middle(self) -> dict[str, Ref]:
        """Inputs at the middle of the step."""
        return {
            v.name: local(f"middle_{v.name}", f"{v.name} at the middle of the step", v.unit)
            for v in self.layout.inputs
        }

    def _middle_inputs(self) -> list[Statement]:
        weights = self.spectrum.middle["a"]
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

    # -- as many iterations as it takes ----------------------------------------------------------------------------

    def _judged(self) -> Section:
        """Add up how far an iteration has turned the links.

        A simplified iteration leaves a share of what it has changed: that must be as little as an exact one would
        leave behind the change that is the last of one.
        """

        def turned(place: _Place, base: bool) -> list[Assign]:
            del base
            changes = [
                self.step**2 * self.from_systems(self.spectrum.ends[kind], place.solved)
                for kind in ("q", "v")
            ]
            return [Assign(_TURNED, _TURNED + sp.Add(*(change**2 for change in changes)))]

        return Section(
            "whether it has changed next to nothing",
            (
                Assign(_TURNED, ZERO),
                *self._everywhere(turned),
                Assign(SWEEPS.ref, SWEEPS.ref + 1),
                Until(_TURNED - LEAST_TURN.ref**4),
            ),
        )
