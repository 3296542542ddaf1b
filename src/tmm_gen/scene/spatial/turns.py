"""Turns and products of three by three numbers, in plain floats."""

from __future__ import annotations

import math
from collections.abc import Sequence

from tmm_gen.scene.spatial.arm import Turn, Vector

Block = tuple[Vector, Vector, Vector]


def turned_about(axis: int, angle: float) -> Turn:
    """Return the turn about a frame axis, rad."""
    c, s = math.cos(angle), math.sin(angle)
    if axis == 0:
        return (1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c)
    if axis == 1:
        return (c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c)
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)


def across(a: Vector) -> Block:
    """Return the matrix that makes the cross product with a vector on the left."""
    x, y, z = a
    return (0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)


def product(a: Sequence[Sequence[float]], b: Sequence[Sequence[float]]) -> Block:
    """Return a matrix product."""
    (b00, b01, b02), (b10, b11, b12), (b20, b21, b22) = b
    x, y, z = (
        (p * b00 + q * b10 + r * b20, p * b01 + q * b11 + r * b21, p * b02 + q * b12 + r * b22)
        for p, q, r in a
    )
    return x, y, z


def transposed(a: Block) -> Block:
    """Return the transpose."""
    x, y, z = zip(*a, strict=True)
    return x, y, z


def applied(a: Block, v: Vector) -> Vector:
    """Return a matrix times a vector."""
    x, y, z = (p * v[0] + q * v[1] + r * v[2] for p, q, r in a)
    return x, y, z
