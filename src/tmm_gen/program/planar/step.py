"""One step of a planar arm: per stage, predict, sweep, and take up what the sweep found.

This is the linearisation called ``newton``: the exact equations linearised about the predicted angle, rate and
acceleration of each link. Each further iteration linearises about the result of the one before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, past, stage
from tmm_gen.derive.integrators.relations import AffineMotion, affine_motion
from tmm_gen.program.inputs import prescribed_end
from tmm_gen.program.motion import history_values, kept_stage_values, stage_variable, update_assignments
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.planar.scratch import BASE, HUB_UNKNOWN, predicted, solved
from tmm_gen.program.planar.sweep import PlanarSweep
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement


@dataclass(frozen=True)
class PlanarStep(PlanarSweep):
    """Builds the sections of one scheme's step; fields are those of :class:`PlanarSweep`."""

    def sections(self) -> tuple[Section, ...]:
        """Return the whole step."""
        count = len(self.scheme.stages)
        motions = [affine_motion(self.scheme, i + 1, self.unknown) for i in range(count)]
        predictions = [predicted_motion(motion, i) for i, motion in enumerate(motions)]
        kept = kept_stage_values(
            self.scheme, {(i, k): p[k] for i, p in enumerate(predictions) for k in KINDS}
        )
        sections: list[Section] = []
        for index, (motion, prediction) in enumerate(zip(motions, predictions, strict=True), start=1):
            title = f"Stage {index} of {count}: " if count > 1 else ""
            sections.append(Section(title + "predicted motion", tuple(self._predict(index, prediction))))
            sections += self._swept(title, index, motion)
            sections.append(self._finish(title, index, motion, kept, last=index == count))
        return tuple(s for s in sections if s.statements)

    def _swept(self, title: str, index: int, motion: AffineMotion) -> list[Section]:
        """Return the sweeps of a stage, each from what the one before has found."""
        sections: list[Section] = []
        for iteration in range(self.iterations):
            again = f"iteration {iteration + 1}: " if self.iterations > 1 else ""
            sections += [
                Section(title + again + s.title, s.statements) for s in self._sweep(index, iteration, motion)
            ]
            if iteration + 1 < self.iterations:
                sections.append(Section(title + again + "improved prediction", tuple(self._improve(motion))))
        return sections

    # -- prediction ----------------------------------------------------------------------------------------

    def _predict(self, index: int, prediction: Mapping[Kind, sp.Expr]) -> list[Statement]:
        n = self.layout.stations
        prescribed = self.loads[index - 1].motion
        at_links, at_hub = self._values("", n), self._values("hub_", None)
        body, base = [], []
        for kind in KINDS:
            variable = predicted(kind, n)
            body.append(Assign(variable.at(1), prediction[kind].xreplace(at_links)))
            moved = prediction[kind].xreplace(at_hub) if self.base == "motor" else sp.Integer(0)
            value = prescribed.get(kind, moved)
            base.append(Assign(variable.entry(BASE), value))
        return [*base, Loop(Order.OUTWARD, 0, n, tuple(body))]

    def _improve(self, motion: AffineMotion) -> list[Statement]:
        n = self.layout.stations
        body, base = [], []
        for kind in KINDS:
            gain = self._gain(motion, kind)
            ref, entry = predicted(kind, n).at(1), predicted(kind, n).entry(BASE)
            body.append(Assign(ref, ref + gain * solved(n).at()))
            base.append(Assign(entry, entry + gain * HUB_UNKNOWN))
        moved = base if self.base == "motor" else []
        return [*moved, Loop(Order.OUTWARD, 0, n, tuple(a for a in body if a.value != a.target))]

    def _values(self, prefix: str, length: int | None) -> dict[sp.Symbol, sp.Expr]:
        earlier = range(1, len(self.scheme.stages))
        stages = {stage(k, i): stage_variable(k, i, prefix, length).at() for k in KINDS for i in earlier}
        return {STEP: self.layout.step.ref, **(self.hub_sources if prefix else self.sources), **stages}

    # -- after the sweep -----------------------------------------------------------------------------------

    def _finish(
        self, title: str, index: int, motion: AffineMotion, kept: frozenset[tuple[Kind, int]], *, last: bool
    ) -> Section:
        n = self.layout.stations
        links, hub = self._solved_motion(motion)
        hubbed = self.base == "motor"
        statements: list[Statement] = []
        if not last:
            mine = sorted((k, i) for k, i in kept if i == index)
            if hubbed:
                statements += [Assign(stage_variable(k, i, "hub_", None).ref, hub[k]) for k, i in mine]
            if mine:
                body = tuple(Assign(stage_variable(k, i, "", n).at(), links[k]) for k, i in mine)
                statements.append(Loop(Order.OUTWARD, 0, n, body))
            return Section(title + "motion at this stage", tuple(statements))
        if hubbed:
            new = self._new_values(index, hub, self._values("hub_", None))
            statements += update_assignments(self.layout.hub, new, lambda v: v.ref, "")
        statements += prescribed_end(self.layout.hub, self.loads[-1].motion)
        new = self._new_values(index, links, self._values("", n))
        body = tuple(update_assignments(self.layout.state, new, lambda v: v.at(), ""))
        places = self._after_update(index, motion)
        statements.append(Loop(Order.OUTWARD, 0, n, body))
        return Section(title + "motion at the end of the step", (*places, *statements))

    def _solved_motion(self, motion: AffineMotion) -> tuple[Mapping[Kind, sp.Expr], Mapping[Kind, sp.Expr]]:
        """Return the motion of links and hub at a stage: the prediction and what the last sweep found."""
        n = self.layout.stations
        links = {k: predicted(k, n).at(1) + self._gain(motion, k) * solved(n).at() for k in KINDS}
        hub = {k: predicted(k, n).entry(BASE) + self._gain(motion, k) * HUB_UNKNOWN for k in KINDS}
        return links, hub

    def _new_values(
        self, index: int, values: Mapping[Kind, sp.Expr], at: Mapping[sp.Symbol, sp.Expr]
    ) -> dict[Kind, sp.Expr]:
        own = {stage(k, index): values[k] for k in KINDS}
        return {k: sp.expand(sp.sympify(self.scheme.update[k]).xreplace({**own, **at})) for k in KINDS}

    # -- what other linearisations do otherwise ------------------------------------------------------------

    def _after_update(self, index: int, motion: AffineMotion) -> list[Statement]:
        """Return updates of other states than angles; they read the history before it ages."""
        return []


def predicted_motion(motion: AffineMotion, index: int) -> dict[Kind, sp.Expr]:
    """Return the motion of a stage (from 0) if its acceleration were that of the instant solved before it."""
    latest = stage("a", index) if index else past("a")
    guess = (latest - motion.offset["a"]) / motion.gain["a"]
    return {k: sp.expand(motion.offset[k] + motion.gain[k] * guess) for k in KINDS}


def planar_history(layout: PlanarLayout) -> tuple[dict[sp.Symbol, sp.Expr], dict[sp.Symbol, sp.Expr]]:
    """Return where the history of links and hub is read from during a step."""
    return (
        history_values(layout.state, lambda v: v.at()),
        history_values(layout.hub, lambda v: v.ref),
    )
