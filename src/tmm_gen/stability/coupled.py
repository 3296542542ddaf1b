"""One step of an integrator as a matrix on the whole arm: what modes coupled by damping need."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Integrator, Kind, past, stage
from tmm_gen.derive.integrators.history import history_of
from tmm_gen.derive.integrators.relations import affine_motion
from tmm_gen.modal.linear import Linear
from tmm_gen.modal.undamped import undamped_modes

Array = NDArray[np.float64]
_Terms = list[tuple[sp.Symbol, float]]


class CoupledStep:
    """The amplification matrix of ``M q'' + C q' + K q = 0`` in modal coordinates.

    Parameters
    ----------
    integrator : Integrator
        With its parameters bound to numbers.
    linear : Linear
        Of the arm.
    """

    def __init__(self, integrator: Integrator, linear: Linear) -> None:
        self._scheme = integrator.main
        self._values = history_of([integrator.main], "acceleration")
        modes = undamped_modes(linear)
        self._stiffness = modes.squares
        self._damping: Array = modes.shapes.T @ linear.parts.braked(modes.shapes)

    @property
    def size(self) -> int:
        """Rows of the matrix."""
        return len(self._values) * len(self._stiffness)

    def matrix(self, step: float) -> Array:
        """Return the amplification matrix at a step in s, (size, size), of the history in units of steps."""
        modes = len(self._stiffness)
        unit = np.eye(self.size)
        rows: dict[sp.Symbol, Array] = {
            past(p.kind, p.lag): unit[i * modes : (i + 1) * modes] for i, p in enumerate(self._values)
        }

        def linear(terms: _Terms) -> Array:
            return sum((c * rows[symbol] for symbol, c in terms), np.zeros((modes, self.size)))

        damping, stiffness = step * self._damping, step**2 * self._stiffness
        gains, offsets, update = self._numbers
        for index, (gain, offset) in enumerate(zip(gains, offsets, strict=True), start=1):
            known = {kind: linear(offset[kind]) for kind in KINDS}
            effective = gain["a"] * np.eye(modes) + gain["v"] * damping + gain["q"] * np.diag(stiffness)
            missing = known["a"] + damping @ known["v"] + stiffness[:, None] * known["q"]
            unknown = -np.linalg.solve(effective, missing)
            for kind in KINDS:
                rows[stage(kind, index)] = gain[kind] * unknown + known[kind]
        new = [linear(update[p.kind]) if p.lag == 0 else rows[past(p.kind, p.lag - 1)] for p in self._values]
        return np.vstack(new)

    def radius(self, step: float) -> float:
        """Return the spectral radius in double precision; infinite where numbers overflow."""
        with np.errstate(all="ignore"):
            made = self.matrix(step)
        if not np.all(np.isfinite(made)):
            return float("inf")
        return float(np.max(np.abs(np.linalg.eigvals(made))))

    @cached_property
    def _numbers(
        self,
    ) -> tuple[list[dict[Kind, float]], list[dict[Kind, _Terms]], dict[Kind, _Terms]]:
        """Return gains and offsets of the stages, and the update, with time counted in steps."""
        motions = [
            affine_motion(self._scheme, i, "acceleration") for i in range(1, len(self._scheme.stages) + 1)
        ]
        gains = [{kind: float(motion.gain[kind].subs(STEP, 1)) for kind in KINDS} for motion in motions]
        offsets = [{kind: _terms(motion.offset[kind]) for kind in KINDS} for motion in motions]
        return gains, offsets, {kind: _terms(self._scheme.update[kind]) for kind in KINDS}


def _terms(expression: sp.Expr) -> _Terms:
    """Return a linear expression as values and their factors, at a step of 1."""
    at_one = sp.sympify(expression).subs(STEP, 1)
    symbols = sorted(at_one.free_symbols, key=lambda symbol: str(symbol.name))
    return [(symbol, float(sp.diff(at_one, symbol))) for symbol in symbols]
