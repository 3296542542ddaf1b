"""What a walk inward carries: the force beyond a place, affine in the motion there, ``f = S k + e``."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive.station.frame import Frame, force, impedance, predicted_force
from tmm_gen.derive.station.lets import Line, Update

ZERO = sp.Integer(0)


class Carried:
    """``S``, ``e`` and the force as predicted, and the lines that change them from element to element.

    Parameters
    ----------
    frame : Frame
        What the recursion is derived for.
    zero : frozenset of sympy.Symbol
        Entries that are known to be zero at the outer side.
    """

    def __init__(self, frame: Frame, zero: frozenset[sp.Symbol]) -> None:
        self.frame = frame
        self.lines: list[Line] = []
        self.again: list[Line] = []
        """What a correction repeats: forces alone, with the factors of the sweep."""
        c = frame.coordinates

        def arriving(symbol: sp.Symbol) -> sp.Expr:
            return ZERO if symbol in zero else symbol

        self.impedances = {
            (i, k): arriving(impedance(a, b)) for i, a in enumerate(c) for k, b in enumerate(c)
        }
        """``S``, by the places of its rows and columns among the coordinates."""
        self.forces = {i: arriving(force(a)) for i, a in enumerate(c)}
        """``e``."""
        self.predicted = {i: arriving(predicted_force(a)) for i, a in enumerate(c)}

    @property
    def zero(self) -> frozenset[sp.Symbol]:
        """Entries that are zero by now."""
        c = self.frame.coordinates
        entries = {impedance(c[i], c[k]): value for (i, k), value in self.impedances.items()}
        entries |= {force(c[i]): value for i, value in self.forces.items()}
        entries |= {predicted_force(c[i]): value for i, value in self.predicted.items()}
        return frozenset(symbol for symbol, value in entries.items() if value == 0)

    def set(self, impedances: Mapping[tuple[int, int], sp.Expr], forces: Mapping[int, sp.Expr]) -> None:
        """Give entries of ``S`` and ``e`` new values; those not named stay."""
        c = self.frame.coordinates
        update: dict[sp.Symbol, sp.Expr] = {}
        for i, row in enumerate(c):  # row by row: what a row needs is at hand when it is its turn
            for k, column in enumerate(c):
                if (i, k) in impedances:
                    self.impedances[i, k] = _changed(
                        impedance(row, column), self.impedances[i, k], impedances[i, k], update
                    )
            if i in forces:
                self.forces[i] = _changed(force(row), self.forces[i], forces[i], update)
        if update:
            self.lines.append(Update(update))
        of_forces = {force(row): update[force(row)] for row in c if force(row) in update}
        if of_forces:
            self.again.append(Update(of_forces))

    def predict(self, forces: list[sp.Expr]) -> None:
        """Carry the force as predicted, where slopes are taken at it."""
        if not self.frame.predicted:
            return
        update: dict[sp.Symbol, sp.Expr] = {}
        for i, (c, value) in enumerate(zip(self.frame.coordinates, forces, strict=True)):
            if self.frame.residual and c.integrated:  # no slope is taken at it
                self.predicted[i] = ZERO
                continue
            if value != self.predicted[i] and value != 0:
                update[predicted_force(c)] = value
            self.predicted[i] = predicted_force(c) if value != 0 else ZERO
        if update:
            self.lines.append(Update(update))


def _changed(symbol: sp.Symbol, old: sp.Expr, new: sp.Expr, update: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """Note a new value of what is carried, and return what stands for it."""
    if new == 0:
        return ZERO
    if new != old:
        update[symbol] = new
    return symbol
