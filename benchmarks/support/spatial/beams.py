"""Beams as joints: cells of half a piece, a bend about y, one about z and a twist, and half a piece; written for tests.

Half pieces at both ends belong to what the beam stands on and to what stands on it. The order of the three joints
alternates from cell to cell: in a fixed one the turns' commutators add up, which would be an error of first order.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tmm_gen.scene.spatial.arm import UPRIGHT, Revolute, RigidBody, Turn, Vector

_ORDERS = ((1, 2, 0), (0, 2, 1))


@dataclass(frozen=True)
class Beam:
    """A uniform beam along x.

    Parameters
    ----------
    length : float
        m.
    bending : tuple of float
        ``EI_y`` and ``EI_z``, N m^2: against bending about y and about z.
    torsion : float
        ``GJ``, N m^2.
    mass, polar : float
        Per length, kg/m and kg m.
    decay : float
        Its dampers' torques are those of its springs at angles ``decay`` times the rates, s.
    """

    length: float
    bending: tuple[float, float]
    torsion: float
    mass: float
    polar: float
    decay: float = 0.0

    def piece(self, length: float) -> RigidBody:
        """Return a piece of it from its inner end on, as a slender rod."""
        mass = self.mass * length
        across = mass * length**2 / 12.0
        return RigidBody(mass, (length / 2.0, 0.0, 0.0), (self.polar * length, across, across, 0.0, 0.0, 0.0))


@dataclass(frozen=True)
class End:
    """Where the next part stands: number of a joint, 0 for the base, and place and axes in its body's frame."""

    joint: int = 0
    at: Vector = (0.0, 0.0, 0.0)
    turn: Turn = UPRIGHT


def add_beam(
    joints: list[Revolute],
    beam: Beam,
    cells: int,
    end: End | None = None,
    *,
    name: str = "beam",
    alternate: bool = True,
    twists: bool = True,
) -> End:
    """Append a beam's joints to those of an arm, and return its outer end; one that does not twist has two a cell."""
    stand = end or End()
    length = beam.length / cells
    add_body(joints, stand, beam.piece(length / 2.0))
    stiffness = (beam.torsion / length, beam.bending[0] / length, beam.bending[1] / length)
    host, at, turn = stand.joint, _plus(stand, length / 2.0), stand.turn
    for cell in range(cells):
        for axis in (a for a in _ORDERS[cell % 2 if alternate else 0] if a or twists):
            joint = Revolute(
                f"{name}_{cell + 1}_{('twist_x', 'bend_y', 'bend_z')[axis]}",
                host,
                at,
                turn,
                (0, 1, 2)[axis],
                stiffness=stiffness[axis],
                damping=beam.decay * stiffness[axis],
            )
            joints.append(joint)
            host, at, turn = len(joints), (0.0, 0.0, 0.0), UPRIGHT
        whole = length if cell + 1 < cells else length / 2.0
        joints[-1] = replace(joints[-1], body=beam.piece(whole))
        at = (length, 0.0, 0.0)
    return End(host, (length / 2.0, 0.0, 0.0))


def add_body(joints: list[Revolute], end: End, body: RigidBody) -> None:
    """Fix a body to an end; to the base, it does nothing."""
    if end.joint:
        host = joints[end.joint - 1]
        joints[end.joint - 1] = replace(host, body=joined(host.body, body, end))


def joined(body: RigidBody, other: RigidBody, end: End) -> RigidBody:
    """Return two bodies as one, the other being fixed to an end on the first."""
    turn, mass = np.array(end.turn), body.mass + other.mass
    if not mass:
        return body
    centers = np.array(body.center), np.array(end.at) + turn @ np.array(other.center)
    center = (body.mass * centers[0] + other.mass * centers[1]) / mass
    inertia = _matrix(body) + turn @ _matrix(other) @ turn.T
    for weight, place in zip((body.mass, other.mass), centers, strict=True):
        way = place - center
        inertia = inertia + weight * (way @ way * np.eye(3) - np.outer(way, way))
    x, y, z = (float(value) for value in center)
    xx, yy, zz, xy, xz, yz = (
        float(inertia[r, c]) for r, c in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    )
    return RigidBody(mass, (x, y, z), (xx, yy, zz, xy, xz, yz))


def _matrix(body: RigidBody) -> np.ndarray:
    xx, yy, zz, xy, xz, yz = body.inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _plus(end: End, along: float) -> Vector:
    x, y, z = (float(value) for value in np.array(end.at) + along * np.array(end.turn)[:, 0])
    return (x, y, z)
