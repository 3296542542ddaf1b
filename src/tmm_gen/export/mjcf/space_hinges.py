"""Which hinges stand on which body: joints without mass between them share one, as MuJoCo lets hinges turn in a row.

MuJoCo wants mass of every body that moves. A body may have several hinges, though, each turned by those before it: the
joints of a beam's cell, or of a universal joint, need no bodies between them, and nothing is made up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene.spatial.arm import Revolute, SpatialArm

Floats = NDArray[np.float64]

_MOST = 6
"""Hinges that one body may have."""


@dataclass(frozen=True, eq=False)
class Hinge:
    """A hinge as its body has it at angles of zero.

    Parameters
    ----------
    joint : Revolute
        Which.
    at : array, shape (3,)
        Its point, m.
    axis : array, shape (3,)
        What it turns about.
    """

    joint: Revolute
    at: Floats
    axis: Floats


@dataclass(frozen=True, eq=False)
class PlacedBody:
    """A body, its hinges and where it is at angles of zero.

    Parameters
    ----------
    host : int
        Joint whose body it stands on; 0 for the base.
    at : array, shape (3,)
        In the frame of that, m.
    turn : array, shape (3, 3)
        Its axes in those of that, by columns.
    hinges : tuple of Hinge
        From the host outward.
    """

    host: int
    at: Floats
    turn: Floats
    hinges: tuple[Hinge, ...]

    def then(self, joint: Revolute) -> PlacedBody:
        """Return the body that a further joint carries in place of this one, which has no mass."""
        way, turn = np.array(joint.at), np.array(joint.turn)
        moved = (Hinge(h.joint, turn.T @ (h.at - way), turn.T @ h.axis) for h in self.hinges)
        outer = self.at + self.turn @ way
        return PlacedBody(self.host, outer, self.turn @ turn, (*moved, _own(joint)))


def placed_bodies(arm: SpatialArm) -> dict[int, PlacedBody]:
    """Return the bodies of an arm by the number of the joint that carries each, base to tips.

    A body without mass is left out where one joint stands on it and nothing else is asked of it.
    """
    standing = [0] * (len(arm.joints) + 1)
    for joint in arm.joints:
        standing[joint.host] += 1
    frames = [item.frame for item in arm.inputs] + [output.frame for output in arm.outputs]
    asked = {frame.joint for frame in frames if frame is not None}
    found: dict[int, PlacedBody] = {}
    waiting: PlacedBody | None = None
    for number, joint in enumerate(arm.joints, start=1):
        if waiting is None:
            body = PlacedBody(joint.host, np.array(joint.at), np.array(joint.turn), (_own(joint),))
        else:
            body = waiting.then(joint)
        weighs = joint.body.mass > 0.0 or any(joint.body.inertia)
        passed = not weighs and standing[number] == 1 and number not in asked and len(body.hinges) < _MOST
        waiting = body if passed else None
        if not passed:
            found[number] = body
    return found


def _own(joint: Revolute) -> Hinge:
    return Hinge(joint, np.zeros(3), np.eye(3)[joint.axis])
