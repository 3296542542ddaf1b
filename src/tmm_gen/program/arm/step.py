"""One step of a row: per stage, the motion before the sweep, the sweep, and what it has found taken up."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from functools import partial

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Scheme, stage
from tmm_gen.derive.integrators.relations import AffineMotion, Unknown, affine_motion
from tmm_gen.derive.station.frame import GAINS, Frame
from tmm_gen.program.arm.at_places import BASE, hub_unknown, prescribed_unknown, solved_variable
from tmm_gen.program.arm.correction import Correction
from tmm_gen.program.arm.floating import Floating
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.loads import Loads
from tmm_gen.program.arm.motion import (
    KNOWN_RATE,
    Held,
    Moving,
    StageOf,
    StartingPoint,
    motion_variable,
    starting_point,
)
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.motion import kept_stage_values, stage_variable, update_assignments
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Ref, Variable

MakeWalks = Callable[..., Walks]


@dataclass(frozen=True)
class StepBuilder:
    """Builds the sections of one scheme's step.

    Parameters
    ----------
    layout : Layout
        The row's variables.
    prepared : mapping from str to Variable
        Combinations of parameters.
    scheme : Scheme
        What to step with.
    unknown : str
        What the sweep solves for.
    sources, hub_sources : mapping from sympy.Symbol to sympy.Expr
        Where history is read from.
    base_sources : mapping from str to mapping from sympy.Symbol to sympy.Expr
        The same of the place of a base that floats, by coordinate.
    iterations : int
        Sweeps per stage.
    corrections : int
        Behind the last of them, with its factors.
    split : callable
        Takes from a sweep's sections what is bound early.
    walks : callable
        Makes the walks of a sweep.
    """

    layout: Layout
    prepared: Mapping[str, Variable]
    scheme: Scheme
    unknown: Unknown
    sources: Mapping[sp.Symbol, sp.Expr]
    hub_sources: Mapping[sp.Symbol, sp.Expr]
    base_sources: Mapping[str, Mapping[sp.Symbol, sp.Expr]]
    iterations: int = 1
    corrections: int = 0
    split: Callable[[list[Section]], list[Section]] = list
    walks: MakeWalks = Walks

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        count, about = len(self.scheme.stages), self.layout.row.about
        motions = [affine_motion(self.scheme, i + 1, self.unknown) for i in range(count)]
        points = [
            starting_point(motion, i, about, held=self._predicts_held) for i, motion in enumerate(motions)
        ]
        kept = kept_stage_values(
            self.scheme, {(i, k): p.values[k] for i, p in enumerate(points) for k in KINDS}
        )
        sections: list[Section] = []
        for index, (motion, point) in enumerate(zip(motions, points, strict=True), start=1):
            title = f"Stage {index} of {count}: " if count > 1 else ""
            walks = self._walks(index, motion, point)
            before = "predicted motion" if about == "prediction" else "motion known before the sweep"
            begun = Section(title + before, tuple(self._begin(index, motion, point)))
            sections += self._swept(title, begun, walks, motion)
            sections.append(self._finish(title, index, motion, point, walks, kept, last=index == count))
        return tuple(s for s in sections if s.statements)

    def _swept(self, title: str, begun: Section, walks: Walks, motion: AffineMotion) -> list[Section]:
        """Return the sweeps of a stage, each from what the one before has found, and what corrects the last."""
        if self.corrections:  # only who sees the whole stage can tell what in it is bound early
            swept = walks.sections(partial(self._corrected, walks, motion))
            return self.split([begun, *(replace(s, title=title + s.title) for s in swept)])
        found = [begun]
        for iteration in range(1, self.iterations + 1):
            again = f"iteration {iteration}: " if self.iterations > 1 else ""
            found += [Section(title + again + s.title, s.statements) for s in self.split(walks.sections())]
            if iteration < self.iterations:
                found.append(Section(title + again + "improved prediction", tuple(self._improve(motion))))
        return found

    def _corrected(self, walks: Walks, motion: AffineMotion) -> list[Section]:
        """Return what follows a stage's first sweep: further ones, and corrections of what the last has found."""
        found: list[Section] = []
        still = walks.frame.still
        again = [f"iteration {k}" for k in range(2, self.iterations + 1)]
        for word in (*again, *(f"correction {k}" for k in range(1, self.corrections + 1))):
            next_walks = walks
            if word not in again:
                next_walks = Correction(walks, {k: self._motion(k) for k in KINDS})
            so_far = Section("motion as found so far", tuple(self._improve(motion, still)))
            found += [replace(s, title=f"{word}: {s.title}") for s in (so_far, *next_walks.plain())]
            still = frozenset()
        return found

    @property
    def _predicts_held(self) -> bool:
        """Whether a stage is predicted with the newest acceleration instead of none.

        A prediction without acceleration forgives long steps, and a correction makes up for it; a sweep alone, and
        stages that follow others, would lose digits.
        """
        return self.corrections == 0 or self.iterations > 1 or len(self.scheme.stages) > 1

    def _stays(self) -> bool:
        """Whether motion before the sweep stays what it was until the step ends."""
        return self.iterations == 1 and self.corrections == 0

    # -- before the sweep --------------------------------------------------------------------------------------

    def _walks(self, index: int, motion: AffineMotion, point: StartingPoint) -> Walks:
        row = self.layout.row
        gain = tuple(motion.gain[k] if motion.gain[k].is_number else GAINS[k] for k in KINDS)
        still = self._still(point)
        frame = Frame(row.coordinates, gain, still, row.about, row.sign, corrected=self.corrections > 0)
        gains = {GAINS[k]: self._gain(motion, k) for k in KINDS}
        known = self._moving(index, point)
        stage_of = StageOf(self.scheme, index, motion, self.sources)
        loads = Loads(self.layout, index - 1)
        return self.walks(self.layout, self.prepared, frame, gains, known, loads, stage_of)

    def _moving(self, index: int, point: StartingPoint) -> dict[Kind, Moving]:
        """Return where the motion of nodes before the sweep is held."""
        still = self._still(point)
        found: dict[Kind, Moving] = {k: self._motion(k) for k in KINDS if k not in still}
        if not self._stays() or "a" in still or self.layout.row.reads_inner_acceleration:
            return found
        stands = point.values["a"].xreplace(self._values("", self.layout.stations))
        if isinstance(stands, Ref):
            base = sp.Integer(0)
            if self._free:
                base = point.values["a"].xreplace(self._values("hub_", None))
            elif not self._held:
                base = Loads(self.layout, index - 1).prescribed["a"]
            found["a"] = Held(stands, base)
        return found

    def _still(self, point: StartingPoint) -> frozenset[str]:
        """Return the kinds of motion that are zero before the sweep, at the base too where stations read it there."""
        led = self.layout.row.boundary == "prescribed" and self.layout.row.reads_inner_acceleration
        return frozenset() if led and self.layout.row.about == "prediction" else point.still

    def _gain(self, motion: AffineMotion, kind: Kind) -> sp.Expr:
        return motion.gain[kind].xreplace({STEP: self.layout.step.ref})

    def _motion(self, kind: Kind) -> Variable:
        return motion_variable(kind, self.layout.row.about, self.layout.stations)

    def _begin(self, index: int, motion: AffineMotion, point: StartingPoint) -> list[Statement]:
        n = self.layout.stations
        at_links, at_hub = self._values("", n), self._values("hub_", None)
        rate = self._motion("v")
        body, base = [], []
        moving = self._moving(index, point)
        for kind in ("v", "q", "a"):  # rates first: displacements may be written by them
            value, variable = point.values[kind], moving.get(kind)
            if not isinstance(variable, Variable):
                continue
            body.append(Assign(variable.at(1), value.xreplace({**at_links, KNOWN_RATE: rate.at(1)})))
            moved = sp.Integer(0)
            if self._free:
                moved = value.xreplace({**at_hub, KNOWN_RATE: rate.entry(BASE)})
            elif not self._held:
                moved = self._prescribed(index, motion, point, kind)
            base.append(Assign(variable.entry(BASE), moved))
        begun = self._floating.begin(index)
        return [*begun, *base, Loop(Order.OUTWARD, 0, n, tuple(body))] if body else begun

    def _prescribed(self, index: int, motion: AffineMotion, point: StartingPoint, kind: Kind) -> sp.Expr:
        """Return what a prescribed base's unknown leaves of its motion."""
        loads = Loads(self.layout, index - 1)
        return loads.prescribed[kind] - self._gain(motion, kind) * prescribed_unknown(point.still, loads)

    @property
    def _held(self) -> bool:
        return self.layout.row.boundary == "held"

    @property
    def _floating(self) -> Floating:
        return Floating(self.layout, self.scheme, self.base_sources, held=self._predicts_held)

    @property
    def _free(self) -> bool:
        return self.layout.row.boundary == "free"

    def _improve(self, motion: AffineMotion, still: Collection[str] = ()) -> list[Statement]:
        """Take up what a sweep has found; ``still`` is what was zero before it."""
        n = self.layout.stations
        solved, hub = solved_variable(n), hub_unknown()
        body, base = [], []
        for kind in KINDS:
            gain = self._gain(motion, kind)
            ref, entry = self._motion(kind).at(1), self._motion(kind).entry(BASE)
            began = kind in still
            body.append(Assign(ref, (0 if began else ref) + gain * solved.at()))
            base.append(Assign(entry, (0 if began else entry) + gain * hub))
        moved: list[Statement] = [*self._floating.improve(), *base] if self._free else []
        if self._held and self.layout.row.reads_inner_acceleration:
            moved = [Assign(self._motion(kind).entry(BASE), sp.Integer(0)) for kind in KINDS if kind in still]
        return [*moved, Loop(Order.OUTWARD, 0, n, tuple(a for a in body if a.value != a.target))]

    def _values(self, prefix: str, length: int | None) -> dict[sp.Symbol, sp.Expr]:
        earlier = range(1, len(self.scheme.stages))
        stages = {stage(k, i): stage_variable(k, i, prefix, length).at() for k in KINDS for i in earlier}
        return {STEP: self.layout.step.ref, **(self.hub_sources if prefix else self.sources), **stages}

    # -- after the sweep ---------------------------------------------------------------------------------------

    def _finish(
        self,
        title: str,
        index: int,
        motion: AffineMotion,
        point: StartingPoint,
        walks: Walks,
        kept: frozenset[tuple[Kind, int]],
        *,
        last: bool,
    ) -> Section:
        n = self.layout.stations
        moving = self._moving(index, point)
        if self.corrections:
            moving = {k: self._motion(k) for k in KINDS}
        links, hub = self._solved_motion(motion, moving)
        statements: list[Statement] = self._found_of_base()
        if not last:
            statements += self._floating.keep(index)
            mine = sorted((k, i) for k, i in kept if i == index)
            if self._free:
                statements += [Assign(stage_variable(k, i, "hub_", None).ref, hub[k]) for k, i in mine]
            if mine:
                body = tuple(Assign(stage_variable(k, i, "", n).at(), links[k]) for k, i in mine)
                statements.append(Loop(Order.OUTWARD, 0, n, body))
            return Section(title + "motion at this stage", tuple(statements))
        if self._free:
            new = self._new_values(index, hub, self._values("hub_", None))
            statements += update_assignments(self.layout.hub, new, lambda v: v.ref, "")
        elif not self._held:
            end = Loads(self.layout, len(input_instants(self.layout.row, self.scheme)) - 1).prescribed
            statements += [Assign(v.ref, end[p.kind]) for p, v in self.layout.hub.items()]
        statements += self._floating.finish()
        new = self._new_values(index, links, self._values("", n))
        statements.append(
            Loop(Order.OUTWARD, 0, n, tuple(update_assignments(self.layout.state, new, lambda v: v.at(), "")))
        )
        places = walks.after_update()
        return Section(title + "motion at the end of the step", (*places, *statements))

    def _found_of_base(self) -> list[Statement]:
        """Take up what the last sweep has found of a base that floats."""
        return self._floating.improve()

    def _solved_motion(
        self, motion: AffineMotion, moving: dict[Kind, Moving]
    ) -> tuple[dict[Kind, sp.Expr], dict[Kind, sp.Expr]]:
        """Return the motion of stations and base at a stage: that before the sweep, and what the sweep found."""
        n, zero = self.layout.stations, sp.Integer(0)
        links = {
            k: (moving[k].at(1) if k in moving else zero) + self._gain(motion, k) * solved_variable(n).at()
            for k in KINDS
        }
        hub = {
            k: (moving[k].entry(BASE) if k in moving else zero) + self._gain(motion, k) * hub_unknown()
            for k in KINDS
        }
        return links, hub

    def _new_values(
        self, index: int, values: Mapping[Kind, sp.Expr], at: Mapping[sp.Symbol, sp.Expr]
    ) -> dict[Kind, sp.Expr]:
        own = {stage(k, index): values[k] for k in KINDS}
        return {k: sp.expand(sp.sympify(self.scheme.update[k]).xreplace({**own, **at})) for k in KINDS}
