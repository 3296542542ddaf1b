"""Diagonally implicit Runge-Kutta methods from a Butcher tableau, applied to ``q' = v``, ``v' = a``."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Scheme, Stage, Tableau, end_of_step, past, stage

h = STEP


def tableau(rows: Sequence[Sequence[sp.Expr]], weights: Sequence[sp.Expr] | None = None) -> Tableau:
    """Build a tableau from its lower-triangular rows; nodes are row sums, weights default to the last row."""
    size = len(rows)
    matrix = sp.zeros(size, size)
    for i, row in enumerate(rows):
        for j, entry in enumerate(row):
            matrix[i, j] = sp.sympify(entry)
    last = [matrix[size - 1, j] for j in range(size)]
    return Tableau(
        matrix=matrix.as_immutable(),
        weights=sp.ImmutableMatrix([list(weights) if weights is not None else last]),
        nodes=sp.ImmutableMatrix([sp.expand(sum(matrix.row(i))) for i in range(size)]),
    )


def dirk_scheme(table: Tableau) -> Scheme:
    """Turn a stiffly accurate tableau into stages.

    Raises
    ------
    ValueError
        If the weights differ from the last row: the step would end between stages and its acceleration
        would not satisfy equilibrium.
    """
    size = table.matrix.rows
    if list(table.weights) != list(table.matrix.row(size - 1)):
        raise ValueError("only stiffly accurate tableaux (weights = last row) end on an equilibrium")
    stages = []
    for i in range(size):
        speed = sum(table.matrix[i, j] * stage("a", j + 1) for j in range(i + 1))
        place = sum(table.matrix[i, j] * stage("v", j + 1) for j in range(i + 1))
        stages.append(
            Stage(
                instant=table.nodes[i],
                relations=(
                    past("q") + h * place - stage("q", i + 1),
                    past("v") + h * speed - stage("v", i + 1),
                ),
            )
        )
    return Scheme(stages=tuple(stages), update=end_of_step(size))
