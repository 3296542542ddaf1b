"""Wilson's theta method, with the interpolation back to ``t + h`` that makes it consistent."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Integrator, Kind, Scheme, Stage, past, stage
from tmm_gen.derive.integrators.interpolation import TIME, Datum, interpolant

h = STEP


def wilson(theta: sp.Expr) -> Integrator:
    """Return Wilson's method.

    Parameters
    ----------
    theta : sympy.Expr
        Equilibrium is imposed at ``t + theta*h``, over which the acceleration is linear. From
        about 1.366 the method is unconditionally stable; 1 is Newmark 1/6.

    References
    ----------
    E. L. Wilson, I. Farhoomand, K. J. Bathe, Nonlinear dynamic analysis of complex structures, Earthquake
    Eng. Struct. Dyn. 1 (1973); Gholampour (2018), eqs. 3-60 to 3-64.
    """
    acceleration = interpolant([Datum(sp.Integer(0), past("a")), Datum(theta, stage("a", 1))])
    velocity = past("v") + h * _integral(acceleration)
    displacement = past("q") + h * _integral(velocity)
    motion: dict[Kind, sp.Expr] = {"q": displacement, "v": velocity, "a": acceleration}
    only = Stage(
        instant=theta,
        relations=(
            sp.expand(displacement.subs(TIME, theta)) - stage("q", 1),
            sp.expand(velocity.subs(TIME, theta)) - stage("v", 1),
        ),
    )
    return Integrator(
        name="wilson",
        title="Wilson theta (Wilson, Farhoomand & Bathe 1973)",
        source="Wilson, Farhoomand & Bathe (1973); Gholampour (2018), eqs. 3-60 to 3-64",
        main=Scheme((only,), {kind: sp.expand(value.subs(TIME, 1)) for kind, value in motion.items()}),
        parameters={"theta": theta},
    )


def _integral(polynomial: sp.Expr) -> sp.Expr:
    """Integrate from the start of the step to ``TIME``, in steps."""
    return sp.integrate(sp.expand(polynomial), TIME)
