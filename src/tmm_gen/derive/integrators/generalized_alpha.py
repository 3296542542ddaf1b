"""The generalised-alpha method: equilibrium of weighted quantities, dissipation chosen at high frequency."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Integrator, Kind, Scheme, Stage, past, stage

h = STEP


def generalized_alpha(rho_inf: sp.Expr) -> Integrator:
    """Return the generalised-alpha method.

    Parameters
    ----------
    rho_inf : sympy.Expr
        Spectral radius at infinite frequency, from 0 (annihilation) to 1 (no dissipation).

    References
    ----------
    J. Chung, G. M. Hulbert, A time integration algorithm for structural dynamics with improved numerical
    dissipation: the generalized-alpha method, J. Appl. Mech. 60 (1993).
    """
    alpha_m = (2 * rho_inf - 1) / (rho_inf + 1)
    alpha_f = rho_inf / (rho_inf + 1)
    gamma = sp.Rational(1, 2) - alpha_m + alpha_f
    beta = (1 - alpha_m + alpha_f) ** 2 / 4
    # The stage's acceleration is the weighted one, (1 - alpha_m) a_new + alpha_m a.
    new: dict[Kind, sp.Expr] = {"a": (stage("a", 1) - alpha_m * past("a")) / (1 - alpha_m)}
    new["v"] = past("v") + h * ((1 - gamma) * past("a") + gamma * new["a"])
    new["q"] = past("q") + h * past("v") + h**2 * ((sp.Rational(1, 2) - beta) * past("a") + beta * new["a"])
    weighted = [(1 - alpha_f) * new[kind] + alpha_f * past(kind) - stage(kind, 1) for kind in ("q", "v")]
    return Integrator(
        name="generalized_alpha",
        title="Generalised alpha (Chung & Hulbert 1993)",
        source="Chung & Hulbert (1993)",
        main=Scheme(
            (Stage(1 - alpha_f, (sp.expand(weighted[0]), sp.expand(weighted[1]))),),
            {kind: sp.expand(value) for kind, value in new.items()},
        ),
        parameters={"rho_inf": rho_inf},
    )
