"""Newmark's beta-gamma family, explicit for beta = 0."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Integrator, Scheme, Stage, end_of_step, past, stage

h = STEP


def newmark_scheme(beta: sp.Expr, gamma: sp.Expr, span: sp.Expr = sp.S.One) -> Scheme:
    """Return one Newmark step over ``span*h`` (Gholampour 2018, eqs. 3-54 and 3-55)."""
    q, v, a = past("q"), past("v"), past("a")
    dt = span * h
    return Scheme(
        stages=(
            Stage(
                instant=span,
                relations=(
                    q
                    + dt * v
                    + dt**2 * ((sp.Rational(1, 2) - beta) * a + beta * stage("a", 1))
                    - stage("q", 1),
                    v + dt * ((1 - gamma) * a + gamma * stage("a", 1)) - stage("v", 1),
                ),
            ),
        ),
        update=end_of_step(),
    )


def newmark(beta: sp.Expr, gamma: sp.Expr) -> Integrator:
    """Return Newmark's method.

    Parameters
    ----------
    beta, gamma : sympy.Expr
        1/4, 1/2 is the average, 1/6, 1/2 the linear acceleration; beta = 0 is explicit.

    References
    ----------
    N. M. Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85 (1959).
    """
    return Integrator(
        name="newmark",
        title="Newmark 1959",
        source="Newmark (1959); Gholampour (2018), eqs. 3-54, 3-55",
        main=newmark_scheme(beta, gamma),
        parameters={"beta": beta, "gamma": gamma},
    )
