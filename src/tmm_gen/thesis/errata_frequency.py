"""The thesis's frequency-domain formulas, eqs. 2-90 to 2-100, beside the derived ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import sympy as sp
from scipy.signal import TransferFunction, step

from tmm_gen.derive.elements.torsion import LOAD
from tmm_gen.derive.transfer import LAPLACE
from tmm_gen.thesis.errata import ErratumRow
from tmm_gen.thesis.response import DURATION
from tmm_gen.thesis.transfer_functions import (
    TransferFunctions,
    numbered_chain,
    system_matrix,
    transfer_functions,
)

SAMPLE = {"I_1": 5, "I_2": 5, "k_1": 20, "k_2": 20, "c_1": 5, "c_2": 5}
"""Table 3-2."""

TORQUE_OF_EFFECTS = 2
"""N m on station 1; the sample's own torque of 1 N m hides a factor of the torque."""

_POINTS = 2001


@dataclass(frozen=True)
class PrintedFormula:
    """A formula of the frequency domain as printed, misprints included.

    Parameters
    ----------
    number, quantity : str
        Equation and what it gives.
    printed : sympy.Expr
        In the letters of :func:`~tmm_gen.thesis.transfer_functions.numbered_chain`, with ``P`` for the polynomial
        2-100.
    note : str
        What there is to say.
    """

    number: str
    quantity: str
    printed: sp.Expr
    note: str = ""


POLYNOMIAL = sp.Symbol("P")
"""The characteristic polynomial as eqs. 2-98 and 2-99 name it."""

_k2, _c2, _i2 = (sp.Symbol(name, positive=True) for name in ("k_2", "c_2", "I_2"))
_s = LAPLACE

RATIOS: tuple[PrintedFormula, ...] = (
    PrintedFormula("2-98", "theta_1/T", (_i2 * _s**2 + _c2 * _s + _k2) / POLYNOMIAL),
    PrintedFormula(
        "2-99",
        "theta_2/T",
        (_c2 * LOAD * _s + LOAD * _k2) / POLYNOMIAL,
        "T stands in the numerator of a ratio to T: it was not divided out",
    ),
)

INDICES: Mapping[tuple[int, int], tuple[int, int]] = {(2, 1): (1, 2), (3, 1): (1, 3), (3, 2): (2, 3)}
"""Entries of the system matrix whose indices eq. 2-90 prints the other way round; eq. 2-91 has them right."""


def frequency_errata_rows() -> tuple[ErratumRow, ...]:
    """Return one row for each printed formula that can be compared, in the order of the thesis.

    The polynomial ``P`` (2-100) is derived; eqs. 2-98 and 2-99 are compared with it in place of ``P``.
    """
    chain = numbered_chain(2)
    derived = transfer_functions(chain, 1)
    matrix = system_matrix(chain, 1)
    rows = [_index_row(matrix, right, printed) for right, printed in INDICES.items()]
    rows += [_ratio_row(formula, derived, station) for station, formula in enumerate(RATIOS)]
    return (*rows, _polynomial_row(derived))


def _index_row(matrix: sp.Matrix, right: tuple[int, int], printed: tuple[int, int]) -> ErratumRow:
    shown, wanted = (matrix[row - 1, column - 1] for row, column in (printed, right))
    agrees = sp.simplify(shown - wanted) == 0
    return ErratumRow(
        table="2-90",
        coefficient=f"U_{right[0]}{right[1]}",
        printed=shown,
        derived=wanted,
        agrees=agrees,
        effect="none"
        if agrees
        else "none at a clamped base, whose angle is zero; wrong for any other base"
        if right == (2, 1)
        else "the last row is no longer [0, 0, 1]: the state's trailing 1 is lost",
        rms_error=0.0,
        derived_rms_error=0.0,
        note=f"printed as U_{printed[0]}{printed[1]}; eq. 2-91 has it right",
    )


def _ratio_row(formula: PrintedFormula, derived: TransferFunctions, station: int) -> ErratumRow:
    wanted = derived.function(station)
    printed = formula.printed
    complete = printed.subs(POLYNOMIAL, derived.denominator.as_expr())
    agrees = sp.simplify(complete - wanted) == 0
    error = 0.0 if agrees else _rms_error(complete, wanted)
    return ErratumRow(
        table=formula.number,
        coefficient=formula.quantity,
        printed=printed,
        derived=wanted,
        agrees=agrees,
        effect="none"
        if agrees
        else f"none at T = 1 N m; at {TORQUE_OF_EFFECTS} N m RMS error {error:#.2g} of the static deflection",
        rms_error=error,
        derived_rms_error=0.0,
        note=formula.note,
    )


def _polynomial_row(derived: TransferFunctions) -> ErratumRow:
    """Return the row of eq. 2-100: what ``P`` has to be for eq. 2-98, taken at its word."""
    formula = RATIOS[0]
    numerator = sp.expand(formula.printed * POLYNOMIAL)
    needed = sp.expand(sp.cancel(numerator / derived.function(0)))
    polynomial = sp.expand(derived.denominator.as_expr())
    return ErratumRow(
        table="2-100",
        coefficient="P",
        printed=POLYNOMIAL,
        derived=polynomial,
        agrees=sp.expand(needed - polynomial) == 0,
        effect="not compared",
        rms_error=0.0,
        derived_rms_error=0.0,
        note="not legible in the copy at hand; derived, it is the polynomial that makes eq. 2-98 true",
    )


def _rms_error(printed: sp.Expr, derived: sp.Expr) -> float:
    """Return the RMS difference of both responses to a torque, relative to the static deflection."""
    time = np.linspace(0.0, DURATION, _POINTS)
    values = {symbol: SAMPLE[symbol.name] for symbol in derived.free_symbols if symbol.name in SAMPLE}
    responses = []
    for ratio in (printed, derived):
        numbers = (TORQUE_OF_EFFECTS * ratio).subs({**values, LOAD: TORQUE_OF_EFFECTS})
        top, bottom = (sp.Poly(part, LAPLACE) for part in sp.fraction(sp.together(numbers)))
        system = TransferFunction(*([float(c) for c in part.all_coeffs()] for part in (top, bottom)))
        responses.append(step(system, T=time)[1])
        static = float((numbers).subs(LAPLACE, 0))
    difference = (responses[0] - responses[1]) / static
    return float(np.sqrt(np.mean(difference**2)))
