"""The implicit two-step method of Zhou & Zhou, which the thesis proposes."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import (
    STEP,
    Integrator,
    Scheme,
    Stage,
    end_of_step,
    past,
    stage,
)

h = STEP


def zhou(g1: sp.Expr, g2: sp.Expr) -> Integrator:
    """Return the method of Zhou & Zhou.

    Parameters
    ----------
    g1, g2 : sympy.Expr
        Weights of the older acceleration in velocity and displacement; 1/3 and 1/2 cancel the leading errors of both.

    References
    ----------
    J. Zhou, Y. Zhou, A new simple method of implicit time integration for dynamic problems of engineering
    structures, Acta Mech. Sin. 23 (2007); Gholampour (2018), eqs. 3-80, 3-81, 3-84, 3-85.
    """
    zero = sp.Integer(0)
    return Integrator(
        name="zhou",
        title="Zhou & Zhou 2007, proposed by Gholampour 2018",
        source="Zhou & Zhou (2007); Gholampour (2018), eqs. 3-80, 3-81",
        main=_scheme(g1, g2),
        # With both weights zero no older acceleration is needed; a linear acceleration, order 2.
        startup=(_scheme(zero, zero),),
        parameters={"g1": g1, "g2": g2},
    )


def _scheme(g1: sp.Expr, g2: sp.Expr) -> Scheme:
    """Return one step (3-80, 3-81)."""
    q, v, newest, older, new = past("q"), past("v"), past("a"), past("a", 1), stage("a", 1)
    only = Stage(
        instant=sp.Integer(1),
        relations=(
            q
            + h * v
            + h**2 * ((2 + g2) / 6 * newest + (2 - g2) / 12 * new - g2 / 12 * older)
            - stage("q", 1),
            v + h * ((1 + g1) / 2 * newest + (2 - g1) / 4 * new - g1 / 4 * older) - stage("v", 1),
        ),
    )
    return Scheme((only,), end_of_step())
