"""Zhai's explicit two-step method."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Integrator, Scheme, Stage, end_of_step, past, stage

h = STEP


def zhai(psi: sp.Expr, phi: sp.Expr) -> Integrator:
    """Return Zhai's method; equilibrium at ``t + h`` only yields the new acceleration.

    Parameters
    ----------
    psi, phi : sympy.Expr
        Weights of the older acceleration in displacement and velocity; zero in the first step, which has
        none.

    References
    ----------
    W. M. Zhai, Two simple fast integration methods for large-scale dynamic problems in engineering, Int. J.
    Numer. Methods Eng. 39 (1996).
    """
    return Integrator(
        name="zhai",
        title="Zhai 1996, explicit",
        source="Zhai (1996)",
        main=_scheme(psi, phi),
        startup=(_scheme(sp.Integer(0), sp.Integer(0)),),
        parameters={"psi": psi, "phi": phi},
    )


def _scheme(psi: sp.Expr, phi: sp.Expr) -> Scheme:
    q, v, newest, older = past("q"), past("v"), past("a"), past("a", 1)
    only = Stage(
        instant=sp.Integer(1),
        relations=(
            q + h * v + h**2 * ((sp.Rational(1, 2) + psi) * newest - psi * older) - stage("q", 1),
            v + h * ((1 + phi) * newest - phi * older) - stage("v", 1),
        ),
    )
    return Scheme((only,), end_of_step())
