"""Sums of two floats: as exact as stated, the same in C as in Python, and written only where they are asked for."""

from __future__ import annotations

import ctypes
import re
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.c_language.real import COMPENSATED
from tmm_gen.derive.integrators.registry import names
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c import pair as arithmetic
from tmm_gen.emit.c.bind import bind
from tmm_gen.emit.c.circle import PAIR_ERROR, PairCircle
from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.pair import Pair, PairPrinter, functions_in, minus, over, over_root, plus, times
from tmm_gen.emit.templates import _environment
from tmm_gen.native import compile_kernel
from tmm_gen.native.compiler import compile_library
from tmm_gen.native.layout import PairStructure
from tmm_gen.program.build import build_program
from tmm_gen.program.variables import local
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene

ROUNDOFF = COMPENSATED.epsilon / 2.0

moderate = st.floats(-1e6, 1e6).filter(lambda x: abs(x) > 1e-6)


def _exact(pair: Pair) -> Fraction:
    return Fraction(float(pair.high)) + Fraction(float(pair.low))


@given(moderate, moderate)
def test_operations_keep_48_bits(x: float, y: float) -> None:
    a, b = Pair.of(x), Pair.of(y)
    p, q = _exact(a), _exact(b)
    size = abs(p) + abs(q)  # a difference is as exact as what it is taken of
    assert abs(_exact(plus(a, b)) - (p + q)) <= ROUNDOFF * size
    assert abs(_exact(minus(a, b)) - (p - q)) <= ROUNDOFF * size
    assert abs(_exact(times(a, b)) - p * q) <= ROUNDOFF * abs(p * q)
    assert abs(_exact(over(a, b)) - p / q) <= 4 * ROUNDOFF * abs(p / q)
    root = _exact(over_root(b if q > 0 else Pair(-b.high, -b.low)))
    assert abs(root**2 * abs(q) - 1) <= 8 * ROUNDOFF


@given(moderate)
def test_a_number_is_split_within_half_a_unit(x: float) -> None:
    pair = Pair.of(x)
    assert abs(_exact(pair) - Fraction(x)) <= 2.0**-48 * abs(x)
    assert abs(float(pair.low)) <= 0.5 * float(np.spacing(np.abs(pair.high)))


# -- the same in C ------------------------------------------------------------------------------

HARNESS = """
#include <math.h>
#include <stdint.h>
typedef float real;
typedef struct {{ real high; real low; }} pair;
{functions}
{circle}
pair call(int which, pair a, pair b);
pair turned(pair angle, int which);
pair call(int which, pair a, pair b)
{{
    return which == 0 ? plus(a, b) : which == 1 ? minus(a, b) : which == 2 ? times(a, b)
        : which == 3 ? over(a, b) : over_root(times(a, a));
}}
pair turned(pair angle, int which)
{{
    const circle found = circle_of(angle);
    return which ? found.cosine : found.sine;
}}
"""


@cache
def library() -> Any:
    """Compile the template's own text."""
    module: Any = _environment().get_template("c/pair.jinja").module
    names = functions_in("plus( minus( times( over( over_root( pair_of( scaled(")
    text = HARNESS.format(
        functions=module.functions(names, False), circle=module.circle(PairCircle(COMPENSATED), False)
    )
    loaded = ctypes.CDLL(str(compile_library({"pair.c": text})))
    loaded.call.restype = loaded.turned.restype = PairStructure
    return loaded


@pytest.mark.compiler
@given(moderate, moderate, st.integers(0, 4))
@settings(deadline=None)
def test_python_has_the_bits_of_c(x: float, y: float, which: int) -> None:
    a, b = Pair.of(x), Pair.of(y)
    mine = (plus, minus, times, over)[which](a, b) if which < 4 else over_root(times(a, a))
    its = library().call(which, PairStructure.of(x), PairStructure.of(y))
    assert (float(mine.high), float(mine.low)) == (its.high, its.low)


@pytest.mark.compiler
@given(st.floats(-1.6e6, 1.6e6) | st.floats(-7.0, 7.0))
@settings(deadline=None)
def test_sine_and_cosine(angle: float) -> None:
    exact = float(PairStructure.of(angle))
    with mpmath.workdps(40):
        for which, right in enumerate((mpmath.sin(exact), mpmath.cos(exact))):
            found = library().turned(PairStructure.of(angle), which)
            assert abs(mpmath.mpf(found.high) + mpmath.mpf(found.low) - right) <= PAIR_ERROR * max(
                1.0, abs(angle)
            )


# -- kernels ------------------------------------------------------------------------------------


def compensated(name: str, **changes: object) -> Scene:
    keys: dict[str, object] = {"emit.real": "float32", "emit.compensated": True, "emit.trigonometry": "own"}
    return load_scene(scenes_dir() / f"{name}.toml").replace(**{**keys, **changes})


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("name", "integrator"),
    [
        *(("thesis10", integrator) for integrator in names()),
        ("drivetrain", "generalized_alpha"),
        ("swing", "newmark"),
        ("swing", "sdirk2"),
    ],
)
def test_a_step_is_as_good_as_in_double_precision(name: str, integrator: str) -> None:
    scene = compensated(name, **{"integrator.name": integrator})
    program = build_program(scene)
    mine = compile_kernel(program, scene)
    double = compile_kernel(program, scene.replace(**{"emit.real": "float64", "emit.compensated": False}))
    for kernel in (mine, double):
        kernel.prepare()
        kernel.initialise()
        for k in range(200):
            kernel.step({program.inputs[0].name: 0.25 * (k % 5 - 2)})
    for variable in program.state:
        right = np.asarray(double.state[variable.name])
        np.testing.assert_allclose(
            mine.state[variable.name], right, rtol=0, atol=1e-10 * np.max(np.abs(right))
        )


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("name", "integrator"),
    [
        ("thesis10", "newmark"),
        ("thesis10", "sdirk2"),
        ("drivetrain", "generalized_alpha"),
        ("swing", "sdirk2"),
    ],
)
def test_bound_numbers_are_those_that_prepare_computes(name: str, integrator: str) -> None:
    scene = compensated(name, **{"integrator.name": integrator})
    program = build_program(scene)
    kernel = compile_kernel(program, scene)
    kernel.prepare()
    for variable, values in bind(lower(program), COMPENSATED).items():
        if variable.name in kernel.model:
            assert np.array_equal(np.atleast_1d(kernel.model[variable.name]), np.array(values)), variable.name


def test_irrational_coefficients_are_constants_of_48_bits() -> None:
    x, root = local("x"), sp.sqrt(2)
    for coefficient in (root, 1 - root / 2, root / 6, 1 / (1 + root), sp.pi):
        for expression, value in (
            (coefficient, coefficient),
            (coefficient * x, coefficient),
            (x / coefficient, 1 / coefficient),
        ):
            text = PairPrinter(lambda ref: "x").text(expression)
            assert "sqrt" not in text
            (numbers,) = re.findall(r"{(.*?)f, (.*?)f}", text)
            wanted = Fraction(str(value.evalf(40)))
            found = sum(Fraction(float(np.float32(number))) for number in numbers)
            assert abs(found - wanted) <= Fraction(2) ** -48 * abs(wanted), text


def test_only_what_is_asked_for_is_compensated() -> None:
    scene = compensated("thesis10", **{"emit.compensated": False})
    for text in emit_kernel(build_program(scene), scene).values():
        assert "pair" not in text


def test_functions_bring_those_that_they_call() -> None:
    assert functions_in("x = over(a, b);") == {"over", "times", "minus", "plus", "opposite", "pair_of"}
    assert functions_in("x = surplus(a);") == frozenset()
    assert set(arithmetic._CALLS) >= functions_in((Path(__file__)).read_text())
