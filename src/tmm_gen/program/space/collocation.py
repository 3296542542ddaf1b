"""A step of an arm in space whose stages are all solved at once: simplified Newton iterations.

An iteration walks over the stages for what their equations leave over, side by side and exactly, and mends it by one
articulated sweep for each eigenvalue. Turns and rates take no part in the sweeps' slopes, which are those of the middle
of the step as first predicted: further iterations keep the factors and carry forces alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Scheme
from tmm_gen.derive.space.inward import IMBALANCE, IMPEDANCE, OWN, TORQUE
from tmm_gen.program.coupled import GAIN_OF, Coupled, seen
from tmm_gen.program.coupled_motion import Place, trial_acceleration
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.passes.side_by_side import SideBySide
from tmm_gen.program.space.base_collocation import BaseAtStages, values_at_stages
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.collocation_walks import MendingWalks, ResidualWalks
from tmm_gen.program.space.given import base_moved, given_end, given_motion
from tmm_gen.program.space.joint_laws import JointLaws
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.loads import loads_on_frames
from tmm_gen.program.space.over_stations import MOTION
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable
from tmm_gen.scene.model import MOST_SWEEPS

ONE = sp.S.One


@dataclass(frozen=True)
class SpaceCollocation:
    """Builds the sections of a coupled scheme's step.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    bodies : Bodies
        What is prepared of them.
    scheme : Scheme
        What to step with.
    iterations : int
        Of Newton's method, with the factors of the first.
    auto : bool
        Whether to iterate until that changes next to nothing instead.
    split : callable
        Takes from the sections of all iterations what is bound early.
    """

    layout: SpaceLayout
    bodies: Bodies
    scheme: Scheme
    iterations: int
    auto: bool
    split: Callable[[list[Section], Section], list[Section]]

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        base = self._base
        begun = [
            *self._everywhere(self.coupled.ahead),
            *self._given({"a": self._trial}),
            *(base.ahead() if base else ()),
        ]
        found = [Section("accelerations ahead on the last step's polynomial", tuple(begun))]
        if base:
            turning = Section("turns of the base that begin so", tuple(base.turning()))
            found += self._side_by_side.sections([turning])
        if self.auto:
            title = f"iterations, until one changes next to nothing, {MOST_SWEEPS} at most"
            found += [
                *self._iteration(first=True),
                Section(title, (Repeat(MOST_SWEEPS),)),
                *self._iteration(first=False),
                self.coupled.judged(
                    [*(base.turned() if base else ()), *self._everywhere(self.coupled.turned)]
                ),
            ]
        else:
            for index in range(self.iterations):
                again = f"iteration {index + 1}: " if self.iterations > 1 else ""
                found += [replace(s, title=again + s.title) for s in self._iteration(first=index == 0)]
        end = [*self._everywhere(self.coupled.finished), *given_end(self.layout, self.scheme)]
        finish = Section("motion at the end of the step", (*end, *(base.finished() if base else ())))
        return tuple(s for s in (*self.split(found, finish), finish) if s.statements)

    @cached_property
    def coupled(self) -> Coupled:
        """Sums over the scheme's stages."""
        return Coupled(self.scheme, self.layout.step.ref)

    # -- an iteration --------------------------------------------------------------------------------------------

    def _iteration(self, *, first: bool) -> list[Section]:
        """Return an iteration; the first leaves the factors for all others."""
        laws, over, mend = self._laws, self._over, self._mend
        moved = {kind: self._at_stages(kind) for kind in KINDS}
        at_stages = [
            # laws are linear: the first iteration brings the torques on both sides of a shaft together for good
            laws.lacking(
                over.array(TORQUE), moved, self._seen.__getitem__, over.array(IMBALANCE) if first else None
            ),
            over.outward(still=False),
            *loads_on_frames(self.layout, over, self._seen.__getitem__),
            over.left_over(),
        ]
        swept = [mend.inward(still=True) if first else mend.again(), mend.back()]
        if first:
            torque, impedance = mend.array(TORQUE), mend.array(IMPEDANCE)
            swept = [laws.impedances(impedance), laws.shared(torque), self._circles(), *swept]
        swept.append(laws.answers(mend.array(OWN), again=not first))
        where = "at the stages, and at the middle of the step" if first else "at the stages"
        base = self._base
        motion = (
            *self._everywhere(lambda place: self._motion(place, middle=first)),
            *self._given({kind: self._at_stages(kind) for kind in KINDS}),
            *(base.moved() if base else ()),
        )
        return [
            Section(f"motion {where}", motion),
            *self._side_by_side.sections(at_stages),
            self._left_over(first=first),
            *self._apart.sections(swept),
            *self._base_improved(),
            Section("improved accelerations of the stages", tuple(self._everywhere(self.coupled.improved))),
        ]

    def _base_improved(self) -> list[Section]:
        """Take up what the systems find a base that floats to do."""
        if self._base is None:
            return []
        taken = Section("improved accelerations of the base", tuple(self._base.improved()))
        given = Section("in its axes at each stage", tuple(self._base.given()))
        return [given, *self._side_by_side.sections([taken])]

    def _left_over(self, *, first: bool) -> Section:
        """Put together for each system what torques joints, and first of all shafts, lack at the stages."""
        body = self.coupled.left_over(self._over.array(IMBALANCE).at(), self._mend.array(TORQUE).at())
        stations = self.layout.stations
        stretches = [(0, stations)] if first else self.layout.tree.stretches
        loops = tuple(Loop(Order.OUTWARD, start, stop, tuple(body)) for start, stop in stretches)
        of_base = self._base.left_over() if self._base else ()
        return Section("what joints lack, in the system of each eigenvalue", (*loops, *of_base))

    def _circles(self) -> Section:
        """Return what sets the sines by which the sweeps go."""
        return self._mend.circles()

    @cached_property
    def _seen(self) -> dict[str, Ref]:
        return seen(self.layout.inputs)

    @cached_property
    def _side_by_side(self) -> SideBySide:
        """What has a value at each stage."""
        given = self.coupled.inputs_at_stages(self.layout.inputs, self._seen)
        of_base = self._base.at_stages if self._base else ()
        variables = [*(self._at_stages(kind) for kind in KINDS), *of_base]
        return SideBySide(self.coupled.stages, given, variables)

    @cached_property
    def _apart(self) -> SideBySide:
        """What has a value in the system of each eigenvalue."""
        forces = [ref.variable for ref in self._base.forces] if self._base else []
        return SideBySide(self.coupled.systems, self.coupled.gains(), [self._mend.array(TORQUE), *forces])

    @cached_property
    def _laws(self) -> JointLaws:
        return JointLaws(self.layout, {**GAIN_OF, "a": ONE})

    @cached_property
    def _over(self) -> ResidualWalks:
        layout = self.layout
        base = values_at_stages(layout.base) if layout.base else base_moved(layout, self._seen.__getitem__)
        motion = {MOTION[kind]: self._at_stages(kind) for kind in KINDS}
        gains = (sp.S.Zero, sp.S.Zero, ONE)
        return ResidualWalks(self.layout, self.bodies, motion, gains, self._laws.absent, base=base)

    @cached_property
    def _base(self) -> BaseAtStages | None:
        base = self.layout.base
        return BaseAtStages(base, self.coupled, self._over, self._mend) if base else None

    @cached_property
    def _mend(self) -> MendingWalks:
        absent = self._laws.absent - {TORQUE}
        motion = {MOTION["q"]: self._middle}
        return MendingWalks(self.layout, self.bodies, motion, (*GAIN_OF.values(), ONE), absent)

    # -- what moves ----------------------------------------------------------------------------------------------

    def _everywhere(self, write: Callable[[Place], list[Assign]]) -> list[Statement]:
        """Write assignments in a loop over all stations."""
        layout, found = self.layout, self._mend.array(OWN).at()
        body = write(Place(layout.state, layout.stages, self._trial.at(), found))
        return [Loop(Order.OUTWARD, 0, layout.stations, tuple(body))]

    def _motion(self, place: Place, *, middle: bool) -> list[Assign]:
        """Write motion at the stages, and the angle at the middle, by the accelerations so far."""
        found: list[Assign] = []
        for kind in KINDS:
            at_stages = [lane.of(self._at_stages(kind)).at() for lane in self.coupled.stages]
            at_middle = self._middle.at() if middle and kind == "q" and not self.coupled.spare else None
            found += self.coupled.moved(place, kind, at_stages, at_middle)
        return found

    def _given(self, motion: Mapping[Kind, Variable]) -> list[Assign]:
        """Set motion at the stages where it is given, by its arrays."""
        found: list[Assign] = []
        for index, lane in enumerate(self.coupled.stages):

            def value(name: str, index: int = index) -> sp.Expr:
                return self.coupled.at_stages(lambda instant: self.layout.input(name, instant))[index]

            found += given_motion(self.layout, {k: lane.of(v) for k, v in motion.items()}, value)
        return found

    @cached_property
    def _trial(self) -> Variable:
        return trial_acceleration("each joint", self.layout.stations).variable

    def _at_stages(self, kind: Kind) -> Variable:
        name, unit = MOTION_NAMES[kind]
        doc = f"{name} of each joint as predicted"
        return Variable(f"predicted_{name}", Role.WORK, self.layout.stations, doc, unit)

    @cached_property
    def _middle(self) -> Variable:
        doc = "angle of each joint at the middle of the step"
        return Variable("middle_angle", Role.WORK, self.layout.stations, doc, "rad")
