"""What an integrator makes of a chain in exact arithmetic: the reference that rounding is told by.

The integrator's own equations for the whole chain are solved at each stage in more digits than a kernel has. Nothing
is shared with the kernels but the integrator's declaration: matrices are assembled as in a textbook, not multiplied or
swept from transfer matrices; elimination runs from base to tip, the kernels' from tip to base. Differences of large
numbers are avoided (Grassmann, Taksar & Heyman 1985, Oper. Res. 33): so the digits hold for any ratio of stiffnesses.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import (
    CONSISTENT_START,
    KINDS,
    STEP,
    Integrator,
    Past,
    Scheme,
    past,
    stage,
)
from tmm_gen.derive.integrators.history import history_of
from tmm_gen.derive.integrators.relations import affine_motion

Values = NDArray[Any]
"""Numbers of any type, (n, arms)."""


@dataclass(frozen=True, eq=False)
class Chains:
    """Clamped chains of equal length.

    Parameters
    ----------
    stiffness, damping, inertia : array, (n, arms)
        N m/rad, N m s/rad, kg m^2; their number type is that of the recursion.
    """

    stiffness: Values
    damping: Values
    inertia: Values


class Recursion:
    """Steps of an integrator on chains under a constant torque at the tip.

    Parameters
    ----------
    integrator : Integrator
        With its parameters bound to numbers.
    chains : Chains
        Whose number type is used throughout.
    step : array, (arms,)
        s.
    torque : array, (arms,)
        N m.
    angle : array, (n, arms)
        To start from, at rest, rad.
    """

    def __init__(
        self, integrator: Integrator, chains: Chains, step: Values, torque: Values, angle: Values
    ) -> None:
        self._integrator, self._chains = integrator, chains
        self.step, self._torque = step, torque
        self._number = chains.stiffness.flat[0].__class__
        self._kept = history_of(integrator.schemes, "acceleration")
        zero = chains.stiffness * 0
        self._known: dict[Past, Values] = dict.fromkeys(self._kept, zero)
        self._known |= {Past("q", 0): angle + zero, Past("v", 0): zero, Past("a", 0): zero}
        self._known[Past("a", 0)] = self._solved(_Scheme(CONSISTENT_START, self))["a"]
        self._schemes = [_Scheme(scheme, self) for scheme in integrator.schemes]
        self._taken = 0

    @property
    def angle(self) -> Values:
        """The newest angles, rad, (n, arms)."""
        return self._known[Past("q", 0)]

    def advance(self) -> None:
        """Take one step."""
        scheme = self._schemes[min(self._taken, len(self._schemes) - 1)]
        new = self._solved(scheme)
        known = self._known
        for p in sorted(known, key=lambda p: -p.lag):
            known[p] = known[Past(p.kind, p.lag - 1)] if p.lag else new[p.kind]
        self._taken += 1

    def number(self, value: sp.Expr) -> Any:
        """Return an exact number in the type of the chains."""
        digits = str(sp.N(value, 60))
        return self._number(digits)

    def _solved(self, scheme: _Scheme) -> dict[str, Values]:
        """Return ``q, v, a`` at the end of a step, or at its start for the consistent one."""
        values: dict[sp.Symbol, Values] = {past(p.kind, p.lag): v for p, v in self._known.items()}
        chains = self._chains
        for index, (gain, offset) in enumerate(scheme.stages, start=1):
            known = {kind: self._sum(offset[kind], values) for kind in KINDS}
            joint = gain["v"] * chains.damping + gain["q"] * chains.stiffness
            torque = chains.damping * _twist(known["v"]) + chains.stiffness * _twist(known["q"])
            missing = -torque - chains.inertia * known["a"]
            missing[:-1] = missing[:-1] + torque[1:]
            missing[-1] = missing[-1] + self._torque
            unknown = _eliminated(gain["a"] * chains.inertia, joint, missing)
            for kind in KINDS:
                values[stage(kind, index)] = gain[kind] * unknown + known[kind]
        return {kind: self._sum(scheme.update[kind], values) for kind in KINDS}

    def _sum(self, terms: list[tuple[sp.Symbol, Values]], values: dict[sp.Symbol, Values]) -> Values:
        total = self._chains.stiffness * 0
        for symbol, factor in terms:
            total = total + factor * values[symbol]
        return total


class _Scheme:
    """Gains and offsets of a scheme as numbers of a recursion's type, one for each arm."""

    def __init__(self, scheme: Scheme, recursion: Recursion) -> None:
        self._recursion = recursion
        motions = [affine_motion(scheme, i, "acceleration") for i in range(1, len(scheme.stages) + 1)]
        self.stages = [
            (
                {kind: self._power(motion.gain[kind]) for kind in KINDS},
                {kind: self._terms(motion.offset[kind]) for kind in KINDS},
            )
            for motion in motions
        ]
        self.update = {kind: self._terms(sp.sympify(scheme.update[kind])) for kind in KINDS}

    def _terms(self, expression: sp.Expr) -> list[tuple[sp.Symbol, Values]]:
        symbols = sorted((s for s in expression.free_symbols if "_" in s.name), key=lambda s: str(s.name))
        return [(symbol, self._power(sp.diff(expression, symbol))) for symbol in symbols]

    def _power(self, factor: sp.Expr) -> Values:
        """Return ``number * h^power`` for each arm."""
        exponent = sp.simplify(STEP * sp.diff(factor, STEP) / factor) if factor != 0 else sp.Integer(0)
        power = int(exponent)  # units demand a single power of the step
        number = sp.simplify(factor / STEP**power)
        scaled: Values = self._recursion.number(number) * self._recursion.step**power
        return scaled


def _twist(motion: Values) -> Values:
    """Return the difference over each joint; the base stands still."""
    twist = motion.copy()
    twist[1:] = motion[1:] - motion[:-1]
    return twist


def _eliminated(inertia: Values, joint: Values, right: Values) -> Values:
    """Solve the tridiagonal equations of a chain, base to tip and back, without a difference of pivots.

    ``passed`` is what the chain inboard of a joint opposes to a motion of the joint's outer side.
    """
    n = len(inertia)
    torque, behind = right.copy(), inertia.copy()
    behind[0] = inertia[0] + joint[0]
    share = joint.copy()
    for i in range(1, n):
        share[i] = joint[i] / (behind[i - 1] + joint[i])
        behind[i] = inertia[i] + behind[i - 1] * share[i]
        torque[i] = right[i] + share[i] * torque[i - 1]
    solved = right.copy()
    solved[-1] = torque[-1] / behind[-1]
    for i in reversed(range(n - 1)):
        solved[i] = torque[i] / (behind[i] + joint[i + 1]) + share[i + 1] * solved[i + 1]
    return solved
