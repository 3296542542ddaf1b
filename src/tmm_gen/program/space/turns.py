"""Constant turns, which stand in the code as numbers."""

from __future__ import annotations

import math
from functools import lru_cache

import sympy as sp

from tmm_gen.derive.space.declaration import TURN
from tmm_gen.derive.space.pose import FIXED
from tmm_gen.program.arm.loads import exactly
from tmm_gen.scene.spatial.arm import Turn


@lru_cache(maxsize=512)
def _fixed_values(turn: Turn) -> tuple[tuple[sp.Symbol, sp.Expr], ...]:
    entries = zip(TURN, (exactly(entry) for row in turn for entry in row), strict=True)
    return (*entries, *zip(FIXED, map(exactly, quaternion_of(turn)), strict=True))


def fixed(turn: Turn) -> dict[sp.Symbol, sp.Expr]:
    """Return a constant turn, which stands in the code as numbers: entries changed by themselves would be none."""
    return dict(_fixed_values(turn))


def quaternion_of(turn: Turn) -> tuple[float, float, float, float]:
    """Return the quaternion of a constant turn, whose first entry is not negative."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = turn
    # four times the products of its entries; the largest square divides best
    square = (1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz)
    rows = (
        (square[0], zy - yz, xz - zx, yx - xy),
        (zy - yz, square[1], xy + yx, xz + zx),
        (xz - zx, xy + yx, square[2], yz + zy),
        (yx - xy, xz + zx, yz + zy, square[3]),
    )
    row = rows[max(range(4), key=lambda k: square[k])]
    length = math.copysign(math.hypot(*row), row[0])
    w, x, y, z = (entry / length for entry in row)
    return w, x, y, z
