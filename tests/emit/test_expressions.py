"""One set of expressions, written by every printer and compared with SymPy's own evaluation."""

from __future__ import annotations

import ast
import math
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict
from typing import Any, ClassVar

import casadi as ca
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.emit.expressions import ExpressionPrinter, element, opposite
from tmm_gen.emit.python.printer import PythonPrinter
from tmm_gen.program.count import count_expression
from tmm_gen.program.variables import Ref, Role, Variable

A, B, C = (Variable(name, Role.LOCAL).ref for name in ("a", "b", "c"))
V = Variable("v", Role.STATE, 5)
HERE, NEXT, BEFORE, FIXED = V.at(), V.at(1), V.at(-2), V.entry(1)
VALUES = {A: 0.7, B: -1.3, C: 2.9, HERE: 0.31, NEXT: -0.83, BEFORE: 1.7, FIXED: -2.2}
HELD: dict[str, Any] = {"a": 0.7, "b": -1.3, "c": 2.9, "v": [1.7, -2.2, 0.31, -0.83, 0.0], "j": 2}

third, half = sp.Rational(1, 3), sp.Rational(1, 2)

EXPRESSIONS = {
    "zero": sp.Integer(0),
    "minus one": sp.Integer(-1),
    "fraction": third,
    "minus a fraction": -third,
    "exact fraction": sp.Rational(-7, 8),
    "small float": sp.Float(1e-300),
    "pi": sp.pi * A,
    "reference": A,
    "elements": HERE + NEXT - BEFORE * FIXED,
    "minus reference": -A,
    "sum": A + B + C,
    "all negative": -A - B - C,
    "negative first": -A + B,
    "difference of sums": A - (B + C) * 2,
    "minus a sum": sp.Mul(-1, B + C, evaluate=False),
    "number times sum": sp.Mul(-2, B + C, evaluate=False) + A,
    "minus number times sum times symbol": A - sp.Mul(3, B + C, A, evaluate=False),
    "product": A * B * C,
    "product with number": -third * A * B,
    "nested product": sp.Mul(A, sp.Mul(-1, B, evaluate=False), evaluate=False),
    "product of sums": (A + B) * (B - C),
    "quotient": A / B,
    "one over": 1 / B,
    "minus one over": -1 / B,
    "quotient of products": A * C / (B * HERE),
    "number over": 3 / (2 * A),
    "quotient of sums": (A + B) / (B - C),
    "sum over power": (A + B) / C**2,
    "over power and symbol": A / (C**2 * B),
    "quotient in product": A * (B / C) * (C + 1),
    "quotient of quotients": A / (B / (C + 1 / A)),
    "square": A**2,
    "cube of a sum": (A + B) ** 3,
    "inverse square": A**-2,
    "inverse of a sum": 1 / (A + B),
    "inverse cube of a sum": (A + B) ** -3,
    "root": sp.sqrt(C),
    "inverse root": 1 / sp.sqrt(C),
    "root of a number": sp.sqrt(2) * A - sp.sqrt(3),
    "root of a sum": sp.sqrt(A + C) * B,
    "sine": sp.sin(A - B),
    "sine squared": sp.sin(A) ** 2 * sp.cos(B),
    "minus cosine": -sp.cos(HERE) + A,
    "deep": (A * (B + C * (A - HERE * (NEXT + third))) - half * (A - B) ** 2) / (C - A * (B - half)),
}


class Plain(ExpressionPrinter):
    """The shortest printer: what a new backend starts from, and what C's looks like."""

    def reference(self, ref: Ref) -> str:
        return element(ref.variable.name, ref)

    def literal(self, value: float) -> str:
        return repr(value)


def evaluate_plain(e: sp.Expr) -> float:
    functions = {"sin": math.sin, "cos": math.cos, "sqrt": math.sqrt}
    return float(eval(Plain().text(e), functions, HELD))


def evaluate_numpy(e: sp.Expr) -> float:
    text = PythonPrinter(lambda ref: element(ref.variable.name, ref), "np").text(e)
    return float(
        eval(text, {"np": np}, {k: np.float64(x) if isinstance(x, float) else x for k, x in HELD.items()})
    )


def evaluate_casadi(e: sp.Expr) -> float:
    text = PythonPrinter(lambda ref: element(ref.variable.name, ref), "ca").text(e)
    symbols = {name: ca.SX.sym(name) for name in "abc"}
    vector = ca.SX.sym("v", 5)
    value = eval(text, {"ca": ca}, {**symbols, "v": ca.vertsplit(vector), "j": 2})
    function = ca.Function("f", [*symbols.values(), vector], [ca.SX(value)])
    return float(function(HELD["a"], HELD["b"], HELD["c"], HELD["v"]))


PRINTERS = {"plain": evaluate_plain, "numpy": evaluate_numpy, "casadi": evaluate_casadi}


@pytest.mark.parametrize("evaluate", PRINTERS.values(), ids=PRINTERS)
@pytest.mark.parametrize("e", EXPRESSIONS.values(), ids=EXPRESSIONS)
def test_an_expression_means_what_sympy_says(e: sp.Expr, evaluate: Callable[[sp.Expr], float]) -> None:
    expected = float(e.evalf(30, subs=VALUES))
    assert evaluate(e) == pytest.approx(expected, rel=1e-14, abs=1e-300)


class Operators(ast.NodeVisitor):
    """Counts the operators of an expression, but for those of indices and of quotients of literals."""

    kinds: ClassVar = {
        ast.Add: "additions",
        ast.Sub: "additions",
        ast.Mult: "multiplications",
        ast.Div: "divisions",
    }

    def __init__(self) -> None:
        self.found = Counter[str]()

    def visit_Subscript(self, node: ast.Subscript) -> None:
        pass

    def visit_Call(self, node: ast.Call) -> None:
        self.found["functions"] += 1
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        if not all(isinstance(side, ast.Constant) for side in (node.left, node.right)):
            self.found[self.kinds[type(node.op)]] += 1
        self.generic_visit(node)


@pytest.mark.parametrize("e", EXPRESSIONS.values(), ids=EXPRESSIONS)
def test_as_many_operators_are_printed_as_are_counted(e: sp.Expr) -> None:
    operators = Operators()
    operators.visit(ast.parse(Plain().text(e)))
    assert operators.found == Counter(asdict(count_expression(e)))


@st.composite
def expressions(draw: st.DrawFn, depth: int = 3) -> sp.Expr:
    if depth == 0:
        numbers = st.fractions(-5, 5, max_denominator=12).map(
            lambda q: sp.Rational(q.numerator, q.denominator)
        )
        return draw(st.sampled_from([A, B, C, HERE, NEXT]) | numbers)
    parts = draw(st.lists(expressions(depth - 1), min_size=1, max_size=3))
    build: Any = draw(
        st.sampled_from([sp.Add, sp.Mul, lambda *x: sp.Mul(*x, evaluate=False), _sine, _square])
    )
    return build(*parts)


def _sine(first: sp.Expr, *_: sp.Expr) -> sp.Expr:
    return sp.sin(first)


def _square(first: sp.Expr, *_: sp.Expr) -> sp.Expr:
    return first**2


@given(e=expressions())
@settings(max_examples=60)
def test_any_expression_means_what_sympy_says(e: sp.Expr) -> None:
    expected = float(e.evalf(30, subs=VALUES))
    assert evaluate_plain(e) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert evaluate_numpy(e) == pytest.approx(evaluate_plain(e), rel=1e-13, abs=1e-13)


def test_the_opposite_of_a_term_keeps_its_sum() -> None:
    term = sp.Mul(-2, A + B, evaluate=False)
    assert opposite(term).args == sp.Mul(2, A + B, evaluate=False).args
    assert opposite(sp.Mul(-1, A + B, evaluate=False)) == A + B
    assert opposite(sp.Integer(-3)) == 3


@pytest.mark.parametrize("e", [A**third, sp.Symbol("loose"), sp.Piecewise((A, B > 0), (C, True)), A**B])
def test_what_no_language_can_write_is_refused(e: sp.Expr) -> None:
    with pytest.raises(TypeError, match="no way to write"):
        Plain().text(e)
