"""Everything a table of integrators shows, derived from one declaration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.accuracy import leading_terms
from tmm_gen.derive.integrators.amplification import amplification
from tmm_gen.derive.integrators.declaration import Integrator, Scheme
from tmm_gen.derive.integrators.history import history_depth
from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.parameters import Number
from tmm_gen.derive.integrators.relations import affine_motion
from tmm_gen.derive.integrators.stability import radius_at_infinity, stability_limit


@dataclass(frozen=True)
class Analysis:
    """Derived properties of an integrator.

    Parameters
    ----------
    name, title, source : str
        As declared.
    parameters : mapping from str to sympy.Expr
        As bound.
    stages : int
        Equilibria, that is sweeps, a step.
    startup_steps : int
        First steps with formulas of their own.
    history_depth : int
        Instants the main step looks back to.
    explicit : bool
        New displacements do not depend on new accelerations.
    order : int
        Of displacement and velocity, start-up included.
    stability_limit : sympy.Expr
        Largest ``Omega = w h`` without physical damping; infinite, or zero where motion grows at any step.
    zeta : float
        Physical damping ratio of the next one.
    stability_limit_damped : sympy.Expr
        Largest ``Omega`` at that damping ratio.
    rho_infinity : sympy.Expr
        Spectral radius for ``Omega`` to infinity.
    period_error, numerical_damping : sympy.Expr
        Leading terms in ``Omega``, undamped; relative, and a damping ratio.
    """

    name: str
    title: str
    source: str
    parameters: Mapping[str, sp.Expr]
    stages: int
    startup_steps: int
    history_depth: int
    explicit: bool
    order: int
    stability_limit: sp.Expr
    zeta: float
    stability_limit_damped: sp.Expr
    rho_infinity: sp.Expr
    period_error: sp.Expr
    numerical_damping: sp.Expr


def analyse(integrator: Integrator, zeta: Number = 0) -> Analysis:
    """Derive the properties of an integrator whose parameters are numbers.

    Parameters
    ----------
    integrator : Integrator
        All of whose parameters are numbers.
    zeta : number
        Physical damping ratio of ``stability_limit_damped``.
    """
    linear = amplification(integrator.main)
    period_error, numerical_damping = leading_terms(linear)
    undamped = stability_limit(linear)
    return Analysis(
        name=integrator.name,
        title=integrator.title,
        source=integrator.source,
        parameters=integrator.parameters,
        stages=len(integrator.main.stages),
        startup_steps=len(integrator.startup),
        history_depth=history_depth(integrator),
        explicit=is_explicit(integrator.main),
        order=order(integrator, linear),
        stability_limit=undamped,
        zeta=float(zeta),
        stability_limit_damped=stability_limit(linear, zeta) if zeta else undamped,
        rho_infinity=radius_at_infinity(linear),
        period_error=period_error,
        numerical_damping=numerical_damping,
    )


def is_explicit(scheme: Scheme) -> bool:
    """Return whether no stage's displacement depends on its own acceleration."""
    stages = range(1, len(scheme.stages) + 1)
    return all(affine_motion(scheme, index, "acceleration").gain["q"] == 0 for index in stages)
