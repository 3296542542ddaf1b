"""The elements' Laplace-domain matrices as numbers, from the declarations the kernels are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.transfer import LAPLACE, laplace_matrix

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Blocks:
    """``[k; f]_out = [[U11, U12], [U21, U22]] [k; f]_in`` at f frequencies, each block (f, m, m)."""

    U11: Complex
    U12: Complex
    U21: Complex
    U22: Complex


@dataclass(frozen=True)
class ElementFunctions:
    """A type of element.

    Parameters
    ----------
    width : int
        m, motions of a station: 1 in a chain, 3 in a planar arm.
    blocks : callable
        From s (f,) and the values of the parameters to the blocks.
    powers : callable
        From the values of the parameters, (k,) each, to the coefficients of ``s^0, s^1, s^2`` in ``U21``,
        (3, k, m, m), and to the constants ``U11`` and ``U22``, (k, m, m).
    impedance : callable
        From the values of the parameters, (k,) each, to the coefficients of ``s^0, s^1`` in ``1/U12`` of the angle,
        (k, 2); joints only.
    """

    width: int
    blocks: Callable[[Complex, Sequence[float]], Blocks]
    powers: Callable[[Sequence[Array]], tuple[Array, Array, Array]]
    impedance: Callable[[Sequence[Array]], Array]


@cache
def element_functions(element: Element) -> ElementFunctions:
    """Return the functions of a type of element, whose equations are linear in its motions."""
    matrix = laplace_matrix(element)
    width = matrix.U11.rows
    whole = sp.Matrix.vstack(
        sp.Matrix.hstack(matrix.U11, matrix.U12), sp.Matrix.hstack(matrix.U21, matrix.U22)
    )
    filled = filler((LAPLACE, *element.parameters), whole)

    def blocks(s: Complex, values: Sequence[float]) -> Blocks:
        found = np.empty((len(s), 2 * width, 2 * width), complex)
        filled(found, s, *values)
        return Blocks(
            found[:, :width, :width],
            found[:, :width, width:],
            found[:, width:, :width],
            found[:, width:, width:],
        )

    constants = [filler(element.parameters, part) for part in (matrix.U11, matrix.U22)]
    inertia = matrix.U21.applyfunc(sp.expand)
    by_power = [filler(element.parameters, inertia.applyfunc(_coefficient(p))) for p in range(3)]

    def powers(values: Sequence[Array]) -> tuple[Array, Array, Array]:
        count = len(values[0])
        coefficients, fixed = np.empty((3, count, width, width)), np.empty((2, count, width, width))
        for fill, target in zip(by_power, coefficients, strict=True):
            fill(target, *values)
        for fill, target in zip(constants, fixed, strict=True):
            fill(target, *values)
        return coefficients, fixed[0], fixed[1]

    compliance = matrix.U12[width - 1, width - 1]
    law = sp.zeros(1, 2) if compliance == 0 else _impedance(compliance)
    of_impedance = filler(element.parameters, law)

    def impedance(values: Sequence[Array]) -> Array:
        found = np.empty((len(values[0]), 1, 2))
        of_impedance(found, *values)
        return found[:, 0]

    return ElementFunctions(width, blocks, powers, impedance)


def _impedance(compliance: Any) -> Any:
    law = sp.expand(sp.cancel(1 / compliance))
    return sp.Matrix([[_coefficient(0)(law), _coefficient(1)(law)]])


def _coefficient(power: int) -> Callable[[Any], Any]:
    return lambda expression: expression.coeff(LAPLACE, power)


def filler(symbols: Sequence[Any], matrix: Any) -> Callable[..., None]:
    """Return a function that writes a matrix of expressions into the last two axes of an array."""
    entries = [
        (row, column, matrix[row, column]) for row in range(matrix.rows) for column in range(matrix.cols)
    ]
    constant = np.array(
        [[float(entry) if entry.is_number else 0.0 for entry in matrix.row(r)] for r in range(matrix.rows)]
    )
    varying = [(row, column, entry) for row, column, entry in entries if not entry.is_number]
    compute = sp.lambdify(symbols, [entry for *_, entry in varying], "numpy", cse=True)

    def fill(target: NDArray[Any], *values: Any) -> None:
        target[...] = constant
        for (row, column, _), value in zip(varying, compute(*values), strict=True):
            target[..., row, column] = value

    return fill
