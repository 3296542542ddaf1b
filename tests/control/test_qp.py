"""Quadratic programs: optimal where they say so, and no word taken for it where not."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.command import Status
from tmm_gen.control.quadratic.iterations import at_first
from tmm_gen.control.quadratic.qp import QuadraticProgram

LIMIT = 200
"""Iterations, more than any of these takes."""


def random_problem(seed: int, size: int = 12, rows: int = 8) -> tuple[np.ndarray, ...]:
    random = np.random.default_rng(seed)
    factor = random.standard_normal((size, size))
    hessian = factor @ factor.T + 0.1 * np.eye(size)
    return hessian, random.standard_normal((rows, size)), 3.0 * random.standard_normal(size)


@pytest.mark.parametrize("seed", range(5))
def test_the_solution_satisfies_the_conditions_of_optimality(seed: int) -> None:
    """Projected gradient steps of the dual solve the same problem without a line in common."""
    hessian, rows, gradient = random_problem(seed)
    size = len(hessian)
    low, high = np.full(size + len(rows), -0.5), np.full(size + len(rows), 0.7)
    solution = QuadraticProgram(hessian, rows, size, LIMIT).solve(gradient, low, high)
    assert solution.status is Status.OK
    whole = np.vstack([np.eye(size), rows])
    values = whole @ solution.point
    assert np.all(values >= low - 1e-6)
    assert np.all(values <= high + 1e-6)
    # the gradient is a combination of active rows, of the right signs
    active = np.flatnonzero((values < low + 1e-6) | (values > high - 1e-6))
    left = -(hessian @ solution.point + gradient)
    multipliers, *_ = np.linalg.lstsq(whole[active].T, left, rcond=None)
    assert_allclose(whole[active].T @ multipliers, left, atol=1e-6)
    upper = values[active] > high[active] - 1e-6
    assert np.all(np.where(upper, multipliers, -multipliers) > -1e-6)


def test_a_warm_start_changes_nothing() -> None:
    hessian, rows, gradient = random_problem(7)
    low, high = np.full(20, -0.5), np.full(20, 0.5)
    program = QuadraticProgram(hessian, rows, 12, LIMIT)
    for turn in range(4):
        asked = (1.0 - 0.5 * turn) * gradient
        fresh = QuadraticProgram(hessian, rows, 12, LIMIT).solve(asked, low, high)
        assert_allclose(program.solve(asked, low, high).point, fresh.point, atol=1e-7)
    program.forget()
    assert_allclose(program.solve(asked, low, high).point, fresh.point, atol=1e-7)


def test_new_hessians_and_rows_are_taken() -> None:
    hessian, rows, gradient = random_problem(1)
    other, more, _ = random_problem(2)
    low, high = np.full(20, -0.5), np.full(20, 0.5)
    program = QuadraticProgram(hessian, rows, 12, LIMIT)
    program.solve(gradient, low, high)
    changed = program.solve(gradient, low, high, hessian=other, rows=more)
    assert_allclose(
        changed.point, QuadraticProgram(other, more, 12, LIMIT).solve(gradient, low, high).point, atol=1e-7
    )


def test_what_cannot_be_solved_is_said_and_forgotten() -> None:
    hessian, rows, gradient = random_problem(3)
    low, high = np.full(20, -0.5), np.full(20, 0.5)
    program = QuadraticProgram(hessian, rows, 12, LIMIT)
    good = program.solve(gradient, low, high)
    apart = high.copy()
    apart[-1] = -2.0
    assert program.solve(gradient, low, apart).status is Status.INFEASIBLE  # low above high
    conflicting = low.copy(), high.copy()
    conflicting[0][12:], conflicting[1][12:] = 50.0, 60.0  # rows that bounded variables cannot reach
    assert program.solve(gradient, *conflicting).status is Status.INFEASIBLE
    assert program.solve(gradient * np.nan, low, high).status is Status.NOT_FINITE
    assert program.solve(gradient, low * np.nan, high).status is Status.NOT_FINITE
    assert_allclose(program.solve(gradient, low, high).point, good.point, atol=1e-7)


def test_an_indefinite_hessian_is_refused() -> None:
    with pytest.raises(ArithmeticError, match="positive definite"):
        QuadraticProgram(np.diag([1.0, -1.0]), np.zeros((1, 2)), 2, LIMIT)


@pytest.mark.parametrize("weight", [1e2, 1e12, 1e300])
def test_slacks_may_weigh_whatever_they_do(weight: float) -> None:
    """``1/2 (x - 2)^2 + W s^2 / 2`` under ``x - s <= 1``: so ``s = 1 / (1 + W)``; with all handed in anew too."""
    hessian, rows, gradient = np.diag([1.0, weight]), np.array([[1.0, -1.0]]), np.array([-2.0, 0.0])
    program = QuadraticProgram(hessian, rows, 1, LIMIT)
    low, high = np.array([-5.0, -np.inf]), np.array([5.0, 1.0])
    for anew in ({}, {"hessian": hessian, "rows": rows}):
        found = program.solve(gradient, low, high, **anew)
        assert found.status is Status.OK
        assert_allclose(
            found.point, [1.0 + 1.0 / (1.0 + weight), 1.0 / (1.0 + weight)], rtol=1e-9, atol=1e-300
        )


def test_no_rows_at_all_are_updated_too() -> None:
    """As where a scene bounds nothing but its torques."""
    hessian, _, gradient = random_problem(3)
    low, high, none = np.full(12, -0.5), np.full(12, 0.5), np.empty((0, 12))
    program = QuadraticProgram(hessian, none, 12, LIMIT)
    program.solve(gradient, low, high)
    other = hessian + np.eye(12)
    again = program.solve(gradient, low, high, hessian=other, rows=none)
    assert again.status is Status.OK
    assert_allclose(
        again.point, QuadraticProgram(other, none, 12, LIMIT).solve(gradient, low, high).point, atol=1e-7
    )


def test_iterations_are_bounded_and_some_are_left_for_a_solution_without_soft_bounds() -> None:
    """Of those allowed two thirds go into the first search at most, whatever it takes."""
    hessian, rows, gradient = random_problem(5, size=30, rows=40)
    low, high = np.full(70, -0.3), np.full(70, 0.3)
    low[30:], high[30:] = -0.01, 0.01
    soft = np.arange(70) >= 30

    def program(limit: int) -> QuadraticProgram:
        return QuadraticProgram(hessian, rows, 30, limit)

    whole = program(LIMIT).solve(gradient, low, high)
    alone = program(LIMIT).solve(gradient, np.where(soft, -np.inf, low), np.where(soft, np.inf, high))
    assert alone.iterations < whole.iterations - at_first(whole.iterations)
    enough, short = program(2 * whole.iterations), program(whole.iterations)
    assert enough.solve_softly(gradient, low, high, soft).status is Status.OK
    found = short.solve_softly(gradient, low, high, soft)
    assert found.status is Status.RELAXED
    assert found.iterations == at_first(whole.iterations) + alone.iterations
    assert_allclose(found.point, alone.point, atol=1e-9)
    none = program(alone.iterations).solve_softly(gradient, low, high, soft)
    assert none.status is Status.ITERATIONS
    assert none.iterations <= alone.iterations
