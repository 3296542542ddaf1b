"""What coefficients do to the thesis's two-station sample (table 3-2), beside its exact response."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from scipy.linalg import expm

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Integrator, Kind, Past, Scheme, past, stage
from tmm_gen.derive.integrators.history import history_of
from tmm_gen.derive.integrators.relations import discrete_coefficients

Array = NDArray[np.float64]
Replacements = Mapping[int, Mapping[str, sp.Expr]]
"""By the number of the scheme, start-up first: coefficients to be put in place of derived ones."""

DURATION = 20.0
"""Seconds over which responses are compared."""

_BAND = 0.05
_DIVERGED = 1e6

_MASS = np.diag([5.0, 5.0])
_STIFFNESS = np.array([[40.0, -20.0], [-20.0, 20.0]])
_DAMPING = np.array([[10.0, -5.0], [-5.0, 5.0]])
_LOAD = np.array([0.0, 1.0])
_STATIC = np.linalg.solve(_STIFFNESS, _LOAD)


@dataclass(frozen=True)
class Response:
    """Tip angle of the sample after the load is applied at rest.

    Parameters
    ----------
    rms_error : float
        Against the exact response, relative to the static deflection; infinite if it diverges.
    settling_time : float
        Seconds after which the tip stays within 5 % of the static deflection; infinite if it does not.
    final : float
        Tip angle at the end, relative to the static deflection.
    diverged_at : float or None
        Seconds after which the tip angle exceeds 1e6 rad.
    tip : numpy.ndarray
        (steps + 1,), rad; up to divergence.
    """

    rms_error: float
    settling_time: float
    final: float
    diverged_at: float | None
    tip: Array


def simulate(integrator: Integrator, step: float, replaced: Replacements | None = None) -> Response:
    """Run the sample with ``a = A q + B``, ``v = D q + E``, some coefficients replaced.

    Parameters
    ----------
    integrator : Integrator
        Implicit, one stage a step.
    step : float
        Seconds.
    replaced : mapping, optional
        Coefficients to be used instead of the derived ones.
    """
    replaced = replaced or {}
    kept = history_of(integrator.schemes, "displacement")
    solvers = [
        _solver(scheme, kept, step, replaced.get(k, {})) for k, scheme in enumerate(integrator.schemes)
    ]
    rest = np.zeros(2)
    known = dict.fromkeys(kept, rest) | {Past("a", 0): np.linalg.solve(_MASS, _LOAD)}
    steps = round(DURATION / step)
    tip = [0.0]
    for k in range(steps):
        new = solvers[min(k, len(solvers) - 1)](known)
        known = {p: new[p.kind] if p.lag == 0 else known[Past(p.kind, p.lag - 1)] for p in known}
        tip.append(float(new["q"][1]))
        if not abs(tip[-1]) <= _DIVERGED:
            break
    return _measured(np.array(tip), step)


@cache
def exact_tip(step: float) -> Array:
    """Return the exact tip angle at every step, (steps + 1,), by the matrix exponential."""
    inverse = np.linalg.inv(_MASS)
    system = np.zeros((5, 5))
    system[:2, 2:4] = np.eye(2)
    system[2:4, :2], system[2:4, 2:4], system[2:4, 4] = (
        -inverse @ _STIFFNESS,
        -inverse @ _DAMPING,
        inverse @ _LOAD,
    )
    advance = expm(system * step)
    state = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
    tip = [0.0]
    for _ in range(round(DURATION / step)):
        state = advance @ state
        tip.append(state[1])
    return np.array(tip)


def settling_time(tip: Array, step: float) -> float:
    """Return the time after which the tip stays within 5 % of the static deflection, infinite if never."""
    outside = np.flatnonzero(np.abs(tip / _STATIC[1] - 1) > _BAND)
    if outside.size == 0:
        return 0.0
    return float("inf") if outside[-1] == tip.size - 1 else float((outside[-1] + 1) * step)


def _solver(
    scheme: Scheme, kept: tuple[Past, ...], step: float, replaced: Mapping[str, sp.Expr]
) -> Callable[[Mapping[Past, Array]], dict[Kind, Array]]:
    """Return a function from the known history to the new ``q, v, a``."""
    derived = discrete_coefficients(scheme)
    symbols = [past(p.kind, p.lag) for p in kept]
    chosen = {name: replaced.get(name, getattr(derived, name)) for name in "ABDE"}
    of_history = {
        name: sp.lambdify(symbols, value.subs(STEP, step), "numpy") for name, value in chosen.items()
    }
    gain_a, gain_v = float(chosen["A"].subs(STEP, step)), float(chosen["D"].subs(STEP, step))
    effective = gain_a * _MASS + gain_v * _DAMPING + _STIFFNESS
    update = sp.lambdify(
        [*symbols, *(stage(kind, 1) for kind in KINDS)],
        [sp.sympify(scheme.update[kind]).subs(STEP, step) for kind in KINDS],
        "numpy",
    )

    def advance(known: Mapping[Past, Array]) -> dict[Kind, Array]:
        values = [known[p] for p in kept]
        offset_a, offset_v = of_history["B"](*values), of_history["E"](*values)
        q = np.linalg.solve(effective, _LOAD - _MASS @ offset_a - _DAMPING @ offset_v)
        new = update(*values, q, gain_v * q + offset_v, gain_a * q + offset_a)
        return dict(zip(KINDS, new, strict=True))

    return advance


def _measured(tip: Array, step: float) -> Response:
    diverged = not abs(tip[-1]) <= _DIVERGED
    error = (tip - exact_tip(step)[: tip.size]) / _STATIC[1]
    return Response(
        rms_error=float("inf") if diverged else float(np.sqrt(np.mean(error**2))),
        settling_time=float("inf") if diverged else settling_time(tip, step),
        final=float(tip[-1] / _STATIC[1]),
        diverged_at=(tip.size - 1) * step if diverged else None,
        tip=tip,
    )
