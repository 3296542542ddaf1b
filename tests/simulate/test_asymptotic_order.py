"""The order that `check` judges is that of steps so short that it shows, neither missed nor made up."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable

import pytest

from tmm_gen.verify.asymptotic import asymptotic_order
from tmm_gen.verify.check_row import SLOPE

COUNTS = (64, 128, 256, 512)


def radau(z: complex) -> complex:
    """Return the stability function of Radau IIA with three stages: order 5 (Hairer & Wanner, table IV.3.1)."""
    return (1 + 0.4 * z + z * z / 20) / (1 - 0.6 * z + 0.15 * z * z - z**3 / 60)


def trapezoidal(z: complex) -> complex:
    return (1 + z / 2) / (1 - z / 2)


def error(turned: float, decayed: float, steps: int, method: Callable[[complex], complex] = radau) -> float:
    """Return what is off at the end of a vibration beside a fast decay."""
    return float(
        sum(abs(method(whole / steps) ** steps - cmath.exp(whole)) for whole in (1j * turned, -decayed + 0j))
    )


@pytest.mark.parametrize("turned", [1.0, 40.0, 100.0, 200.0, 300.0])
def test_order_shows_however_long_the_first_steps_are(turned: float) -> None:
    """Errors of a turn of 1 rad in all are of rounding at once, those of 300 rad as large as the motion."""

    def off(steps: int) -> float:
        return error(turned, 3.0, steps)

    found = asymptotic_order(off, COUNTS, lambda slope: abs(slope - 5.0) <= SLOPE, 1e-13, 0.01)
    assert found.order == pytest.approx(5.0, abs=SLOPE)


def test_first_steps_alone_would_not_show_it() -> None:
    """The fit over all of them is off by more than `check` allows: this is what it judged."""
    errors = [error(200.0, 3.0, steps) for steps in COUNTS]
    assert abs(math.log2(errors[0] / errors[-1]) / 3.0 - 5.0) > SLOPE


@pytest.mark.parametrize("turned", [1.0, 40.0, 200.0])
def test_another_order_is_no_fifth(turned: float) -> None:
    tried = []

    def off(steps: int) -> float:
        tried.append(steps)
        return error(turned, 3.0, steps, trapezoidal)

    found = asymptotic_order(off, COUNTS, lambda slope: abs(slope - 5.0) <= SLOPE, 1e-13, 0.01)
    assert found.order == pytest.approx(2.0, abs=SLOPE)
    if turned == 1.0:  # one slope is like the next: no shorter steps are tried
        assert max(tried) == COUNTS[-1]


def test_steps_that_break_off_are_left_behind() -> None:
    def off(steps: int) -> float:
        if steps < 300:
            raise ArithmeticError("a pivot is not positive")
        return error(40.0, 3.0, steps)

    found = asymptotic_order(off, COUNTS, lambda slope: True, 1e-13, 0.01)
    assert found.counts == (512, 1024, 2048)
    assert found.order == pytest.approx(5.0, abs=SLOPE)


def test_a_motion_that_never_lasts_says_why() -> None:
    def off(steps: int) -> float:
        raise ArithmeticError("a pivot is not positive")

    with pytest.raises(ArithmeticError, match="pivot"):
        asymptotic_order(off, COUNTS, lambda slope: True, 1e-13, 0.01)
