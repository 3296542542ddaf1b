"""Samples of rounding errors: of the size of real ones, and no larger where errors cancel."""

from __future__ import annotations

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.emit.c.estimate import Estimate, cosine, root, sine

UNIT = 2.0**-53
numbers = st.floats(0.1, 10.0) | st.floats(-10.0, -0.1)


def exact(x: float) -> Estimate:
    return Estimate(mpmath.mpf(x))


@given(st.lists(numbers, min_size=3, max_size=3))
def test_values_and_errors_of_an_expression(given_numbers: list[float]) -> None:
    a, b, c = given_numbers

    def compute(x: Any, y: Any, z: Any) -> Any:
        return (x * y - z / x) ** 2 + 3 * x - y / (x * x + 1)

    with mpmath.workdps(40):
        found = compute(*map(exact, given_numbers))
        right = compute(*map(mpmath.mpf, given_numbers))
        assert abs(found.value - right) <= mpmath.mpf(10) ** -35 * (1 + abs(right))
        error = abs(float(compute(a, b, c) - right))
    assert error <= 8 * UNIT * found.error


@given(numbers)
def test_functions(x: float) -> None:
    with mpmath.workdps(40):
        once = exact(x) + 0.1  # an error to pass on
        assert abs(float(sine(once).value - mpmath.sin(once.value))) == 0
        assert abs(math.sin(x + 0.1) - float(sine(once).value)) <= 8 * UNIT * sine(once).error
        assert abs(math.cos(x + 0.1) - float(cosine(once).value)) <= 8 * UNIT * cosine(once).error


def test_errors_that_cancel_do_cancel() -> None:
    """A contraction forgets old errors, though its two terms are each larger than their difference."""
    with mpmath.workdps(40):
        x = exact(1.0)
        for _ in range(200):
            x = 1.75 * x - 1.25 * x + 1
        assert x.error < 100


def test_errors_that_grow_do_grow() -> None:
    with mpmath.workdps(40):
        x = exact(0.1) + 0
        for _ in range(30):
            x = 4 * x * (1 - x)
    assert x.error > 1e6


@pytest.mark.parametrize("operation", ["+", "-", "*", "/"])
def test_numbers_on_either_side(operation: str) -> None:
    with mpmath.workdps(40):
        for text in (f"x {operation} 2", f"2 {operation} x"):
            assert float(eval(text, {"x": exact(3.0)}).value) == pytest.approx(eval(text, {"x": 3.0}))


def test_samples_are_the_same_every_time() -> None:
    with mpmath.workdps(30):
        first, second = ((exact(1.1) * exact(2.3) + exact(0.7)).errors for _ in range(2))
    assert np.array_equal(first, second)
    assert np.ptp(first) > 0


@pytest.mark.parametrize("number", [2, exact(2.0)], ids=["constant", "estimate"])
def test_a_root_is_rounded_once_also_that_of_a_constant(number: Any) -> None:
    found = root(number)
    assert float(found.value) == math.sqrt(2.0)
    np.testing.assert_allclose(np.abs(found.errors), math.sqrt(2.0))
