"""One step of an arm in space: per stage a prediction, an articulated sweep, and corrections that carry forces."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Scheme, stage
from tmm_gen.derive.integrators.relations import AffineMotion, affine_motion
from tmm_gen.derive.space.inward import IMPEDANCE, OWN, TORQUE
from tmm_gen.program.arm.motion import KNOWN_RATE, StartingPoint, starting_point
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.motion import kept_stage_values, stage_variable, update_assignments
from tmm_gen.program.space.base import BaseStep, gains_of
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.given import base_moved, given_end, given_motion
from tmm_gen.program.space.joint_laws import JointLaws
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.loads import loads_on_frames
from tmm_gen.program.space.over_stations import MOTION
from tmm_gen.program.space.walks import SpaceWalks
from tmm_gen.program.statements import Assign, Loop, Order, Repeat, Section, Statement, Until
from tmm_gen.program.sweeps import LEAST_TURN, SWEEPS
from tmm_gen.program.variables import Role, Variable, local
from tmm_gen.scene.model import MOST_SWEEPS

_TURNED = local("turned", "sum of squares of what this correction changes angles by", "rad^2")


@dataclass(frozen=True)
class SpaceStep:
    """Builds the sections of one scheme's step.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    bodies : Bodies
        What is prepared of them.
    scheme : Scheme
        What to step with.
    sources : mapping from sympy.Symbol to sympy.Expr
        Where history is read from.
    iterations : int
        One sweep and so many less one corrections per stage.
    held : bool
        Whether a stage is predicted with the newest acceleration; otherwise with none.
    auto : bool
        Whether corrections go on until one changes next to nothing.
    exact : bool
        Whether all sweeps are Newton's own; then there are no corrections but further sweeps.
    split : callable
        Takes from a sweep's sections what is bound early.
    base : BaseStep or None
        Of a base that floats.
    """

    layout: SpaceLayout
    bodies: Bodies
    scheme: Scheme
    sources: Mapping[sp.Symbol, sp.Expr]
    iterations: int = 1
    held: bool = False
    auto: bool = False
    exact: bool = False
    split: Callable[[list[Section], Section], list[Section]] = lambda sections, _: sections
    base: BaseStep | None = None

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        count = len(self.scheme.stages)
        motions = [affine_motion(self.scheme, i + 1, "acceleration") for i in range(count)]
        points = [self._predicted(motion, i) for i, motion in enumerate(motions)]
        kept = kept_stage_values(
            self.scheme, {(i, k): p.values[k] for i, p in enumerate(points) for k in KINDS}
        )
        sections: list[Section] = []
        for index, (motion, point) in enumerate(zip(motions, points, strict=True), start=1):
            title = f"Stage {index} of {count}: " if count > 1 else ""
            finish = self._finish(title, index, motion, kept, last=index == count)
            sections += [*self._swept(title, index, motion, point, finish), finish]
        return tuple(s for s in sections if s.statements)

    def _predicted(self, motion: AffineMotion, index: int) -> StartingPoint:
        if self.held:
            return starting_point(motion, index, "prediction")
        return starting_point(motion, index, "known")

    # -- the sweep -----------------------------------------------------------------------------------------

    def _swept(
        self, title: str, index: int, motion: AffineMotion, point: StartingPoint, finish: Section
    ) -> list[Section]:
        gains = {k: self._gain(motion, k) for k in KINDS}
        laws, read = JointLaws(self.layout, gains), self._read(index)
        walks = SpaceWalks(
            self.layout,
            self.bodies,
            {MOTION[k]: self._motion(k) for k in KINDS},
            tuple(gains.values()),
            laws.absent,
            exact=self.exact,
            base=self.base.values if self.base else base_moved(self.layout, read),
        )
        still = "a" in point.still
        begun = self.base.begin(point) if self.base else []
        first = [
            Section(
                "predicted motion",
                (*begun, self._begin(point), *self._given(index)),
            ),
            laws.impedances(walks.array(IMPEDANCE)),
            self._torques(laws, index, walks, point.still),
            walks.outward(still=still),
            *loads_on_frames(self.layout, walks, read),
            walks.inward(still=still),
            walks.back(still=still),
            laws.answers(walks.array(OWN), again=False),
        ]
        if self.auto:
            rounds = f"corrections, until one changes next to nothing, {MOST_SWEEPS} at most"
            found = [
                *self._cleared(still),
                *first,
                Section(rounds, (Repeat(MOST_SWEEPS),)),
                *self._correction(index, motion, laws, walks, still=False),
                self._judged(motion, walks),
            ]
        else:
            found = list(first)
            for number in range(1, self.iterations):
                mine = self._correction(index, motion, laws, walks, still=still and number == 1)
                word = f"sweep {number + 1}" if self.exact else f"correction {number}"
                found += [Section(f"{word}: {s.title}", s.statements) for s in mine]
        # all at once, prediction too: what is bound early shows only where everything that is set is seen
        return [Section(title + s.title, s.statements) for s in self.split(found, finish)]

    def _correction(
        self, index: int, motion: AffineMotion, laws: JointLaws, walks: SpaceWalks, *, still: bool
    ) -> list[Section]:
        """Return one correction; ``still`` where nothing was predicted of accelerations before it."""
        return [
            Section(
                "improved prediction",
                (
                    *self._moved(motion, still=still),
                    self._improve(motion, still=still),
                    *self._given(index),
                ),
            ),
            laws.moved_torques(walks.array(TORQUE), walks.array(IMPEDANCE), walks.array(OWN)),
            walks.outward(still=False),
            *loads_on_frames(self.layout, walks, self._read(index)),
            walks.inward(still=False) if self.exact else walks.again(),
            walks.back(still=False),
            laws.answers(walks.array(OWN), again=True),
        ]

    def _cleared(self, still: bool) -> list[Section]:
        """Let the acceleration be zero where a round of corrections adds to it."""
        if not still:
            return []
        target = self._motion("a").at()
        loop = Loop(Order.OUTWARD, 0, self.layout.stations, (Assign(target, sp.Integer(0)),))
        of_base = self.base.cleared() if self.base else []
        return [Section("predicted without acceleration", (*of_base, loop))]

    def _moved(self, motion: AffineMotion, *, still: bool) -> list[Statement]:
        """Take up what a sweep has found a base that floats to do."""
        return self.base.improve(gains_of(motion, self.layout.step), still=still) if self.base else []

    def _torques(self, laws: JointLaws, index: int, walks: SpaceWalks, still: frozenset[str]) -> Section:
        moved = {k: self._motion(k) for k in KINDS if k not in still}
        return laws.torques(walks.array(TORQUE), moved, self._read(index))

    def _given(self, index: int) -> list[Assign]:
        """Set the motion of joints at a stage, from 1, where it is given."""
        motion = {kind: self._motion(kind) for kind in KINDS}
        return given_motion(self.layout, motion, lambda name: self.layout.input(name, index - 1))

    def _read(self, index: int) -> Callable[[str], sp.Expr]:
        """Return how inputs are read at a stage, from 1, by their columns."""
        return lambda column: self.layout.input(column, index - 1)

    # -- motion ---------------------------------------------------------------------------------------------

    def _gain(self, motion: AffineMotion, kind: Kind) -> sp.Expr:
        return motion.gain[kind].xreplace({STEP: self.layout.step.ref})

    def _motion(self, kind: Kind) -> Variable:
        name, unit = MOTION_NAMES[kind]
        doc = f"{name} of each joint as predicted"
        return Variable(f"predicted_{name}", Role.WORK, self.layout.stations, doc, unit)

    def _begin(self, point: StartingPoint) -> Loop:
        at = self._values()
        body = []
        for kind in ("v", "q", "a"):  # rates first: displacements may be written by them
            if kind in point.still:
                continue
            known = {**at, KNOWN_RATE: self._motion("v").at()}
            body.append(Assign(self._motion(kind).at(), point.values[kind].xreplace(known)))
        return Loop(Order.OUTWARD, 0, self.layout.stations, tuple(body))

    def _improve(self, motion: AffineMotion, *, still: bool) -> Loop:
        found = Variable(OWN.name, Role.WORK, self.layout.stations, *_OWN_DOC).at()
        body = []
        for kind in KINDS:
            target = self._motion(kind).at()
            before = sp.Integer(0) if still and kind == "a" else target
            value = before + self._gain(motion, kind) * found
            if value != target:
                body.append(Assign(target, value))
        return Loop(Order.OUTWARD, 0, self.layout.stations, tuple(body))

    def _judged(self, motion: AffineMotion, walks: SpaceWalks) -> Section:
        """Add up how far the correction has turned the joints; a changed rate counts by what it turns in a step."""
        turn, rate = self._gain(motion, "q"), self._gain(motion, "v") * self.layout.step.ref
        weight = sp.expand(turn**2 + rate**2)
        found = walks.array(OWN).at()
        return Section(
            "whether it has changed next to nothing",
            (
                Assign(_TURNED, sp.Integer(0)),
                Loop(Order.OUTWARD, 0, self.layout.stations, (Assign(_TURNED, _TURNED + weight * found**2),)),
                Assign(SWEEPS.ref, SWEEPS.ref + 1),
                Until(_TURNED - LEAST_TURN.ref**2),
            ),
        )

    def _values(self) -> dict[sp.Symbol, sp.Expr]:
        n = self.layout.stations
        earlier = range(1, len(self.scheme.stages))
        stages = {stage(k, i): stage_variable(k, i, "", n).at() for k in KINDS for i in earlier}
        return {STEP: self.layout.step.ref, **self.sources, **stages}

    def _finish(
        self,
        title: str,
        index: int,
        motion: AffineMotion,
        kept: frozenset[tuple[Kind, int]],
        *,
        last: bool,
    ) -> Section:
        n = self.layout.stations
        found = Variable(OWN.name, Role.WORK, n, *_OWN_DOC).at()
        still = not self.held and self.iterations == 1 and not self.auto
        point = self._predicted(motion, index - 1)
        values: dict[Kind, sp.Expr] = {}
        for kind in KINDS:
            gone = kind in point.still and (kind != "a" or still)
            before = sp.Integer(0) if gone else self._motion(kind).at()
            values[kind] = before + self._gain(motion, kind) * found
        of_base = self._moved(motion, still="a" in point.still and still)
        if not last:
            if self.base:
                of_base += self.base.keep(index, kept)
            mine = sorted((k, i) for k, i in kept if i == index)
            body = [Assign(stage_variable(k, i, "", n).at(), values[k]) for k, i in mine]
            loops = (Loop(Order.OUTWARD, 0, n, tuple(body)),) if body else ()
            return Section(title + "motion at this stage", (*of_base, *loops))
        own = {stage(k, index): values[k] for k in KINDS}
        at = self._values()
        new = {k: sp.expand(sp.sympify(self.scheme.update[k]).xreplace({**own, **at})) for k in KINDS}
        body = update_assignments(self.layout.state, new, lambda v: v.at(), "")
        if self.base:
            of_base += self.base.finish()
        loop = Loop(Order.OUTWARD, 0, n, tuple(body))
        return Section(
            title + "motion at the end of the step", (*of_base, loop, *given_end(self.layout, self.scheme))
        )


_OWN_DOC = ("what the sweep finds each joint to do", "rad/s^2")
