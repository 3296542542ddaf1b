"""The coefficients A, B, D, E as Gholampour (2018) prints them, misprints included.

They are evidence, to be compared with the derived ones, and not a source. ``a = A q + B`` and
``v = D q + E`` at the new instant (3-1, 3-2); history is in the symbols of an integrator's declaration.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, past

h = STEP

BETA, GAMMA, THETA = sp.symbols("beta gamma theta", positive=True)
"""Newmark's and Wilson's parameters in the printed formulas."""

PRINTED_B = sp.Symbol("B", real=True)
"""Coefficient B where another coefficient is printed by means of it."""

_q, _v, _a = past("q"), past("v"), past("a")
_third = sp.Rational(1, 3)


@dataclass(frozen=True)
class PrintedTable:
    """One table of coefficients.

    Parameters
    ----------
    number : str
        In the thesis.
    integrator : str
        Name of the method it belongs to.
    scheme : int
        Which of the method's schemes, start-up first, main last.
    coefficients : mapping from str to sympy.Expr
        Keys "A", "B", "D", "E".
    notes : mapping from str to str
        Where the text prints the same coefficient otherwise.
    parameters : mapping from str to sympy.Symbol
        The method's parameters that the table leaves open.
    """

    number: str
    integrator: str
    scheme: int
    coefficients: Mapping[str, sp.Expr]
    notes: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, sp.Symbol] = field(default_factory=dict)


TABLES: tuple[PrintedTable, ...] = (
    PrintedTable(
        number="3-1",
        integrator="fox_euler",
        scheme=0,
        coefficients={
            "A": 2 / h**2,
            "B": -2 / h**2 * (_q + h * _v),
            "D": 2 / h,
            "E": -(2 / h * _q + _v),
        },
        notes={
            "A": "eq. 3-45 agrees",
            "B": "eq. 3-45 agrees",
            "D": "eq. 3-49 agrees",
            "E": "eq. 3-49 agrees",
        },
    ),
    PrintedTable(
        number="3-3",
        integrator="newmark",
        scheme=0,
        parameters={"beta": BETA, "gamma": GAMMA},
        coefficients={
            "A": 2 / (BETA * h**2),
            "B": -2 / (BETA * h**2) * (_q + h * _v + (sp.Rational(1, 2) - BETA) * h**2 * _a),
            "D": GAMMA / (BETA * h),
            "E": _v + h * ((1 - GAMMA) * _a + GAMMA * PRINTED_B),
        },
        notes={
            "A": "eqs. 3-3 and 3-58 print 1/(beta h^2)",
            "B": "eqs. 3-4 and 3-58 print -1/(beta h^2) before the bracket",
            "D": "eqs. 3-5 and 3-59 agree; eq. 3-57 prints 1/(beta h)",
            "E": "by B (here the derived one); eq. 3-59 agrees; eq. 3-6 prints gamma beta for gamma B",
        },
    ),
    PrintedTable(
        number="3-4",
        integrator="wilson",
        scheme=0,
        parameters={"theta": THETA},
        coefficients={
            "A": 2 / h**2,
            "B": -6 / (THETA * h) ** 2 * (_q + THETA * h * _v + (THETA * h) ** 2 / 3 * _a),
            "D": 3 / (THETA * h),
            "E": -3 / (THETA * h) * (_q + 2 * THETA * h / 3 * _v + (THETA * h) ** 2 / 3 * _a),
        },
        notes={
            "A": "eq. 3-65 prints 6/(theta h)^2",
            "B": "eq. 3-65 agrees",
            "D": "eq. 3-66 agrees",
            "E": "eq. 3-66 prints -theta h/2 before the acceleration, which is (theta h)^2/6 in the bracket",
        },
    ),
    PrintedTable(
        number="3-5",
        integrator="houbolt",
        scheme=0,
        coefficients={
            "A": 6 / h**2,
            "B": -2 / h**2 * (3 * _q + 3 * h * _v + h**2 * _a),
            "D": 3 / h,
            "E": -1 / (2 * h) * (6 * _q + 4 * h * _v + h**2 * _a),
        },
    ),
    PrintedTable(
        number="3-6",
        integrator="houbolt",
        scheme=1,
        coefficients={
            "A": 2 / h**2,
            "B": -1 / h**2 * (4 * _q - 2 * past("q", 1) + 2 * h**2 * past("a", 1)),
            "D": 11 / (6 * h),
            "E": -1 / (6 * h) * (16 * _q - 5 * past("q", 1) + h**2 * past("a", 1)),
        },
        notes={
            "B": "the cubic gives the acceleration the factor 1 here and 2 in E: printed the other way round",
            "E": "the cubic gives the acceleration the factor 2 here and 1 in B: printed the other way round",
        },
    ),
    PrintedTable(
        number="3-7",
        integrator="houbolt",
        scheme=2,
        coefficients={
            "A": 2 / h**2,
            "B": -1 / h**2 * (5 * _q - 4 * past("q", 1) + past("q", 2)),
            "D": 11 / (6 * h),
            "E": -1 / (6 * h) * (18 * _q - 9 * past("q", 1) + 2 * past("q", 2)),
        },
        notes={
            "A": "eq. 3-71 agrees",
            "B": "eq. 3-71 agrees",
            "D": "eq. 3-70 is not legible in the copy compared",
            "E": "eq. 3-70 is not legible in the copy compared",
        },
    ),
    PrintedTable(
        number="3-8",
        integrator="zhou",
        scheme=1,
        coefficients={
            "A": 8 / h**2,
            "B": -8 / h**2 * _q - 8 / h * _v - sp.Rational(10, 3) * _a + _third * past("a", 1),
            "D": 10 / (3 * h**2),
            "E": -10 / (3 * h**2) * _q
            + (12 * h - 40) / (12 * h) * _v
            + (2 * _third * h - sp.Rational(25, 18)) * _a
            + (5 - 3 * h) / 36 * past("a", 1),
        },
        notes={
            "D": "follows from eq. 3-80 if the step is left out before the newest acceleration",
            "E": "follows from eq. 3-80 if the step is left out before the newest acceleration",
        },
    ),
)
