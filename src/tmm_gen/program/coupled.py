"""Sums over stages that are solved at once: what they make in the systems of their eigenvalues, and how joints move."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind, Scheme
from tmm_gen.derive.integrators.spectrum import Spectrum, fraction, spectrum_of
from tmm_gen.program.coupled_motion import Place
from tmm_gen.program.motion import update_assignments
from tmm_gen.program.passes.side_by_side import ZERO, Lane, Pair
from tmm_gen.program.statements import Assign, Section, Statement, Until
from tmm_gen.program.sweeps import LEAST_TURN, SWEEPS
from tmm_gen.program.variables import Ref, Role, Variable, local

HALF = sp.Rational(1, 2)
GAIN_OF: dict[Kind, Ref] = {
    "q": local("angle_gain", "angle per unknown", "s^2"),
    "v": local("rate_gain", "rate per unknown", "s"),
}
"""What stands for the gains of each system while its sweep is written."""
_TURNED = local("turned", "sum of squares of what this iteration changes angles by", "rad^2")


@dataclass(frozen=True)
class Coupled:
    """A coupled scheme and the step it takes.

    Parameters
    ----------
    scheme : Scheme
        Whose stages are solved at once.
    step : Ref
        The time step.
    """

    scheme: Scheme
    step: Ref

    @property
    def spare(self) -> bool:
        """Whether what is at the stages has the middle of the step with it."""
        return False

    @cached_property
    def spectrum(self) -> Spectrum:
        """Numbers of the scheme."""
        return spectrum_of(self.scheme)

    @cached_property
    def systems(self) -> tuple[Lane, ...]:
        """One for each eigenvalue."""
        found = []
        for index, (re, im) in enumerate(self.spectrum.values, start=1):
            complex_ = im != 0
            words = f"system of {'complex' if complex_ else 'real'} eigenvalue {index}"
            found.append(Lane(f"_system{index}", words, (re, im) if complex_ else None))
        return tuple(found)

    @cached_property
    def stages(self) -> tuple[Lane, ...]:
        """One for each stage."""
        count = range(1, len(self.spectrum.nodes) + 1)
        return tuple(Lane(f"_stage{index}", f"at stage {index}") for index in count)

    def gains(self) -> dict[Ref, list[Pair]]:
        """Return the gains of each system."""
        values = self.spectrum.values
        return {
            GAIN_OF["v"]: [(self.step * re, self.step * im) for re, im in values],
            GAIN_OF["q"]: [
                (self.step**2 * fraction(re**2 - im**2), self.step**2 * fraction(2 * re * im))
                for re, im in values
            ],
        }

    def combined(self, at_stages: Sequence[sp.Expr]) -> list[Pair]:
        """Return what values at the stages make in each system."""
        found: list[Pair] = []
        for row in self.spectrum.into:
            re, im = (
                sp.Add(*(weight[part] * value for weight, value in zip(row, at_stages, strict=True)))
                for part in (0, 1)
            )
            found.append((re, im))
        return found

    def left_over(self, lacking: Ref, torque: Ref) -> list[Assign]:
        """Put together for each system what torques lack at the stages.

        Parameters
        ----------
        lacking, torque : Ref
            What lacks, and what systems are to make up for.
        """
        found: list[Assign] = []
        for lane, pair in zip(self.systems, self.combined(self.each(lacking)), strict=True):
            parts = zip(lane.ref(torque), pair, strict=True)
            found += [Assign(ref, value) for ref, value in parts if isinstance(ref, Ref)]
        return found

    def at_stages(self, value: Callable[[int], sp.Expr]) -> list[sp.Expr]:
        """Return what has a value at each stage, from 0, one for each of :attr:`stages`."""
        return [value(instant) for instant in range(len(self.spectrum.nodes))]

    def each(self, value: Ref) -> list[sp.Expr]:
        """Return what a value is at each stage."""
        return [lane.ref(value)[0] for lane in self.stages]

    def inputs_at_stages(
        self, inputs: Sequence[Variable], stand: Mapping[str, Ref]
    ) -> dict[Ref, Sequence[Pair]]:
        """Return what inputs are at each stage, by what stands for them."""
        return {stand[given.name]: [(v, ZERO) for v in self.at_stages(given.entry)] for given in inputs}

    def from_systems(self, weights: Sequence[sp.Expr], found: Ref) -> sp.Expr:
        """Return a weighted sum of the stages by what each system has found.

        Parameters
        ----------
        weights : sequence of sympy.Expr
            Of the stages.
        found : Ref
            The unknown that systems solve for.
        """
        total = ZERO
        for index, lane in enumerate(self.systems):
            re, im = (
                sp.Add(*(w * row[index][part] for w, row in zip(weights, self.spectrum.back, strict=True)))
                for part in (0, 1)
            )
            of_real, of_imaginary = lane.ref(found)
            total += fraction(re) * of_real - fraction(im) * of_imaginary
        return total

    # -- motion at a place, by accelerations at the stages -------------------------------------------------------

    def trials(self, place: Place) -> list[sp.Expr]:
        """Return the accelerations at the stages as known so far."""
        return self.each(place.trial)

    def _trials(self, place: Place) -> list[Ref]:
        return [lane.ref(place.trial)[0] for lane in self.stages]

    def ahead(self, place: Place) -> list[Assign]:
        """Begin on the polynomial of the last step."""
        kept = [v.at() for v in place.stages]
        rows = self.spectrum.ahead
        return [Assign(trial, _weighed(rows.row(i), kept)) for i, trial in enumerate(self._trials(place))]

    def moved(
        self, place: Place, kind: Kind, at_stages: Sequence[Ref], at_middle: Ref | None = None
    ) -> list[Assign]:
        """Write motion at the stages, and at the middle of the step, by the accelerations so far.

        Parameters
        ----------
        kind : {"q", "v", "a"}
            Of motion.
        at_stages : sequence of Ref
            Where it is kept.
        at_middle : Ref, optional
            The same of the middle, where that is asked for.
        """
        size, spectrum = len(self.stages), self.spectrum
        rows: Mapping[str, Sequence[Sequence[sp.Expr]]] = {
            "q": [*(spectrum.squared.row(i) for i in range(size)), spectrum.middle["q"]],
            "v": [*(spectrum.matrix.row(i) for i in range(size)), spectrum.middle["v"]],
            "a": [*sp.eye(size).tolist(), spectrum.middle["a"]],
        }
        targets = [*at_stages, *([at_middle] if at_middle is not None else [])]
        trials = self.trials(place)
        return [
            Assign(target, self._by(place, kind, _weighed(row, trials), instant))
            for target, row, instant in zip(targets, rows[kind], [*spectrum.nodes, HALF], strict=False)
        ]

    def improved(self, place: Place) -> list[Assign]:
        """Take up what the systems have found."""
        trials = self._trials(place)
        return [Assign(trial, trial + v) for trial, v in zip(trials, self.changes(place.solved), strict=True)]

    def changes(self, found: Ref) -> list[sp.Expr]:
        """Return what the systems have found to change at the stages, one value for each of :attr:`stages`."""
        rows = sp.eye(len(self.stages))
        return [self.from_systems(rows.row(i), found) for i in range(rows.rows)]

    def finished(self, place: Place) -> list[Assign]:
        """Keep the accelerations, and write the motion at the end of the step by them."""
        trials = self.trials(place)
        new: dict[Kind, sp.Expr] = {kind: self.at_end(place, kind) for kind in ("q", "v", "a")}
        found = update_assignments(place.history, new, lambda v: v.at(), place.prefix)
        kept = [Assign(v.at(), trial) for v, trial in zip(place.stages, trials, strict=True)]
        return [*found, *(a for a in kept if a.target.variable not in place.history.values())]

    def at_end(self, place: Place, kind: Kind) -> sp.Expr:
        """Return motion at the end of the step by the accelerations so far."""
        return self._by(place, kind, _weighed(self.spectrum.ends[kind], self.trials(place)), sp.S.One)

    def _by(self, place: Place, kind: Kind, gained: sp.Expr, instant: sp.Expr) -> sp.Expr:
        """Return motion at an instant, in steps, by what accelerations add to it."""
        if kind == "a":
            return gained
        rate = place.before("v")
        if kind == "v":
            return rate + self.step * gained
        return place.before("q") + instant * self.step * rate + self.step**2 * gained

    # -- as many iterations as it takes --------------------------------------------------------------------------

    def turned(self, place: Place) -> list[Assign]:
        """Add up how far an iteration has turned what moves."""
        changes = [
            self.step**2 * self.from_systems(self.spectrum.ends[kind], place.solved) for kind in ("q", "v")
        ]
        return [Assign(_TURNED, _TURNED + sp.Add(*(change**2 for change in changes)))]

    def judged(self, added_up: Sequence[Statement]) -> Section:
        """Return what ends iterations where one has changed next to nothing.

        A simplified iteration leaves a share of what it has changed: that must be as little as an exact one would
        leave behind the change that is the last of one.

        Parameters
        ----------
        added_up : sequence of statements
            How far all has turned.
        """
        return Section(
            "whether it has changed next to nothing",
            (
                Assign(_TURNED, ZERO),
                *added_up,
                Assign(SWEEPS.ref, SWEEPS.ref + 1),
                Until(_TURNED - LEAST_TURN.ref**4),
            ),
        )


def seen(inputs: Sequence[Variable]) -> dict[str, Ref]:
    """Return what stands for inputs, by their names, while walks are written for all stages."""
    return {v.name: replace(v, length=None, role=Role.LOCAL).ref for v in inputs}


def _weighed(weights: Sequence[sp.Expr], values: Sequence[sp.Expr]) -> sp.Expr:
    return sp.Add(*(weight * value for weight, value in zip(weights, values, strict=True)))
