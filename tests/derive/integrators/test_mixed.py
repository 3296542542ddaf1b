"""The mixed multi-step method: where its weights come from, and that none are better."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.accuracy import leading_terms
from tmm_gen.derive.integrators.amplification import LAMBDA, OMEGA, Amplification, amplification
from tmm_gen.derive.integrators.declaration import KINDS, STEP, Integrator, past, stage
from tmm_gen.derive.integrators.mixed import INSTANTS, integral_weights, mixed, stable_weights
from tmm_gen.derive.integrators.order import order, startup_orders
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.stability import at_damping, stability_limit

LIMIT = sp.Symbol("H", positive=True)
NUMEROV = (LAMBDA**2 + 10 * LAMBDA + 1) / 12


def linear(delta: sp.Expr) -> Amplification:
    """Return the main step for a weight, also one that scenes may not name."""
    return amplification(mixed(delta).main)


def test_weights_are_those_of_adams_moulton_and_numerov() -> None:
    assert stable_weights()[0] == tuple(sp.Rational(n, 24) for n in (9, 19, -5, 1))
    free = at_damping(linear(sp.S.Zero), 0)
    assert free.monic() == sp.Poly((LAMBDA - 1) ** 2 + OMEGA**2 * NUMEROV, LAMBDA, OMEGA).monic()


def test_both_relations_hold_for_powers_of_time_up_to_the_fourth() -> None:
    relations = mixed(sp.Rational(1, 50)).main.stages[0].relations
    time = sp.Symbol("t", real=True)
    for power in range(6):
        motion = {"q": time**power, "v": sp.diff(time**power, time), "a": sp.diff(time**power, time, 2)}
        at = {past(kind, lag): motion[kind].subs(time, -lag * STEP) for kind in KINDS for lag in range(3)}
        at |= {stage(kind, 1): motion[kind].subs(time, STEP) for kind in KINDS}
        errors = [sp.expand(relation.subs(at)) for relation in relations]
        assert (errors == [0, 0]) == (power <= 4)


def test_the_free_weight_damps_and_lowers_the_limit() -> None:
    for delta in (sp.S.Zero, sp.Rational(1, 100), sp.Rational(1, 32)):
        assert stability_limit(linear(delta)) ** 2 == sp.Rational(6) / (1 + 24 * delta)
        assert leading_terms(linear(delta))[1] == delta * OMEGA**5 / 2
    assert stability_limit(linear(sp.Rational(-1, 1000))) == 0
    assert leading_terms(linear(sp.Rational(1, 240)))[0].as_poly(OMEGA).degree() == 6


def test_with_displacements_right_to_one_order_more_motion_grows_at_any_step() -> None:
    excess = [b - a for a, b in zip(integral_weights(INSTANTS, 2), stable_weights()[1], strict=True)]
    assert excess == [excess[0] * n for n in (1, -3, 3, -1)]
    assert excess[0] == sp.Rational(-1, 45)  # delta, which must not be negative


def test_no_method_of_order_above_two_with_one_equilibrium_has_a_larger_limit() -> None:
    """The steps of docs/integrators.md; ``s`` is there in place of an eigenvalue outside the circle."""
    s = sp.Symbol("s", positive=True)
    logarithm = sp.series(2 * sp.atanh(s), s, 0, 6).removeO()
    root = sp.series(sp.sqrt(1 / logarithm**2 + 1 / LIMIT**2), s, 0, 2).removeO()
    assert sp.expand(root - 1 / (2 * s) - s * (1 / LIMIT**2 - sp.Rational(1, 6))) == 0
    # where nothing is left of it but the pole, the method is Numerov's
    outside = (LAMBDA - 1) / (LAMBDA + 1)
    assert sp.cancel(1 / (2 * outside) ** 2 - sp.Rational(1, 6) - NUMEROV / (LAMBDA - 1) ** 2) == 0


def test_first_steps_do_not_cost_it_its_order() -> None:
    method, poor = integrator("mixed"), integrator("newmark", beta=1 / 6).main
    assert min(startup_orders(method)) == 4
    assert order(Integrator("spoilt", "", "", main=method.main, startup=(poor, method.startup[1]))) == 3
