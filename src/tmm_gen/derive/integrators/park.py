"""Park's method: the mean of two- and three-step backward differentiation."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import Integrator, Kind, Scheme, Stage, end_of_step, past, stage
from tmm_gen.derive.integrators.interpolation import Datum, backward_difference
from tmm_gen.derive.integrators.newmark import newmark_scheme


def park() -> Integrator:
    """Return Park's method, started by two trapezoidal steps.

    References
    ----------
    K. C. Park, An improved stiffly stable method for direct integration of nonlinear structural dynamic
    equations, J. Appl. Mech. 42 (1975).
    """
    only = Stage(sp.Integer(1), (_rate("q") - stage("v", 1), _rate("v") - stage("a", 1)))
    trapezoidal = newmark_scheme(sp.Rational(1, 4), sp.Rational(1, 2))
    return Integrator(
        name="park",
        title="Park 1975",
        source="Park (1975)",
        main=Scheme((only,), end_of_step()),
        startup=(trapezoidal, trapezoidal),
    )


def _rate(kind: Kind) -> sp.Expr:
    """Return the mean of the two backward differences of a quantity at ``t + h``."""
    older = [Datum(sp.Integer(-lag), past(kind, lag)) for lag in range(3)]
    two_step, three_step = (backward_difference(older[:count], stage(kind, 1)) for count in (2, 3))
    return sp.expand((two_step + three_step) / 2)
