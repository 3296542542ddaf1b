"""One step of an integrator as a matrix on the whole arm: what modes need that damping or sweeps couple."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Integrator, Kind, Past, past, stage
from tmm_gen.derive.integrators.history import history_of
from tmm_gen.derive.integrators.relations import affine_motion
from tmm_gen.derive.integrators.spectrum import spectrum_of
from tmm_gen.modal.linear import Linear
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.program.space.assemble import predicts_held

Array = NDArray[np.float64]
_Terms = list[tuple[sp.Symbol, float]]


@dataclass(frozen=True, eq=False)
class Rounds:
    """A step whose stages are not solved at once: sweeps that leave something out, and corrections that make up for it.

    Parameters
    ----------
    left : array, (d, d)
        What of the stiffness the sweeps leave out, N m/rad.
    count : int
        A sweep and so many less one corrections.
    """

    left: Array
    count: int


class WholeStep:
    """The amplification matrix of ``M q'' + C q' + K q = 0`` in modal coordinates.

    Parameters
    ----------
    integrator : Integrator
        With its parameters bound to numbers.
    linear : Linear
        Of the arm.
    rounds : Rounds, optional
        How its stages are solved, if not at once.
    """

    def __init__(self, integrator: Integrator, linear: Linear, rounds: Rounds | None = None) -> None:
        self._scheme = integrator.main
        found = history_of([integrator.main], "acceleration")
        newest = Past("a", 0)
        self._rounds = rounds
        self._held = rounds is not None and predicts_held(len(self._scheme.stages), rounds.count)
        self._values = (*found, newest) if self._held and newest not in found else found
        modes = undamped_modes(linear)
        self._left = None if rounds is None else modes.shapes.T @ rounds.left @ modes.shapes
        self._stiffness = modes.squares
        self._damping: Array = modes.shapes.T @ linear.parts.braked(modes.shapes)

    @property
    def size(self) -> int:
        """Rows of the matrix."""
        kept = len(self._values)
        if self._scheme.coupled:  # and iterations begin on the stages of the last step
            kept = 2 + (len(self._scheme.stages) if self._left is not None else 0)
        return kept * len(self._stiffness)

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
        if self._scheme.coupled:
            left = None if self._left is None else step**2 * self._left
            return self._at_once(damping, stiffness, left)
        gains, offsets, update = self._numbers
        for index, (gain, offset) in enumerate(zip(gains, offsets, strict=True), start=1):
            known = {kind: linear(offset[kind]) for kind in KINDS}
            effective = gain["a"] * np.eye(modes) + gain["v"] * damping + gain["q"] * np.diag(stiffness)
            missing = known["a"] + damping @ known["v"] + stiffness[:, None] * known["q"]
            latest = rows[stage("a", index - 1) if index > 1 else past("a")] if self._held else None
            unknown = self._solved(effective, missing, gain["q"] * step**2, latest)
            for kind in KINDS:
                rows[stage(kind, index)] = gain[kind] * unknown + known[kind]
        new = [linear(update[p.kind]) if p.lag == 0 else rows[past(p.kind, p.lag - 1)] for p in self._values]
        return np.vstack(new)

    def _at_once(self, damping: Array, stiffness: Array, left: Array | None) -> Array:
        """Return it where all stages are solved at once, from their accelerations by the motion before.

        Parameters
        ----------
        left : array, (modes, modes), optional
            What of the stiffness sweeps leave out: accelerations at the stages are then part of the history.
        """
        spectrum = spectrum_of(self._scheme)
        weights, squared, nodes = (
            np.array(each.tolist(), float)
            for each in (spectrum.matrix, spectrum.squared, sp.Matrix(spectrum.nodes))
        )
        eye, modes = np.eye(len(stiffness)), len(stiffness)
        system = np.kron(np.eye(len(nodes)), eye) + np.kron(weights, damping)
        system += np.kron(squared, np.diag(stiffness))
        still = np.kron(np.ones_like(nodes), np.diag(stiffness))
        moving = np.kron(nodes, np.diag(stiffness)) + np.kron(np.ones_like(nodes), damping)
        missing = np.hstack([still, moving])
        if left is None:
            found = -np.linalg.solve(system, missing)
        else:
            assert self._rounds is not None
            ahead = np.kron(np.array(spectrum.ahead.tolist(), float), eye)
            found = np.hstack([np.zeros_like(missing), ahead])
            missing = np.hstack([missing, np.zeros_like(ahead)])
            for _ in range(self._rounds.count):
                found = found - np.linalg.solve(system - np.kron(squared, left), missing + system @ found)
        ends = {kind: np.array([float(w) for w in row]) for kind, row in spectrum.ends.items()}
        place, rate = (np.kron(ends[kind][None, :], eye) @ found for kind in ("q", "v"))
        place[:, :modes] += eye
        place[:, modes : 2 * modes] += eye
        rate[:, modes : 2 * modes] += eye
        return np.vstack([place, rate] if left is None else [place, rate, found])

    def _solved(self, effective: Array, missing: Array, turned: float, latest: Array | None) -> Array:
        """Return what solves a stage, or what sweeps make of it, (modes, size).

        Parameters
        ----------
        effective : array, (modes, modes)
            What the unknown acceleration makes.
        missing : array, (modes, size)
            What it has to balance.
        turned : float
            Square of the step times the angle per unknown: the share of what sweeps leave out.
        latest : array, (modes, size), optional
            The acceleration that a stage is predicted with; none if left out.
        """
        if self._rounds is None or self._left is None:
            return np.asarray(-np.linalg.solve(effective, missing), float)
        swept = effective - turned * self._left
        found = np.zeros_like(missing) if latest is None else latest
        for _ in range(self._rounds.count):
            found = found - np.linalg.solve(swept, missing + effective @ found)
        return found

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
