"""Number types of C."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.c_language.real import DOUBLE, FLOAT
from tmm_gen.errors import UserError


@given(st.floats(allow_nan=False, allow_infinity=False, width=32))
def test_float_literals_read_back(value: float) -> None:
    if value == 0 or abs(value) > 1e-37:
        literal = FLOAT.literal(value)
        assert literal.endswith("f")
        assert np.float32(literal[:-1]) == np.float32(value)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_double_literals_read_back(value: float) -> None:
    assert float(DOUBLE.literal(value)) == value


@given(st.floats(-1e30, 1e30).filter(lambda x: x == 0 or abs(x) > 1e-30))
def test_rounding(value: float) -> None:
    assert FLOAT.round(value) == float(np.float32(value))
    assert DOUBLE.round(value) == value


@pytest.mark.parametrize("value", [1e39, -1e39, 1e-50])
def test_what_a_float_cannot_hold_is_refused(value: float) -> None:
    with pytest.raises(UserError, match=r"out of the range of emit\.real = 'float32'"):
        FLOAT.literal(value)
    assert DOUBLE.literal(value) == repr(value)


def test_epsilons() -> None:
    assert np.finfo(np.float64).eps == DOUBLE.epsilon
    assert np.finfo(np.float32).eps == FLOAT.epsilon
    assert (FLOAT.function("sin"), DOUBLE.function("sin")) == ("sinf", "sin")
