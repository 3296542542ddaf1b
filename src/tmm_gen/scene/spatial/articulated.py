"""What each joint has to turn: the inertia about its axis of all behind it, while the joints behind are free.

Featherstone's articulated bodies. With the joints' forces left out, the sweep needs each of these to be positive.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from tmm_gen.scene.spatial.arm import Revolute, RigidBody, Turn, Vector
from tmm_gen.scene.spatial.turns import Block, across, product, transposed, turned_about

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
        m, h, j = (product(product(turn, x), transposed(turn)) for x in (self.m, self.h, self.j))
        cross = across(at)
        mass = product(m, cross)
        arm = product(transposed(h), cross)  # its transpose is minus the cross matrix times h
        return Articulated(
            m,
            _sum(h, mass, -1.0),
            _sum(_sum(j, _sum(arm, transposed(arm)), -1.0), product(cross, mass), -1.0),
        )


def body_inertia(body: RigidBody) -> Articulated:
    """Return that of a rigid body about its frame's origin."""
    m, c = body.mass, body.center
    xx, yy, zz, xy, xz, yz = body.inertia
    cross = across(c)
    moment = tuple(tuple(m * value for value in row) for row in cross)
    about = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    mass = ((m, 0.0, 0.0), (0.0, m, 0.0), (0.0, 0.0, m))
    return Articulated(mass, _times(cross, -m), _sum(about, product(cross, moment), -1.0))


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
        turn = product(joint.turn, turned_about(axis, joint.angle))
        left = free[number] if pivot.vanishes else free[number].free(axis, pivot.free)
        free[joint.host] += left.moved(turn, joint.at)
        locked[joint.host] += locked[number].moved(turn, joint.at)
    return tuple(reversed(found))


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
