"""The way in over an element with motion through it: ``S`` changes by congruence, ``A S T + B``."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.carried import ZERO, Carried
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Let
from tmm_gen.derive.station.motion import Outward, Passed
from tmm_gen.derive.station.written import cheapest
from tmm_gen.errors import UserError


class Through:
    """Takes what is carried over elements with motion through them.

    Parameters
    ----------
    out : Outward
        The way out, whose values are at hand.
    carried : Carried
        What changes.
    """

    def __init__(self, out: Outward, carried: Carried) -> None:
        self._frame, self._out, self._carried = carried.frame, out, carried

    def carry(self, passed: Passed) -> None:
        """Take it over one of them.

        Raises
        ------
        UserError
            If the slopes of its law multiply what is not carried.
        """
        frame, own, carried = self._frame, self._frame.own, self._carried
        s, e, p = carried.impedances, carried.forces, carried.predicted
        size = range(len(frame.coordinates))
        column = {
            i: s[i, own] + sum((s[i, k] * swing for k, swing in passed.swings.items()), ZERO) for i in size
        }
        carried.set({(i, own): column[i] for i in size if column[i] != s[i, own]}, {})
        outside = passed.element.outboard.forces
        at_bias = dict(zip(outside, (e[i] for i in size), strict=True))
        slopes_at = at_bias
        if frame.predicted:
            slopes_at = dict(zip(outside, (p[i] for i in size), strict=True))
        impedances: dict[tuple[int, int], sp.Expr] = {}
        forces: dict[int, sp.Expr] = {}
        for i in size:
            law = passed.law.inner[i]
            through = [self._written(passed.at_point(partial(law, f))) for f in outside]
            for k in size:
                value = sum((through[j] * s[j, k] for j in size), ZERO)
                if k == own:
                    slope = self._slope(passed, law)
                    self._require_known(passed, slope, outside[own])
                    value += self._constant_named(passed, slope.xreplace(slopes_at))
                else:
                    value += self._written(passed.at_point(partial(law, passed.element.inboard.motions[k].a)))
                if value != s[i, k]:
                    impedances[i, k] = cheapest(value, self._levers)
            biased = self._written(frame.settled(passed.at_point(law))).xreplace(at_bias)
            if frame.residual:  # what is no change of a force is in what equations leave over
                biased = sum((through[j] * e[j] for j in size), ZERO)
            if biased != e[i]:
                forces[i] = cheapest(biased, self._levers)
        at_predicted = dict(zip(outside, (p[i] for i in size), strict=True))
        carried.set(impedances, forces)
        carried.predict(
            [
                cheapest(
                    self._written(frame.settled(passed.at_point(law))).xreplace(at_predicted), self._levers
                )
                for law in passed.law.inner
            ]
        )

    def _slope(self, passed: Passed, law: sp.Expr) -> sp.Expr:
        """Return the slope of a force by the unknown, gain by gain, so that a lever arm multiplies what it shares."""
        frame = self._frame
        return sp.Add(
            *(
                frame.gains[kind] * self._written(frame.settled(frame.slope(passed.at_point(law), kind)))
                for kind in KINDS
            )
        )

    def _require_known(self, passed: Passed, slope: sp.Expr, torque: sp.Symbol) -> None:
        """Refuse a law whose slopes multiply what is not carried where residuals are given."""
        if self._frame.residual and slope.has(torque):
            raise UserError(
                f"element '{passed.element.name}': slopes of a law that multiplies {torque} are not derived for stages "
                "that are solved at once. Use an integrator such as 'sdirk4'."
            )

    def _constant_named(self, passed: Passed, slope: sp.Expr) -> sp.Expr:
        """Name the part of a slope that depends on parameters and gains alone, if it takes arithmetic."""
        early = passed.constants | set(self._frame.gains.values())
        constant = sp.Add(
            *(term for term in sp.Add.make_args(sp.expand(slope)) if term.free_symbols <= early)
        )
        if constant == 0 or constant.is_Atom or (-constant).is_Atom:
            return slope
        symbol = sp.Symbol(f"{passed.element.name}_impedance", real=True)
        self._carried.lines.append(
            Let(symbol, constant, "force of its inertia or friction per unknown", self._frame.impedance_unit)
        )
        return sp.expand(slope - constant) + symbol

    @property
    def _levers(self) -> tuple[sp.Symbol, ...]:
        return tuple(let.symbol for let in self._out.lets if let.symbol.name.startswith("lever"))

    def _written(self, value: sp.Expr) -> sp.Expr:
        return self._out.values.written(value)
