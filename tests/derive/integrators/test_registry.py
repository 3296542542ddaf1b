from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.derive.integrators.parameters import exact
from tmm_gen.derive.integrators.registry import integrator, names


def test_names_are_those_of_the_declarations() -> None:
    assert names() == tuple(integrator(name).name for name in names())
    assert {"fox_euler", "newmark", "wilson", "houbolt", "zhou", "sdirk2", "sdirk4"} <= set(names())
    # machinery in the same folder is no integrator
    assert not {"dirk", "order", "registry", "stability"} & set(names())


def test_hyphens_and_underscores_are_the_same() -> None:
    assert integrator("fox-euler").name == "fox_euler"


def test_floats_become_exact() -> None:
    assert integrator("newmark", beta=0.25, gamma=0.5).parameters == {
        "beta": sp.S.One / 4,
        "gamma": sp.S.Half,
    }
    assert integrator("newmark", beta=1 / 6).parameters["beta"] == sp.S.One / 6
    assert integrator("zhou", g1=1 / 3).parameters == {"g1": sp.S.One / 3, "g2": sp.S.Half}
    assert exact(0.292893) == sp.Rational(292893, 10**6)
    assert exact(1.4) == sp.Rational(7, 5)
    assert exact(sp.Symbol("x") / 2) == sp.Symbol("x") / 2


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e6, max_value=1e6))
def test_exact_numbers_round_back_to_the_float(value: float) -> None:
    assert float(exact(value)) == value


@given(st.integers(-1000, 1000), st.integers(1, 1000))
def test_simple_fractions_survive_being_written_as_floats(numerator: int, denominator: int) -> None:
    assert exact(numerator / denominator) == sp.Rational(Fraction(numerator, denominator))


@pytest.mark.parametrize(
    ("name", "parameters", "words"),
    [
        ("newmrak", {}, ["newmrak", "newmark"]),
        ("newmark", {"alpha": 1}, ["newmark", "alpha", "beta, gamma"]),
        ("park", {"alpha": 1}, ["park", "alpha", "none"]),
        ("newmark", {"beta": float("nan")}, ["newmark", "beta", "nan"]),
        ("newmark", {"beta": True}, ["newmark", "beta", "True"]),
        ("newmark", {"beta": "0.25"}, ["newmark", "beta", "0.25"]),
        ("newmark", {"beta": sp.Symbol("b") * sp.Float(0.5)}, ["newmark", "beta", "exact"]),
        ("newmark", {"beta": -0.1}, ["newmark", "beta = -1/10", "between 0 and 1"]),
        ("newmark", {"gamma": 2}, ["gamma = 2", "between 0 and 1"]),
        ("wilson", {"theta": 0.9}, ["wilson", "theta = 9/10", "at least 1"]),
        ("generalized_alpha", {"rho_inf": 1.1}, ["rho_inf = 11/10", "between 0 and 1"]),
        ("bathe", {"gamma": 1}, ["bathe", "gamma = 1", "excluded"]),
    ],
)
def test_bad_calls_say_what_is_wrong(name: str, parameters: dict[str, float], words: list[str]) -> None:
    with pytest.raises(ValueError, match=r".") as caught:
        integrator(name, **parameters)
    assert all(word in str(caught.value) for word in words)
