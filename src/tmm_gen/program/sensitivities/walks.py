"""Walks whose factors depend on predicted motion alone: their derivative needs no derivatives of factors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from tmm_gen.derive.station.frame import (
    Frame,
)
from tmm_gen.derive.station.inward import Inward
from tmm_gen.derive.station.motion import Outward
from tmm_gen.derive.station.station import outward
from tmm_gen.derive.station.tangent import Tangent
from tmm_gen.program.arm.at_places import BASE
from tmm_gen.program.arm.base import Balance, floating_base
from tmm_gen.program.arm.branches import Gathered
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.statements import Assign, Order, Require, Statement
from tmm_gen.program.variables import Variable

ZERO = sp.Integer(0)


class TangentableWalks(Walks):
    """Walks whose factors depend on predicted motion alone, not on what the sweep itself has found.

    As accurate as the others, for a walk of predicted forces more; their exact derivative needs no derivatives of
    factors.
    """

    def __init__(self, layout: Layout, prepared: Mapping[str, Variable], frame: Frame, *more: Any) -> None:
        super().__init__(layout, prepared, replace(frame, predicted=True), *more)

    def tangents(self) -> list[tuple[int, int, Inward, Outward, Tangent]]:
        """Return the derived tangents of all runs."""
        found = []
        for (start, stop, elements), derived in zip(self.runs, self._derived.inwards, strict=True):
            out = outward(elements, self.frame)
            found.append((start, stop, derived, out, Tangent(derived, out)))
        return found

    def _tail_tangent(self) -> Tangent:
        """Return the tangent of what stands beyond the last station."""
        return Tangent(self._derived.tail, outward(self.layout.row.tail, self.frame, moved=True))

    def _named_balance(self) -> Balance:
        """Return how a base that floats is solved for, with names for all that tangents need of it."""
        return floating_base(self.layout.row.base, self.frame, self._derived.at_base, named=True)

    def _walk_in(
        self, at_tip: Mapping[sp.Symbol, sp.Expr], bodies: Sequence[Sequence[Assign | Require]]
    ) -> list[Statement]:
        """Walk inward with scalars that begin with given values at the tip, and with zero where branches end."""
        row, gathered = self.layout.row, Gathered(self.layout.row)
        carried = {s: self.scratch.ref(s.name) for s in at_tip}
        found: list[Statement] = []
        for (start, stop, _), body in reversed(list(zip(self.runs, bodies, strict=True))):
            begin = gathered.joined(stop - 1, carried.values())
            if not row.carried(stop - 1):
                begin = {ref: at_tip[s] if stop == len(row.stations) else ZERO for s, ref in carried.items()}
            found += [Assign(ref, value) for ref, value in begin.items()]
            found.append(self.over(Order.INWARD, start, stop, body))
            found += gathered.leave(start, carried.values())
        at_base = gathered.joined(BASE - 1, carried.values())
        return [*found, *(Assign(ref, value) for ref, value in at_base.items())]
