"""Blocks of stages put into one sparse matrix: entries are copied, nothing is computed or coloured."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import casadi as ca
import numpy as np


def scattered(
    blocks: Any, pattern: Any, rows: Sequence[np.ndarray], columns: Sequence[np.ndarray], constant: Any
) -> Any:
    """Return ``constant`` plus, for each stage, its block at given rows and columns.

    Parameters
    ----------
    blocks : MX
        Side by side, as a mapped function returns them.
    pattern : Sparsity
        Of one block.
    rows, columns : sequences of arrays
        Where the rows and columns of each stage's block belong; no entry may belong to two.
    constant : DM
        What does not depend on anything; where it is not zero, blocks are.
    """
    inner_row, inner_column = pattern.get_triplet()
    row = np.concatenate([places[inner_row] for places in rows])
    column = np.concatenate([places[inner_column] for places in columns])
    fixed_row, fixed_column = constant.sparsity().get_triplet()
    total = ca.DM.triplet(
        [*map(int, row), *fixed_row],
        [*map(int, column), *fixed_column],
        np.arange(1.0, len(row) + len(fixed_row) + 1),
        *constant.shape,
    )
    if total.nnz() != len(row) + len(fixed_row):
        raise ValueError("two entries belong to the same place")
    order = (np.array(total.nonzeros()) - 1).astype(int)
    values = ca.vertcat(blocks.nz[:], ca.MX(ca.DM(constant.nonzeros())))
    return ca.MX(total.sparsity(), values[order.tolist()])
