"""The walks of a sweep over an arm in space: out with the exact motion, in with forces, back with what joints do."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, lru_cache

import sympy as sp

from tmm_gen.derive.space import base_newton
from tmm_gen.derive.space.base_balance import answer_lines, balance_lines, force_lines
from tmm_gen.derive.space.base_motion import outward_lines as base_outward
from tmm_gen.derive.space.declaration import ACCEL, ALPHA, OMEGA
from tmm_gen.derive.space.inward import CARRIED, CHANGE, Inertial
from tmm_gen.derive.space.newton import CARRIED as SLOPES_CARRIED
from tmm_gen.derive.space.newton import CHANGE as ALL_CHANGES
from tmm_gen.derive.space.newton import Newton
from tmm_gen.derive.space.outward import Outward
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.station.lets import Line
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.over_stations import OverStations
from tmm_gen.program.statements import Order, Section
from tmm_gen.program.variables import Variable


@lru_cache(maxsize=512)
def outward(pattern: Pattern, still: bool, sloped: bool = False) -> Outward:
    """Return the way out over stations of a pattern."""
    return Outward(pattern, still=still, sloped=sloped)


@lru_cache(maxsize=256)
def newton(pattern: Pattern, still: bool, gains: tuple[sp.Expr, ...]) -> Newton:
    """Return the exact way in and back over stations of a pattern."""
    return Newton(outward(pattern, still, True), gains)


@lru_cache(maxsize=512)
def inertial(pattern: Pattern, still: bool, gain: sp.Expr, products: bool) -> Inertial:
    """Return the way in and back over stations of a pattern."""
    return Inertial(outward(pattern, still), gain, products=products)


class SpaceWalks(OverStations):
    """Writes the walks of one stage.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    bodies : Bodies
        What is prepared of them.
    motion : mapping from sympy.Symbol to Variable
        Angle, rate and acceleration of the joints at the point of linearisation.
    gains : tuple of 3 sympy.Expr
        Angle, rate and acceleration per unknown.
    absent : frozenset of sympy.Symbol
        What of the joints' own law is zero everywhere.
    exact : bool
        Whether sweeps are Newton's own.
    base : mapping from sympy.Symbol to sympy.Expr
        What symbols of the motion of a base that floats stand for.
    """

    def __init__(
        self,
        layout: SpaceLayout,
        bodies: Bodies,
        motion: Mapping[sp.Symbol, Variable],
        gains: tuple[sp.Expr, ...],
        absent: frozenset[sp.Symbol] = frozenset(),
        *,
        exact: bool = False,
        base: Mapping[sp.Symbol, sp.Expr] = {},
    ) -> None:
        super().__init__(layout, bodies, motion, absent, base)
        self._gains, self._gain, self._exact = gains, gains[-1], exact

    @cached_property
    def _all_kept(self) -> frozenset[sp.Symbol]:
        """What of the way out is read later at any station: one array, or one scalar, has one name."""
        patterns = {p for run in self._runs for p in run.patterns}
        return frozenset().union(*(newton(p, False, self._gains).kept for p in patterns))

    def read_later(self) -> frozenset[sp.Symbol]:
        """Return what of the way out slopes are taken at."""
        return self._all_kept if self._exact else frozenset()

    def outward(self, *, still: bool) -> Section:
        """Return the exact motion of all sections and the forces that bodies take."""
        carried = (*OMEGA, *ALPHA, *ACCEL)
        at_base = self._of_base(lambda p: base_outward(p, self._falls, still=still))
        statements = self.walk(
            Order.OUTWARD, lambda p: outward(p, still, self._exact).lines, carried, base=at_base
        )
        return Section(
            "out: motion of every link in its own axes, and what its body takes", tuple(statements)
        )

    def inward(self, *, still: bool) -> Section:
        """Return the articulated sweep."""
        if self._exact:
            of_base = self._of_base(
                lambda p: base_newton.balance_lines(p, self._falls, self._gains, still=still)
            )
            lines = self.walk(
                Order.INWARD, lambda p: newton(p, still, self._gains).inward, SLOPES_CARRIED, base=of_base
            )
            return Section("in: slopes of all forces, joints eliminated one by one", tuple(lines))
        at_base = self._of_base(lambda p: (*balance_lines(p), *force_lines()))
        statements = self.walk(
            Order.INWARD, lambda p: self._eliminated(p, still).inward, CARRIED, base=at_base
        )
        return Section("in: articulated inertia, joints eliminated one by one", tuple(statements))

    def again(self) -> Section:
        """Return the way in of a correction."""
        at_base = self._of_base(lambda _: force_lines())
        statements = self.walk(
            Order.INWARD, lambda p: self._eliminated(p, False).again, CARRIED[-6:], base=at_base
        )
        return Section("in: forces alone, with the factors of the sweep", tuple(statements))

    def back(self, *, still: bool = True) -> Section:
        """Return the way back out to what each joint does."""
        if self._exact:
            of_base = self._of_base(lambda _: base_newton.answer_lines(self._falls, self._gains, still=still))
            lines = self.walk(
                Order.OUTWARD, lambda p: newton(p, still, self._gains).back, tuple(ALL_CHANGES), base=of_base
            )
            return Section("back out: what each joint does", tuple(lines))
        at_base = self._of_base(lambda _: self._answered())
        statements = self.walk(
            Order.OUTWARD, lambda p: self._eliminated(p, True).back, tuple(CHANGE), base=at_base
        )
        return Section("back out: what each joint does", tuple(statements))

    def _eliminated(self, pattern: Pattern, still: bool) -> Inertial:
        """Return how a station's joint is eliminated."""
        return inertial(pattern, still, self._gain, self.layout.single)

    def _answered(self) -> Sequence[Line]:
        """Return what a base that floats does."""
        return answer_lines(self._gain)

    @property
    def _falls(self) -> tuple[bool, ...]:
        return tuple(g != 0.0 for g in self.layout.arm.gravity)

    def _of_base(self, lines: Callable[[Pattern], Sequence[Line]]) -> Sequence[Line]:
        """Return lines of a base that floats; none of one that rests."""
        return lines(self.layout.base.pattern) if self.layout.base else ()
