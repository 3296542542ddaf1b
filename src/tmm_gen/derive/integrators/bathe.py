"""Bathe's composite method: a trapezoidal stage, then three-point backward differentiation."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import Integrator, Kind, Scheme, Stage, end_of_step, past, stage
from tmm_gen.derive.integrators.interpolation import Datum, backward_difference
from tmm_gen.derive.integrators.newmark import newmark_scheme


def bathe(gamma: sp.Expr) -> Integrator:
    """Return Bathe's method.

    Parameters
    ----------
    gamma : sympy.Expr
        The first stage ends at ``t + gamma*h``. With 2 - sqrt(2) both
        stages have equal gains.

    References
    ----------
    K. J. Bathe, M. M. I. Baig, On a composite implicit time integration procedure for nonlinear dynamics,
    Computers & Structures 83 (2005).
    """
    trapezoidal = newmark_scheme(sp.Rational(1, 4), sp.Rational(1, 2), span=gamma).stages[0]
    backward = Stage(sp.Integer(1), (_rate("q", gamma) - stage("v", 2), _rate("v", gamma) - stage("a", 2)))
    return Integrator(
        name="bathe",
        title="Bathe 2005, two stages",
        source="Bathe & Baig (2005)",
        main=Scheme((trapezoidal, backward), end_of_step(2)),
        parameters={"gamma": gamma},
    )


def _rate(kind: Kind, gamma: sp.Expr) -> sp.Expr:
    """Return the derivative at ``t + h`` of the parabola through a quantity at ``t`` and at both stages."""
    older = [Datum(sp.Integer(0), past(kind)), Datum(gamma, stage(kind, 1))]
    return backward_difference(older, stage(kind, 2))
