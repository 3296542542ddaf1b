"""Integration of stiff mechanical equations to many digits, for reference solutions.

Radau IIA collocation (Hairer & Wanner 1996, Solving Ordinary Differential Equations II, sec. IV.5) of
``R(t, q, v, a) = 0``: accelerations are a polynomial over each step that satisfies the equations at the nodes. With
ten nodes the order is 19, so steps may be long, and stiff joints do not limit them. Unlike the kernels it checks,
it iterates to convergence, chooses its steps, and never forms a transfer matrix.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]

Residual = Callable[[Array, Array, Array, Array], Array]
"""``R(t, q, v, a)``: instants ``(s,)``, motions ``(s, n)``; returns ``(s, n)``."""

Slopes = Callable[[Array, Array, Array, Array], tuple[Array, Array, Array]]
"""Derivatives of ``R`` by ``q, v, a``, each ``(s, n, n)``."""

NODES = 10
_ITERATIONS = 12
_CONVERGED = 1e-13
_SMALLEST = 1e-14
"""Steps below this share of the whole time are a failure."""


class ReferenceError(ArithmeticError):
    """The equations could not be integrated: steps became too small."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Motion as polynomials over consecutive steps.

    Parameters
    ----------
    ends : array, (steps + 1,)
        Instants between the steps, s.
    angle, rate : array, (steps, n)
        At the beginning of each step.
    acceleration : array, (steps, nodes, n)
        Coefficients of Legendre polynomials on ``[-1, 1]``.
    """

    ends: Array
    angle: Array
    rate: Array
    acceleration: Array

    def at(self, times: Array) -> tuple[Array, Array, Array]:
        """Return ``q, v, a`` at instants ``(k,)``, each ``(k, n)``; where two steps meet, those of the later one."""
        times = np.asarray(times, float)
        place = np.clip(np.searchsorted(self.ends, times, side="right") - 1, 0, len(self.ends) - 2)
        h = np.diff(self.ends)[place]
        x = 2.0 * (times - self.ends[place]) / h - 1.0
        once, twice = _integrals(x)
        c = self.acceleration[place]
        a = np.einsum("ks,ksn->kn", legendre.legvander(x, NODES - 1), c)
        v = self.rate[place] + h[:, None] * np.einsum("ks,ksn->kn", once, c)
        way = (times - self.ends[place])[:, None]
        q = self.angle[place] + way * self.rate[place] + h[:, None] ** 2 * np.einsum("ks,ksn->kn", twice, c)
        return q, v, a


def integrate(
    residual: Residual,
    slopes: Slopes,
    angle: Array,
    rate: Array,
    breaks: Array,
    tolerance: float = 1e-11,
) -> Trajectory:
    """Integrate from the first to the last of some instants.

    Parameters
    ----------
    residual, slopes : callable
        The equations and their derivatives.
    angle, rate : array, (n,)
        At the first instant.
    breaks : array, (k,)
        Increasing; no step reaches across one of them.
    tolerance : float
        On the last terms of the polynomials, as change of the angle in rad. Errors at the ends of steps are far
        smaller, as the method converges there at twice the order.

    Raises
    ------
    ReferenceError
        If steps become too small.
    """
    span = float(breaks[-1] - breaks[0])
    now, q, v = float(breaks[0]), np.array(angle, float), np.array(rate, float)
    ends, angles, rates, coefficients = [now], [], [], []
    h = span * 1e-3
    once, twice = _integrals(np.array([1.0]))
    for goal in np.asarray(breaks, float)[1:].tolist():
        guess: Array | None = None
        while now < goal:
            left = goal - now
            last = h >= left * (1.0 - 1e-9)
            size = left if last else min(h, 0.5 * left)
            if size < _SMALLEST * span:
                raise ReferenceError(f"the reference cannot pass t = {now:g} s")
            solved = _step(residual, slopes, now, size, goal, q, v, guess)
            if solved is None:
                h, guess = 0.25 * size, None
                continue
            c, tail = solved
            ratio = tail / tolerance
            if ratio > 1.0:
                h = size * max(0.2, 0.9 * ratio ** (-1.0 / NODES))
                continue
            ends.append(goal if last else now + size)
            angles.append(q)
            rates.append(v)
            coefficients.append(c)
            q = q + size * v + size**2 * (twice @ c)[0]
            v = v + size * (once @ c)[0]
            now = ends[-1]
            guess = _nodes()[1][-1] @ c
            h = size * min(4.0, 0.9 * max(ratio, 1e-12) ** (-1.0 / NODES))
    return Trajectory(np.array(ends), np.array(angles), np.array(rates), np.array(coefficients))


def _step(
    residual: Residual,
    slopes: Slopes,
    t: float,
    h: float,
    goal: float,
    q: Array,
    v: Array,
    guess: Array | None,
) -> tuple[Array, float] | None:
    """Return the coefficients of the accelerations over a step and the size of the last ones; None if lost.

    A node at `goal` has what acts until then: an input may jump there.
    """
    x, _, inverse, once, twice = _nodes()
    s, n = len(x), len(q)
    passed = 0.5 * h * (x + 1.0)
    instants = np.minimum(t + passed, np.nextafter(goal, -np.inf))
    a = np.zeros((s, n)) if guess is None else np.tile(guess, (s, 1))
    to_v, to_q = h * once @ inverse, h * h * twice @ inverse
    drift = q + np.outer(passed, v)
    before = np.inf
    for _ in range(_ITERATIONS):
        at_q, at_v = drift + to_q @ a, v + to_v @ a
        with np.errstate(all="ignore"):
            r = residual(instants, at_q, at_v, a)
        if not np.all(np.isfinite(r)):
            return None
        by_q, by_v, by_a = slopes(instants, at_q, at_v, a)
        whole = np.einsum("ij,inm->injm", to_q, by_q) + np.einsum("ij,inm->injm", to_v, by_v)
        for i in range(s):
            whole[i, :, i, :] += by_a[i]
        flat = whole.reshape(s * n, s * n)
        change = np.linalg.solve(flat, -r.reshape(-1)).reshape(s, n)
        a = a + change
        moved = float(np.max(np.abs(to_q @ change)) + h * np.max(np.abs(to_v @ change)))
        size = 1.0 + float(np.max(np.abs(at_v))) * h
        if moved <= _CONVERGED * size:
            break
        if moved > 2.0 * before:
            return None
        before = moved
    else:
        if moved > 1e-11 * size:
            return None
    c = inverse @ a
    tail = float(h * h * np.max(np.abs(c[-2:])))
    return c, tail


@cache
def _nodes() -> tuple[Array, Array, Array, Array, Array]:
    """Return nodes on ``[-1, 1]``, Legendre values there, their inverse, and the integrals to the nodes."""
    from scipy.special import roots_jacobi

    inner, _ = roots_jacobi(NODES - 1, 1.0, 0.0)
    x = np.append(inner, 1.0)
    values = legendre.legvander(x, NODES - 1)
    once, twice = _integrals(x)
    return x, values, np.linalg.inv(values), once, twice


def _integrals(x: Array) -> tuple[Array, Array]:
    """Return single and double integrals of the Legendre polynomials from -1, as shares of a step and its square."""
    powers = np.eye(NODES)
    once = np.array([legendre.legval(x, legendre.legint(p, lbnd=-1)) for p in powers]).T / 2.0
    twice = np.array([legendre.legval(x, legendre.legint(p, 2, lbnd=-1)) for p in powers]).T / 4.0
    return once, twice
