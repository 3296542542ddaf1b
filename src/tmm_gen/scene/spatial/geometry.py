"""Places and turns in space, in exact numbers: quarter turns stay what they are, and nothing is lost by taking sums."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.spatial.arm import UPRIGHT, Turn, Vector

Point = tuple[Fraction, Fraction, Fraction]
Matrix = tuple[Point, Point, Point]
Axis = Literal[0, 1, 2]

NOWHERE: Point = (Fraction(0), Fraction(0), Fraction(0))
LEVEL: Matrix = (
    (Fraction(1), Fraction(0), Fraction(0)),
    (Fraction(0), Fraction(1), Fraction(0)),
    (Fraction(0), Fraction(0), Fraction(1)),
)

SAME_ANGLE = 1e-12
"""rad; as near as this to a quarter turn is one: pi written with twelve digits is."""

_SAME_ENTRY = 4e-16
"""What products of rounded turns leave of a 0 or a 1."""


@dataclass(frozen=True)
class Pose:
    """A place and a turn in the frame of a joint's body.

    Parameters
    ----------
    joint : int
        Number of the joint, from 1; 0 for the base.
    at : tuple of Fraction, length 3
        m.
    turn : tuple of tuple of Fraction
        By rows, from components in its own axes to those in the body's.
    """

    joint: int = 0
    at: Point = NOWHERE
    turn: Matrix = LEVEL

    def then(self, at: Point, turn: Matrix = LEVEL) -> Pose:
        """Return the pose that stands so in this one."""
        return Pose(self.joint, plus(self.at, applied(self.turn, at)), product(self.turn, turn))


def point(values: Sequence[float]) -> Point:
    """Return three numbers as exact ones."""
    x, y, z = map(exact, values)
    return x, y, z


def vector(values: Point) -> Vector:
    """Return the nearest floats."""
    x, y, z = map(nearest, values)
    return x, y, z


def floats(matrix: Matrix) -> Turn:
    """Return a turn in floats, without what rounding leaves of zeros and ones."""
    turn = settled(matrix)
    if turn is LEVEL:
        return UPRIGHT
    return vector(turn[0]), vector(turn[1]), vector(turn[2])


def plus(a: Point, b: Point) -> Point:
    """Return the sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def times(factor: Fraction, a: Point) -> Point:
    """Return a multiple of a vector."""
    return factor * a[0], factor * a[1], factor * a[2]


def dot(a: Point, b: Point) -> Fraction:
    """Return the inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def applied(turn: Matrix, a: Point) -> Point:
    """Return a matrix times a vector."""
    if turn is LEVEL:
        return a
    return dot(turn[0], a), dot(turn[1], a), dot(turn[2], a)


def transposed(turn: Matrix) -> Matrix:
    """Return the transpose, which is the turn back."""
    if turn is LEVEL:
        return turn
    x, y, z = zip(*turn, strict=True)
    return x, y, z


def product(a: Matrix, b: Matrix) -> Matrix:
    """Return a matrix product."""
    if a is LEVEL or b is LEVEL:
        return b if a is LEVEL else a
    columns = transposed(b)
    x, y, z = (applied(columns, row) for row in a)
    return x, y, z


def settled(turn: Matrix) -> Matrix:
    """Return a turn rounded to floats, whose zeros and ones are such again."""
    if turn is LEVEL:
        return turn
    x, y, z = ((_settled(row[0]), _settled(row[1]), _settled(row[2])) for row in turn)
    return x, y, z


def _settled(value: Fraction) -> Fraction:
    near = round(value)
    return Fraction(near) if abs(value - near) <= _SAME_ENTRY else exact(nearest(value))


def square(turn: Matrix) -> bool:
    """Return whether a turn is made of quarter turns about frame axes, so that its entries are 0, 1 and -1."""
    return all(value in (-1, 0, 1) for row in turn for value in row)


def turned(angles: Sequence[float]) -> Matrix:
    """Return the turn about x, then y, then z, all three axes those of the frame turned in (URDF's roll, pitch, yaw).

    Parameters
    ----------
    angles : sequence of float, length 3
        rad.
    """
    found = LEVEL
    for axis, angle in zip((0, 1, 2), angles, strict=True):
        if angle:
            found = product(_about(axis, *cosine_and_sine(angle)), found)
    return settled(found)


def cosine_and_sine(angle: float) -> tuple[Fraction, Fraction]:
    """Return both, exactly 0, 1 or -1 at quarter turns."""
    quarters = round(angle / (math.pi / 2))
    if abs(angle - quarters * (math.pi / 2)) <= SAME_ANGLE:
        return tuple(map(Fraction, ((1, 0), (0, 1), (-1, 0), (0, -1))[quarters % 4]))  # type: ignore[return-value]
    return exact(math.cos(angle)), exact(math.sin(angle))


def _about(axis: int, c: Fraction, s: Fraction) -> Matrix:
    one, none = Fraction(1), Fraction(0)
    if axis == 0:
        return (one, none, none), (none, c, -s), (none, s, c)
    if axis == 1:
        return (c, none, s), (none, one, none), (-s, none, c)
    return (c, -s, none), (s, c, none), (none, none, one)


def unit(values: Sequence[float]) -> Point:
    """Return a direction of length 1, with exact zeros where it all but lies in a frame plane.

    Parameters
    ----------
    values : sequence of float, length 3
        Not all zero.
    """
    largest = max(map(abs, values))
    scaled = [value / largest for value in values]  # squares of extreme numbers leave the range of a float
    length = math.hypot(*scaled)
    small = [0.0 if abs(value / length) <= SAME_ANGLE else value for value in scaled]
    again = math.hypot(*small)
    return point([value / again for value in small])


def frame_axis(direction: Point) -> tuple[Axis, int] | None:
    """Return which frame axis a direction is, and its sign; None where it is none."""
    for axis in (0, 1, 2):
        if all(abs(direction[other]) <= SAME_ANGLE for other in (0, 1, 2) if other != axis):
            return axis, 1 if direction[axis] > 0 else -1
    return None


def axis_turn(axis: Axis, sign: int) -> Matrix:
    """Return a turn that leaves a frame axis as it is, or points it the other way by half a turn; along x if it can."""
    if sign > 0:
        return LEVEL
    return _about(2 if axis == 0 else 0, Fraction(-1), Fraction(0))


def joint_frame(placed: Matrix, axis: Point) -> tuple[Axis, Matrix]:
    """Return about which of its axes a joint turns and the turn of its frame, so that few general turns are needed.

    The frame is chosen, in this order: as the part has it where that is by quarter turns; as the host's body has it
    where the joint's axis is an axis of that; as the part has it; by one or two turns about frame axes.

    Parameters
    ----------
    placed : tuple of tuple of Fraction
        Turn of the part in the host's body.
    axis : tuple of Fraction, length 3
        Of the joint, in the part, of length 1.
    """
    own = frame_axis(axis)
    seen = applied(placed, axis)
    hosts = frame_axis(seen)
    if own and (square(placed) or not hosts):
        return own[0], settled(product(placed, axis_turn(*own)))
    if hosts:
        return hosts[0], axis_turn(*hosts)
    x, y, z = unit([float(value) for value in seen])
    if x == 0:
        return 1, _about(0, y, z)
    level = exact(math.hypot(x, y))
    out = product(_about(2, x / level, y / level), _about(1, level, -z))
    return 0, settled(out)
