"""What each joint has to turn: the inertia about its axis of all behind it, while the joints behind are free.

Featherstone's articulated bodies. With the joints' forces left out, the sweep needs each of these to be positive.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from tmm_gen.scene.spatial.arm import Revolute, RigidBody, Turn, Vector

Block = tuple[Vector, Vector, Vector]

NONE: Block = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


@dataclass(frozen=True)
class Articulated:
    """Force and torque at a point by acceleration and angular acceleration: ``F = m a + h al, n = h^T a + j al``.

    Parameters
    ----------
    m, h, j : tuple of tuple of float
        kg, kg m, kg m^2.
    """

    m: Block = NONE
    h: Block = NONE
    j: Block = NONE

    def __add__(self, other: Articulated) -> Articulated:
        """Return that of both together."""
        return Articulated(_sum(self.m, other.m), _sum(self.h, other.h), _sum(self.j, other.j))

    def about(self, axis: int) -> float:
        """Return the moment of inertia about a frame axis, kg m^2."""
        return self.j[axis][axis]

    def free(self, axis: int, pivot: float) -> Articulated:
        """Return what is left when it turns freely about a frame axis, its inertia about that being the pivot."""
        force = tuple(row[axis] for row in self.h)
        torque = tuple(row[axis] for row in self.j)
        return Articulated(
            _sum(self.m, _outer(force, force, -1.0 / pivot)),
            _sum(self.h, _outer(force, torque, -1.0 / pivot)),
            _sum(self.j, _outer(torque, torque, -1.0 / pivot)),
        )

    def moved(self, turn: Turn, at: Vector) -> Articulated:
        """Return it about the point and in the axes of a frame in which its own has a place and a turn."""
        m, h, j = (_product(_product(turn, x), _transposed(turn)) for x in (self.m, self.h, self.j))
        across = _cross(at)
        mass = _product(m, across)
        arm = _product(_transposed(h), across)  # its transpose is minus the cross matrix times h
        return Articulated(
            m,
            _sum(h, mass, -1.0),
            _sum(_sum(j, _sum(arm, _transposed(arm)), -1.0), _product(across, mass), -1.0),
        )


def body_inertia(body: RigidBody) -> Articulated:
    """Return that of a rigid body about its frame's origin."""
    m, c = body.mass, body.center
    xx, yy, zz, xy, xz, yz = body.inertia
    across = _cross(c)
    moment = tuple(tuple(m * value for value in row) for row in across)
    about = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    mass = ((m, 0.0, 0.0), (0.0, m, 0.0), (0.0, 0.0, m))
    return Articulated(mass, _times(across, -m), _sum(about, _product(across, moment), -1.0))


@dataclass(frozen=True)
class Pivot:
    """What a joint has to turn.

    Parameters
    ----------
    free, locked : float
        Moment of inertia about its axis, the rotor's included, with the joints behind free, and with them locked,
        kg m^2.
    """

    free: float
    locked: float

    @property
    def vanishes(self) -> bool:
        """Whether nothing but rounding is left."""
        return not self.free > 1e-12 * self.locked


def pivots(joints: Sequence[Revolute], nearest_only: bool = False) -> tuple[Pivot, ...]:
    """Return what each joint has to turn at the angles that the arm starts from.

    Parameters
    ----------
    joints : sequence of Revolute
        Base to tips.
    nearest_only : bool
        Whether to leave out all that is behind a body with inertia of its own: lower bounds, which no cancellation
        spoils.
    """
    free = [Articulated()] * (len(joints) + 1)
    locked = list(free)
    found: list[Pivot] = []
    # bodies that count alone: what is behind them is left out
    alone = [True, *(nearest_only and max(joint.body.inertia[:3]) > 0.0 for joint in joints)]
    for number in range(len(joints), 0, -1):
        joint = joints[number - 1]
        own = body_inertia(joint.body)
        free[number] += own
        locked[number] += own
        axis = joint.axis
        pivot = Pivot(free[number].about(axis) + joint.armature, locked[number].about(axis) + joint.armature)
        found.append(pivot)
        if alone[joint.host]:
            continue
        turn = _product(joint.turn, _turned(axis, joint.angle))
        left = free[number] if pivot.vanishes else free[number].free(axis, pivot.free)
        free[joint.host] += left.moved(turn, joint.at)
        locked[joint.host] += locked[number].moved(turn, joint.at)
    return tuple(reversed(found))


def _turned(axis: int, angle: float) -> Turn:
    c, s = math.cos(angle), math.sin(angle)
    if axis == 0:
        return (1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c)
    if axis == 1:
        return (c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c)
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)


def _cross(a: Vector) -> Block:
    x, y, z = a
    return (0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)


def _product(a: Sequence[Sequence[float]], b: Sequence[Sequence[float]]) -> Block:
    (b00, b01, b02), (b10, b11, b12), (b20, b21, b22) = b
    x, y, z = (
        (p * b00 + q * b10 + r * b20, p * b01 + q * b11 + r * b21, p * b02 + q * b12 + r * b22)
        for p, q, r in a
    )
    return x, y, z


def _transposed(a: Block) -> Block:
    x, y, z = zip(*a, strict=True)
    return x, y, z


def _sum(a: Sequence[Sequence[float]], b: Sequence[Sequence[float]], factor: float = 1.0) -> Block:
    x, y, z = (
        (p + factor * u, q + factor * v, r + factor * w) for (p, q, r), (u, v, w) in zip(a, b, strict=True)
    )
    return x, y, z


def _times(a: Block, factor: float) -> Block:
    return _sum(NONE, a, factor)


def _outer(a: Sequence[float], b: Sequence[float], factor: float) -> Block:
    x, y, z = ((factor * p * b[0], factor * p * b[1], factor * p * b[2]) for p in a)
    return x, y, z
