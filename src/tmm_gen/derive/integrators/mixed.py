"""The mixed multi-step method of order 4: weights of four accelerations, from order conditions and stability."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

import sympy as sp

from tmm_gen.derive.integrators.collocation import TIME, lagrange
from tmm_gen.derive.integrators.declaration import STEP, Integrator, Scheme, Stage, end_of_step, past, stage
from tmm_gen.derive.integrators.newmark import newmark_scheme

h = STEP
INSTANTS = tuple(map(sp.Integer, (1, 0, -1, -2)))
"""Of the accelerations that a step weighs, in steps from the newest known instant."""


def mixed(delta: sp.Expr) -> Integrator:
    """Return the mixed multi-step method of order 4.

    Velocity and displacement at the end of a step are the last ones plus weighted accelerations of the end and of three
    instants before it. Weights on older velocities as well would give no other method: velocities differ by weighted
    accelerations. Velocities have the weights of order 4. Those of displacements keep one free weight at that order,
    and it decides stability: with ``delta = 0`` free motion without damping neither decays nor grows up to the largest
    limit that any method of order above 2 with one equilibrium a step has, ``sqrt(6)``.

    Parameters
    ----------
    delta : sympy.Expr
        Of the third difference of accelerations, taken from the displacement: damps by ``delta Omega^5 / 2`` of a
        damping ratio and lowers the limit to ``sqrt(6/(1 + 24 delta))``.

    Notes
    -----
    The paper of 2010 was not at hand. Its tables are not reproduced: weights are derived here, for a form that two
    papers are known by, and may be others than theirs.

    References
    ----------
    M. Rezaiee-Pajand, J. Alamatian, Implicit higher-order accuracy method for numerical integration in dynamic
    analysis, J. Struct. Eng. 134 (2008); M. Rezaiee-Pajand, S. R. Sarafrazi, A mixed and multi-step higher-order
    implicit time integration family, Proc. IMechE Part C 224 (2010). Cited by Gholampour (2018).
    """
    speeds, places = stable_weights()
    third = [(-1) ** k * sp.binomial(3, k) for k in range(4)]
    weights = [place - delta * difference for place, difference in zip(places, third, strict=True)]
    return Integrator(
        name="mixed",
        title="mixed multi-step, order 4, in the form of Rezaiee-Pajand & Sarafrazi 2010",
        source="form of Rezaiee-Pajand & Sarafrazi (2010); weights derived",
        main=Scheme((_end(INSTANTS, speeds, weights, _known(1)),), end_of_step()),
        startup=(_first(), _ended(INSTANTS[:3])),
        parameters={"delta": delta},
    )


@cache
def stable_weights() -> tuple[tuple[sp.Expr, ...], tuple[sp.Expr, ...]]:
    """Return weights of velocity and displacement with which free motion has the largest limit of stability.

    By the cubic through four accelerations velocities are right to order 4. Displacements of three instants with
    velocities eliminated are to obey ``q_new - 2 q + q_old = h^2 (accelerations)`` with what the parabola through three
    accelerations adds over one step ahead and one step back (Numerov's formula, of order 4).
    """
    speeds = integral_weights(INSTANTS, 1)
    ahead = integral_weights(INSTANTS[:3], 2)
    wanted = [*(one + other for one, other in zip(ahead, reversed(ahead), strict=True)), sp.S.Zero]
    # two steps' displacements differ by a step of the older velocity, and these by what the older step added
    older = [sp.S.Zero, *speeds[:-1]]
    places: list[sp.Expr] = []
    for sought, velocity in zip(wanted, older, strict=True):
        places.append((places[-1] if places else sp.S.Zero) + sought - velocity)
    return speeds, tuple(places)


def integral_weights(instants: tuple[sp.Expr, ...], times: int) -> tuple[sp.Expr, ...]:
    """Return weights of accelerations in the integral over the step, ``times`` over, of the polynomial through them."""
    found = []
    for polynomial in lagrange(instants):
        for _ in range(times):
            polynomial = sp.integrate(polynomial, TIME)
        found.append(polynomial.subs(TIME, 1))
    return tuple(found)


def _known(last: int) -> Mapping[sp.Expr, sp.Expr]:
    """Return accelerations by instant: those of the history, and of stage ``last`` at the end of the step."""
    return {sp.Integer(1): stage("a", last), **{sp.Integer(-lag): past("a", lag) for lag in range(3)}}


def _end(
    instants: Sequence[sp.Expr],
    speeds: Sequence[sp.Expr],
    places: Sequence[sp.Expr],
    accelerations: Mapping[sp.Expr, sp.Expr],
    index: int = 1,
) -> Stage:
    """Return the stage at the end of the step."""

    def summed(weights: Sequence[sp.Expr]) -> sp.Expr:
        return sp.Add(*(w * accelerations[at] for w, at in zip(weights, instants, strict=True)))

    return Stage(
        sp.Integer(1),
        (
            past("q") + h * past("v") + h**2 * summed(places) - stage("q", index),
            past("v") + h * summed(speeds) - stage("v", index),
        ),
    )


def _ended(instants: tuple[sp.Expr, ...]) -> Scheme:
    """Return a step whose accelerations lie on a polynomial: one power of the step less is right, for once."""
    weights = integral_weights(instants, 1), integral_weights(instants, 2)
    return Scheme((_end(instants, *weights, _known(1)),), end_of_step())


def _first() -> Scheme:
    """Return the first step, which has one acceleration to look back to: it makes another on the way.

    In the middle of the step that would leave its end explicit: displacements there would not read its acceleration.
    """
    inside = sp.Rational(1, 3)
    early = newmark_scheme(sp.Rational(1, 6), sp.Rational(1, 2), span=inside).stages[0]
    instants = (sp.Integer(1), inside, sp.Integer(0))
    known = {**_known(2), inside: stage("a", 1)}
    end = _end(instants, integral_weights(instants, 1), integral_weights(instants, 2), known, index=2)
    return Scheme((early, end), end_of_step(2))
