from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import sympy as sp

from tmm_gen.derive.integrators.accuracy import leading_terms
from tmm_gen.derive.integrators.amplification import OMEGA, amplification
from tmm_gen.derive.integrators.declaration import (
    KINDS,
    STEP,
    Integrator,
    Scheme,
    Stage,
    end_of_step,
    past,
    stage,
)
from tmm_gen.derive.integrators.order import forced_order, free_order, order, startup_orders
from tmm_gen.derive.integrators.registry import all_integrators, integrator, names

LITERATURE = {
    "bathe": 2,
    "fox_euler": 1,
    "gauss2": 4,
    "gauss3": 6,
    "generalized_alpha": 2,
    "houbolt": 2,
    "mixed": 4,
    "newmark": 2,
    "park": 2,
    "radau2": 3,
    "radau3": 5,
    "sdirk2": 2,
    "sdirk4": 4,
    "wilson": 2,
    "zhai": 2,
    "zhou": 3,
}

VARIANTS: list[tuple[Integrator, int]] = [
    (integrator("newmark", beta=0), 2),
    (integrator("newmark", beta=1 / 6), 2),
    (integrator("newmark", beta=1 / 8), 2),
    (integrator("newmark", beta=0.3025, gamma=0.6), 1),
    (integrator("wilson", theta=1), 2),
    (integrator("zhou", g1=0, g2=0), 2),
    (integrator("zhai", psi=0, phi=0), 1),
    (integrator("mixed", delta=0.02), 4),
    (integrator("generalized_alpha", rho_inf=0), 2),
    (integrator("generalized_alpha", rho_inf=1), 2),
    (integrator("bathe", gamma=2 - sp.sqrt(2)), 2),
]


def label(value: object) -> str:
    if isinstance(value, Integrator):
        return "-".join([value.name, *(f"{k}={v}" for k, v in value.parameters.items())])
    return str(value)


def fitted_slope(errors: list[float], steps: list[float]) -> float:
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])


def test_every_integrator_is_in_this_table() -> None:
    assert sorted(LITERATURE) == list(names())


@pytest.mark.parametrize(
    ("method", "expected"),
    # one that is missing above has no order yet, and fails
    [*((method, LITERATURE.get(method.name, 0)) for method in all_integrators()), *VARIANTS],
    ids=label,
)
def test_derived_order_is_that_of_the_literature_and_of_a_simulation(
    method: Integrator, expected: int, simulate: Callable[..., np.ndarray], oscillator: type
) -> None:
    """Slopes of the largest error over a time, at five steps: damped free motion, and motion under a load."""
    assert order(method) == expected
    steps = [(0.08 if expected < 5 else 0.8) / 2**k for k in range(5)]
    for motion in (oscillator(zeta=0.1), oscillator(zeta=0.1, amplitude=0.8)):
        errors = []
        for step in steps:
            count = round(4 / step)
            computed = simulate(method, motion, step, count)[:2]
            errors.append(float(np.max(np.abs(computed - motion.exact(step * np.arange(count + 1))))))
        assert abs(fitted_slope(errors, steps) - expected) < 0.1, errors


def test_the_oscillators_closed_form_satisfies_its_equation(oscillator: type) -> None:
    motion = oscillator(frequency=2.0, zeta=0.1, amplitude=0.8)
    time, small = np.linspace(0, 3, 7), 1e-4
    before, now, after = (motion.exact(time + shift) for shift in (-small, 0.0, small))
    np.testing.assert_allclose((after[0] - before[0]) / (2 * small), now[1], atol=1e-7)
    acceleration = [motion.acceleration(t, q, v) for t, q, v in zip(time, *now, strict=True)]
    np.testing.assert_allclose((after[1] - before[1]) / (2 * small), acceleration, atol=1e-7)
    np.testing.assert_allclose(motion.exact(np.zeros(1))[:, 0], [1.0, 0.0], atol=1e-14)


def test_one_start_up_step_does_not_cost_the_proposed_method_its_order(
    simulate: Callable[..., np.ndarray], oscillator: type
) -> None:
    """The first step is of order 2; taken for every step it would be, taken once it is not seen."""
    zhou = integrator("zhou")
    assert min(startup_orders(zhou)) == 3
    assert (free_order(amplification(zhou.main)), free_order(amplification(zhou.startup[0]))) == (3, 2)

    steps = [0.08 / 2**k for k in range(5)]
    always_first = Integrator("first", "", "", main=zhou.startup[0])
    slopes = []
    for method in (zhou, always_first):
        errors = []
        for step in steps:
            count = round(4 / step)
            motion = oscillator(zeta=0.1)
            computed = simulate(method, motion, step, count)[0]
            errors.append(float(np.max(np.abs(computed - motion.exact(step * np.arange(count + 1))[0]))))
        slopes.append(fitted_slope(errors, steps))
    assert abs(slopes[0] - 3) < 0.1
    assert abs(slopes[1] - 2) < 0.1


def test_a_poor_start_up_lowers_the_order(simulate: Callable[..., np.ndarray], oscillator: type) -> None:
    """Started with one Fox-Euler step, the proposed method is no longer of order 3: derived and measured."""
    zhou, euler = integrator("zhou"), integrator("fox_euler")
    spoilt = Integrator("spoilt", "", "", main=zhou.main, startup=(euler.main,))
    derived = order(spoilt)
    assert derived == 2
    steps = [0.08 / 2**k for k in range(5)]
    errors = []
    for step in steps:
        count = round(4 / step)
        motion = oscillator(zeta=0.1)
        computed = simulate(spoilt, motion, step, count)[:2]
        errors.append(float(np.max(np.abs(computed - motion.exact(step * np.arange(count + 1))))))
    assert abs(fitted_slope(errors, steps) - derived) < 0.1


def test_a_load_read_at_the_wrong_instant_costs_order() -> None:
    """Free motion does not see it: the reason why both are derived."""
    wilson = integrator("wilson").main
    late = Scheme((Stage(sp.Integer(1), wilson.stages[0].relations),), wilson.update)
    assert free_order(amplification(late)) == 2
    assert forced_order(amplification(late)) == 1


def test_wilson_without_interpolation_back_is_not_consistent() -> None:
    wilson = integrator("wilson").main
    assert order(Integrator("stuck", "", "", main=Scheme(wilson.stages, end_of_step()))) == 0


def _cancelling(relation: sp.Expr, weight: sp.Symbol) -> sp.Expr:
    """Return the weight with which the lowest power of time that the relation misses is met too."""
    time = sp.Symbol("t", real=True)
    for power in range(2, 8):
        motion = {"q": time**power, "v": sp.diff(time**power, time), "a": sp.diff(time**power, time, 2)}
        at = {past(kind, lag): motion[kind].subs(time, -lag * STEP) for kind in KINDS for lag in (0, 1)}
        at |= {stage(kind, 1): motion[kind].subs(time, STEP) for kind in KINDS}
        error = sp.factor(relation.subs(at))
        if error != 0:
            (value,) = sp.solve(error, weight)
            return value
    raise ArithmeticError("the relation has no leading error")


def test_the_proposed_parameters_are_derived() -> None:
    """Gholampour (2018), eqs. 3-84 and 3-85, name 1/3 and 1/2."""
    g1, g2 = sp.symbols("g1 g2", real=True)
    displacement, velocity = integrator("zhou", g1=g1, g2=g2).main.stages[0].relations
    assert (_cancelling(velocity, g1), _cancelling(displacement, g2)) == (sp.S.One / 3, sp.S.Half)
    assert integrator("zhou").parameters == {"g1": sp.S.One / 3, "g2": sp.S.Half}
    time = sp.Symbol("t")
    for power in range(6):
        motion = {"q": time**power, "v": sp.diff(time**power, time), "a": sp.diff(time**power, time, 2)}
        at = {past(kind, lag): motion[kind].subs(time, -lag * STEP) for kind in KINDS for lag in (0, 1)}
        at |= {stage(kind, 1): motion[kind].subs(time, STEP) for kind in KINDS}
        errors = [sp.expand(relation.subs(at)) for relation in integrator("zhou").main.stages[0].relations]
        assert (errors == [0, 0]) == (power <= 4)


def test_the_proposed_methods_parameters_and_its_growth() -> None:
    """Only g1 decides the order; the growth per step that g2 = 1/2 leaves vanishes with g2 = 1."""
    assert order(integrator("zhou", g1=0)) == 2
    assert [order(integrator("zhou", g2=g2)) for g2 in (0, 0.5, 1)] == [3, 3, 3]
    damping = [leading_terms(amplification(integrator("zhou", g2=g2).main))[1] for g2 in (0, 0.5, 1, 1.25)]
    assert damping == [-(OMEGA**3) / 24, -(OMEGA**3) / 48, 0, OMEGA**3 / 96]
