"""A base that floats, in a step whose stages are all solved at once.

What its balances lack at each stage, in the base's axes there, is put together for each eigenvalue. What mends it is a
change of the base's acceleration in these axes, so that no slope changes as the base turns, and it is written by place
and turn with each stage's own axes. Kept for the next step are angular accelerations, in the base's axes too: they go
on along a polynomial from step to step, while turns are counted anew in each.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past
from tmm_gen.derive.space import base_motion as motion_of
from tmm_gen.derive.space.base_balance import CHANGES, LACKS, taking_up_lines
from tmm_gen.derive.space.declaration import AXES, vector
from tmm_gen.program.coupled import Coupled
from tmm_gen.program.coupled_motion import Place
from tmm_gen.program.passes.side_by_side import ZERO
from tmm_gen.program.space.base import base_refs, turned_on
from tmm_gen.program.space.base_layout import BaseLayout
from tmm_gen.program.space.over_stations import OverStations
from tmm_gen.program.statements import Assign, Statement
from tmm_gen.program.variables import Ref, Variable, local

_OMEGA, _ALPHA = vector("base_omega_ahead"), vector("base_alpha_ahead")
_GIVEN = sp.Matrix([sp.Symbol(s.name.replace("change", "given"), real=True) for s in CHANGES])
_TURN: dict[Kind, sp.Matrix] = {
    "q": motion_of.TURN,
    "v": motion_of.TURN_RATE,
    "a": motion_of.TURN_ACCELERATION,
}


def _own_refs() -> dict[sp.Symbol, Ref]:
    """Return what stands for that which methods of other kinds have not."""
    ahead = "of the base on the last step's polynomial"
    words = (
        (_OMEGA, f"angular velocity {ahead}", "rad/s"),
        (_ALPHA, f"angular acceleration {ahead}", "rad/s^2"),
        (_GIVEN[:3, :], "change of the base's acceleration in its own axes", "m/s^2"),
        (_GIVEN[3:, :], "change of the base's angular acceleration", "rad/s^2"),
    )
    return {
        symbol: local(symbol.name, f"{doc}, {axis}", unit)
        for symbols, doc, unit in words
        for symbol, axis in zip(symbols, AXES, strict=True)
    }


_REFS: dict[sp.Symbol, Ref] = {**base_refs(), **_own_refs()}


def values_at_stages(layout: BaseLayout) -> dict[sp.Symbol, sp.Expr]:
    """Return what symbols of the base's motion stand for, before there is a value for each stage."""
    return {**_REFS, **dict(zip(motion_of.START, layout.start, strict=True))}


@dataclass(frozen=True)
class _Turn(Place):
    """A coordinate of the turn, which is none where the step begins."""

    def before(self, kind: Kind) -> sp.Expr:
        """Return the motion at the start of the step."""
        return ZERO if kind == "q" else super().before(kind)


@dataclass(frozen=True, eq=False)
class BaseAtStages:
    """Statements of one scheme's step.

    Parameters
    ----------
    layout : BaseLayout
        The base's variables.
    coupled : Coupled
        The scheme, and the step it takes.
    over, mend : OverStations
        Over the stages, and in the systems of the eigenvalues.
    """

    layout: BaseLayout
    coupled: Coupled
    over: OverStations
    mend: OverStations

    @cached_property
    def at_stages(self) -> tuple[Variable, ...]:
        """What has a value at each stage, besides what follows from it."""
        symbols = (
            *motion_of.PUSH,
            *(s for found in _TURN.values() for s in found),
            *_OMEGA,
            *_ALPHA,
            *_GIVEN,
        )
        return tuple(_REFS[symbol].variable for symbol in symbols)

    def __post_init__(self) -> None:
        """Give forces on the base their words before any line is written with them."""
        for symbols, unit in ((motion_of.OWN_FORCE, "N"), (motion_of.OWN_MOMENT, "N m")):
            for symbol in symbols:
                self.mend.at_base(symbol, ("what the balance of the base lacks", unit))

    @property
    def forces(self) -> tuple[Ref, ...]:
        """What the balances lack in the system of each eigenvalue, (6,)."""
        return tuple(map(self.mend.at_base, (*motion_of.OWN_FORCE, *motion_of.OWN_MOMENT)))

    # -- before the iterations -----------------------------------------------------------------------------------

    def ahead(self) -> list[Statement]:
        """Begin on the polynomials of the last step."""
        found: list[Statement] = [s for place in self._places for s in self.coupled.ahead(place)]
        for k, place in enumerate(self._turns(_ALPHA)):
            found += self.coupled.ahead(place)
            found += self.coupled.moved(place, "v", self._lanes(_OMEGA[k]))
            # a turn within a step is so short that this is near enough
            found += self.coupled.moved(place, "q", self._lanes(motion_of.TURN[k]))
        return found

    def turning(self) -> list[Statement]:
        """Return how the turns begin that go with these, to be written at each stage."""
        lines = motion_of.turning_lines(motion_of.TURN, _OMEGA, _ALPHA, _TURN["v"], _TURN["a"])
        return [*self.over.base_lines(lines)]

    # -- an iteration --------------------------------------------------------------------------------------------

    def moved(self) -> list[Statement]:
        """Write the turns at the stages by the accelerations so far; nothing asks for places there."""
        return [
            s
            for k, place in enumerate(self._turns(_TURN["a"]))
            for kind in ("q", "v")
            for s in self.coupled.moved(place, kind, self._lanes(_TURN[kind][k]))
        ]

    def left_over(self) -> list[Statement]:
        """Put together for each system what the balances lack at the stages."""
        return [
            x
            for symbol, force in zip(LACKS, self.forces, strict=True)
            for x in self.coupled.left_over(self.over.at_base(symbol), force)
        ]

    def given(self) -> list[Statement]:
        """Return what the systems change accelerations at the stages by."""
        return [
            Assign(target, value)
            for symbol, given in zip(CHANGES, _GIVEN, strict=True)
            for target, value in zip(
                self._lanes(given), self.coupled.changes(self.mend.at_base(symbol)), strict=True
            )
        ]

    def improved(self) -> list[Statement]:
        """Take that up, to be written at each stage."""
        return [*self.over.base_lines(taking_up_lines(tuple(_GIVEN)))]

    def turned(self) -> list[Statement]:
        """Add up how far an iteration has turned the base."""
        return [
            s
            for change, place in zip(CHANGES[3:], self._turns(_TURN["a"]), strict=True)
            for s in self.coupled.turned(replace(place, solved=self.mend.at_base(change)))
        ]

    # -- the end -------------------------------------------------------------------------------------------------

    def finished(self) -> list[Statement]:
        """Set the motion at the end of the step, and keep the accelerations at the stages."""
        found: list[Statement] = [
            Assign(_REFS[_TURN[kind][k]], self.coupled.at_end(place, kind))
            for k, place in enumerate(self._turns(_TURN["a"]))
            for kind in KINDS
        ]
        found += turned_on(self.layout, values_at_stages(self.layout))
        found += [s for place in self._places for s in self.coupled.finished(place)]
        # at the turns of the last iteration: what they have changed by since is less than the polynomial leaves
        for k, kept in enumerate(self.layout.alpha_stages.values()):
            spinning = self.coupled.each(self.over.at_base(motion_of.SPINNING[k]))
            given = self.coupled.each(_REFS[_GIVEN[3 + k]])
            newest = self.layout.newest("a", self.layout.alpha)[k]
            found += [
                Assign(variable.ref, alpha + change)
                for variable, alpha, change in zip(kept, spinning, given, strict=True)
                if variable.ref != newest
            ]
        return found

    # -- places --------------------------------------------------------------------------------------------------

    @property
    def _places(self) -> list[Place]:
        """Places of the base along the axes of the world."""
        layout, push = self.layout, motion_of.PUSH
        return [
            Place(layout.place[axis], layout.place_stages[axis], _REFS[s], _REFS[s])
            for s, axis in zip(push, AXES, strict=True)
        ]

    def _turns(self, accelerations: Iterable[sp.Symbol]) -> list[_Turn]:
        """Return the coordinates of the turn, whose rates are angular velocities where a step begins."""
        layout = self.layout
        return [
            _Turn(
                {Past("v", 0): layout.omega[axis][Past("v", 0)]},
                layout.alpha_stages[axis],
                _REFS[symbol],
                _REFS[symbol],
            )
            for symbol, axis in zip(accelerations, AXES, strict=True)
        ]

    def _lanes(self, symbol: sp.Symbol) -> list[Ref]:
        """Return what stands for a symbol at each stage."""
        return [Ref(lane.of(_REFS[symbol].variable)) for lane in self.coupled.stages]
