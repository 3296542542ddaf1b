"""The implicit two-step method of Zhou & Zhou, which the thesis proposes."""

from __future__ import annotations

from functools import cache

import sympy as sp

from tmm_gen.derive.integrators.declaration import (
    STEP,
    Integrator,
    Kind,
    Scheme,
    Stage,
    end_of_step,
    past,
    stage,
)

h = STEP


def zhou(g1: sp.Expr | None = None, g2: sp.Expr | None = None) -> Integrator:
    """Return the method of Zhou & Zhou.

    Parameters
    ----------
    g1, g2 : sympy.Expr, optional
        Weights of the older acceleration in velocity and displacement; where absent, the values that cancel
        the leading error (:func:`optimal_pair`).

    References
    ----------
    J. Zhou, Y. Zhou, A new simple method of implicit time integration for dynamic problems of engineering
    structures, Acta Mech. Sin. 23 (2007); Gholampour (2018), eqs. 3-80, 3-81, 3-84, 3-85.
    """
    best1, best2 = optimal_pair()
    g1, g2 = best1 if g1 is None else g1, best2 if g2 is None else g2
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


@cache
def optimal_pair() -> tuple[sp.Expr, sp.Expr]:
    """Return the ``(g1, g2)`` that cancel the leading errors of velocity and displacement (3-84, 3-85)."""
    g1, g2 = sp.symbols("g1 g2", real=True)
    displacement, velocity = _scheme(g1, g2).stages[0].relations
    return _cancelling(velocity, g1), _cancelling(displacement, g2)


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


def _cancelling(relation: sp.Expr, weight: sp.Symbol) -> sp.Expr:
    """Return the weight with which the lowest power of time that the relation misses is met too."""
    time = sp.Symbol("t", real=True)
    for power in range(2, 8):
        motion = {"q": time**power, "v": sp.diff(time**power, time), "a": sp.diff(time**power, time, 2)}
        kinds: tuple[Kind, ...] = ("q", "v", "a")
        at = {past(kind, lag): motion[kind].subs(time, -lag * h) for kind in kinds for lag in (0, 1)}
        at |= {stage(kind, 1): motion[kind].subs(time, h) for kind in kinds}
        error = sp.factor(relation.subs(at))
        if error != 0:
            (value,) = sp.solve(error, weight)
            return value
    raise ArithmeticError("the relation has no leading error")
