"""An articulated inertia across what has no mass: ``T^T S T``, where accelerations change by ``T``."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.declaration import AXES
from tmm_gen.derive.space.sheet import Sheet


def congruent(sheet: Sheet, inertia: sp.Matrix, through: sp.Matrix) -> sp.Matrix:
    """Return ``through^T inertia through``, named entry by entry."""
    half = inertia * through
    named = sp.Matrix(6, 6, lambda i, j: sheet.named(entry_name("half", i, j), half[i, j]))
    whole = through.T * named
    return _named(sheet, whole, "passed")


def turned(sheet: Sheet, inertia: sp.Matrix, turn: sp.Matrix, axis: int) -> sp.Matrix:
    """Return the same of a turn about an axis, in a third fewer operations: sine and cosine make a circle.

    Of four numbers ``a b; c d`` across the axis, ``w = sine (d - a) - cosine (b + c)`` is what turning takes from one
    end of the diagonal to the other: ``a + sine w``, ``-cosine w - c``; ``-cosine w - b``, ``d - sine w``. Errors are
    those of rounding the largest of them; products keep more digits of a small inertia that comes to where a large one
    was.

    Parameters
    ----------
    sheet : Sheet
        Receives the names.
    inertia : sympy.Matrix, (6, 6)
        Symmetric.
    turn : sympy.Matrix, (3, 3)
        Of accelerations.
    axis : int
        Which it leaves as it is.
    """
    one, other = (axis + 1) % 3, (axis + 2) % 3
    cosine, sine = turn[one, one], turn[one, other]
    whole = inertia.as_mutable()
    for rows, columns in ((0, 0), (0, 3), (3, 3)):
        i, k, m, n = rows + one, rows + other, columns + one, columns + other
        across = sheet.named(entry_name("across", i, n), inertia[i, n] + inertia[k, m])
        apart = sheet.named(entry_name("apart", k, n), inertia[k, n] - inertia[i, m])
        taken = sheet.named(entry_name("taken", i, m), sine * apart - cosine * across)
        whole[i, m] = inertia[i, m] + sine * taken
        whole[k, n] = inertia[k, n] - sine * taken
        whole[i, n] = -cosine * taken - inertia[k, m]
        whole[k, m] = -cosine * taken - inertia[i, n]
        row, column = rows + axis, columns + axis
        whole[row, m] = inertia[row, m] * cosine - inertia[row, n] * sine
        whole[row, n] = inertia[row, m] * sine + inertia[row, n] * cosine
        whole[i, column] = inertia[i, column] * cosine - inertia[k, column] * sine
        whole[k, column] = inertia[i, column] * sine + inertia[k, column] * cosine
    return _named(sheet, whole, "turned")


def _named(sheet: Sheet, whole: sp.Matrix, stage: str) -> sp.Matrix:
    """Return a symmetric matrix by the names of its upper half."""
    found = sp.zeros(6, 6)
    for i in range(6):
        for j in range(i, 6):
            found[i, j] = found[j, i] = sheet.named(entry_name(stage, i, j), whole[i, j])
    return found


def entry_name(stage: str, i: int, j: int) -> str:
    """Return the name of an entry."""
    kind = {
        (True, True): "mass",
        (True, False): "coupling",
        (False, True): "lever",
        (False, False): "inertia",
    }
    return f"{stage}_{kind[i < 3, j < 3]}_{AXES[i % 3]}{AXES[j % 3]}"
