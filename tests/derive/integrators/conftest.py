"""An independent yardstick: the declared relations solved as they stand, and an oscillator's closed form."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.cli import main
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Integrator, Scheme, past, stage

Array = NDArray[np.float64]
Simulate = Callable[..., Array]
MOST_LAGS = 3


@dataclass(frozen=True)
class Oscillator:
    """q'' + 2 zeta w q' + w^2 q = amplitude cos(rate t), from displacement 1 and velocity 0."""

    frequency: float = 1.0
    zeta: float = 0.0
    amplitude: float = 0.0
    rate: float = 1.3

    def load(self, time: float) -> float:
        return self.amplitude * math.cos(self.rate * time)

    def acceleration(self, time: float, q: float, v: float) -> float:
        return self.load(time) - 2 * self.zeta * self.frequency * v - self.frequency**2 * q

    def exact(self, time: Array) -> Array:
        """Closed form of (q, v), (2, len(time))."""
        w, z = self.frequency, self.zeta
        steady = self.amplitude / (w**2 - self.rate**2 + 2j * z * w * self.rate)
        root = complex(-z * w, w * math.sqrt(1 - z**2))
        # free part Re(c exp(root t)) with q(0) = 1 and v(0) = 0 of the whole
        q0, v0 = 1 - steady.real, -(steady * 1j * self.rate).real
        c = complex(q0, (root.real * q0 - v0) / root.imag)
        free, forced = c * np.exp(root * time), steady * np.exp(1j * self.rate * time)
        return np.array([(free + forced).real, (root * free + 1j * self.rate * forced).real])


@pytest.fixture(scope="session")
def printed() -> dict[str, Any]:
    """What `tmm-gen integrators --json --zeta 0.1` prints."""
    said: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("click.echo", lambda text="", **_: said.append(str(text)))
        assert main(["integrators", "--json", "--zeta", "0.1"]) == 0
    whole: dict[str, Any] = json.loads("".join(said))
    return whole


@pytest.fixture(scope="session")
def oscillator() -> type[Oscillator]:
    return Oscillator


@pytest.fixture(scope="session")
def simulate() -> Simulate:
    """Run an integrator: (integrator, oscillator, step, count) -> (3, count + 1), rows q, v, a.

    Shorter where the motion has grown beyond all bounds.
    """
    return _simulate


def _simulate(integrator: Integrator, oscillator: Oscillator, step: float, count: int) -> Array:
    advances = [_compiled(scheme, oscillator, step) for scheme in integrator.schemes]
    values = np.zeros((count + 1, 3))
    values[0] = [1.0, 0.0, oscillator.acceleration(0.0, 1.0, 0.0)]
    for k in range(count):
        # lags 0, 1, 2 of q, v, a; those before the start are not a number, so that using them shows
        known = [values[k - lag] if k >= lag else np.full(3, np.nan) for lag in range(MOST_LAGS)]
        values[k + 1] = advances[min(k, len(advances) - 1)](np.concatenate(known), k * step)
        if np.max(np.abs(values[k + 1])) > 1e12:
            return values[: k + 2].T
    return values.T


def _at_once(scheme: Scheme, oscillator: Oscillator, step: float) -> Callable[[Array, float], Array]:
    """Solve the relations of all stages and their equilibria as one system: what stages that are coupled need."""
    known = [past(kind, lag) for lag in range(MOST_LAGS) for kind in KINDS]
    motion = [stage(kind, i + 1) for i in range(len(scheme.stages)) for kind in KINDS]
    relations = [r.subs(STEP, step) for declared in scheme.stages for r in declared.relations]
    matrix, right = sp.linear_eq_to_matrix(relations, motion)
    of_oscillator = [oscillator.frequency**2, 2 * oscillator.zeta * oscillator.frequency, 1.0]
    balances = np.kron(np.eye(len(scheme.stages)), of_oscillator)
    inverse = np.linalg.inv(np.vstack([np.array(matrix.tolist(), dtype=float), balances]))
    by_history = _rows([*right], known)
    update = _rows([sp.sympify(scheme.update[kind]).subs(STEP, step) for kind in KINDS], [*known, *motion])

    def advance(history: Array, time: float) -> Array:
        loads = [oscillator.load(time + float(declared.instant) * step) for declared in scheme.stages]
        solved = inverse @ np.concatenate([_times(by_history, history), loads])
        return _times(update, np.append(history, solved))

    return advance


def _compiled(scheme: Scheme, oscillator: Oscillator, step: float) -> Callable[[Array, float], Array]:
    """Solve each stage's relations and its equilibrium as a system of three equations."""
    if scheme.coupled:
        return _at_once(scheme, oscillator, step)
    known = [past(kind, lag) for lag in range(MOST_LAGS) for kind in KINDS]
    solved: list[sp.Symbol] = []
    stages = []
    for index, declared in enumerate(scheme.stages, start=1):
        motion = [stage(kind, index) for kind in KINDS]
        matrix, right = sp.linear_eq_to_matrix([r.subs(STEP, step) for r in declared.relations], motion)
        balance = [oscillator.frequency**2, 2 * oscillator.zeta * oscillator.frequency, 1.0]
        system = np.vstack([np.array(matrix.tolist(), dtype=float), balance])
        stages.append((float(declared.instant), np.linalg.inv(system), _rows([*right], [*known, *solved])))
        solved += motion
    update = _rows([sp.sympify(scheme.update[kind]).subs(STEP, step) for kind in KINDS], [*known, *solved])

    def advance(history: Array, time: float) -> Array:
        available = history
        for instant, inverse, right in stages:
            load = oscillator.load(time + instant * step)
            available = np.append(available, inverse @ np.append(_times(right, available), load))
        return _times(update, available)

    return advance


def _rows(expressions: list[sp.Expr], symbols: list[sp.Symbol]) -> Array:
    matrix, constant = sp.linear_eq_to_matrix(expressions, symbols)
    assert not any(constant)
    return np.array(matrix.tolist(), dtype=float)


def _times(matrix: Array, values: Array) -> Array:
    """Matrix times vector; values whose column is zero may be no number."""
    used = matrix.any(axis=0)
    return matrix[:, used] @ values[used]
