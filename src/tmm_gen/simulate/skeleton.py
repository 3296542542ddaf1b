"""An arm in space as pictures show it: points on its centre line over time, and which of them lines join."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_afloat import AfloatArm
from tmm_gen.reference.spatial_places import Tree
from tmm_gen.reference.spatial_turns import turned
from tmm_gen.scene.spatial.arm import ZERO, SpatialArm, Vector
from tmm_gen.scene.spatial.reach import longest_way

Array = NDArray[np.float64]

PIN = 0.04
"""Half the length at which a joint's axis is drawn, as a share of the arm's reach."""


@dataclass(frozen=True)
class Spot:
    """A point on a body.

    Parameters
    ----------
    body : int
        Number of the joint that carries the body, counted from 1; 0 for the base.
    at : tuple of float, length 3
        In the frame of that body, m.
    """

    body: int
    at: Vector


@dataclass(frozen=True)
class Tip:
    """A place where an arm ends.

    Parameters
    ----------
    spot : int
        Number of its spot.
    name : str
        Of the part that ends there; the outermost, where several do.
    """

    spot: int
    name: str


@dataclass(frozen=True)
class Skeleton:
    """The points of an arm in space, and the lines between them.

    Joints at one point share a spot, as those of a beam's cell do; so do frames with joints, and with each other.

    Parameters
    ----------
    arm : SpatialArm
    """

    arm: SpatialArm

    @property
    def spots(self) -> tuple[Spot, ...]:
        """The base's own first, then those of joints and frames, m in all."""
        return self._found[0]

    @property
    def of_joints(self) -> tuple[int, ...]:
        """Numbers of the spots at which the base and the joints are, (n + 1,)."""
        return self._found[1]

    @property
    def of_frames(self) -> tuple[int, ...]:
        """Numbers of the spots at which the frames are."""
        return self._found[2]

    @cached_property
    def _found(self) -> tuple[tuple[Spot, ...], tuple[int, ...], tuple[int, ...]]:
        spots = [Spot(0, ZERO)]
        numbers: dict[tuple[int, Vector], int] = {}
        own = [0]

        def number(body: int, at: Vector) -> int:
            """Return the spot that is there; two ways of writing one place may differ by rounding."""
            x, y, z = (round(value, 12) + 0.0 for value in at)
            if (x, y, z) == ZERO:
                return own[body]
            if (body, (x, y, z)) not in numbers:
                numbers[body, (x, y, z)] = len(spots)
                spots.append(Spot(body, at))
            return numbers[body, (x, y, z)]

        for joint in self.arm.joints:
            own.append(number(joint.host, joint.at))
        frames = tuple(number(frame.joint, frame.at) for frame in self.arm.frames)
        return tuple(spots), tuple(own), frames

    @cached_property
    def parents(self) -> tuple[int, ...]:
        """Number of the spot that each is joined to, -1 for the base's own, (m,).

        An arm does not say which of the parts on a body is fixed to which: each spot is joined to the nearest of its
        body, beginning at the joint's, so that all lines together are as short as they can be.
        """
        parents = [-1] * len(self.spots)
        on_body: dict[int, list[int]] = {}
        for number, spot in enumerate(self.spots[1:], start=1):
            on_body.setdefault(spot.body, []).append(number)
        for body, others in on_body.items():
            joined = self.of_joints[body]
            nearest = {other: (math.dist(self.spots[other].at, ZERO), joined) for other in others}
            while nearest:
                joined = min(nearest, key=lambda other: (nearest[other][0], other))
                parents[joined] = nearest.pop(joined)[1]
                for other, (distance, _) in nearest.items():
                    way = math.dist(self.spots[other].at, self.spots[joined].at)
                    if way < distance:
                        nearest[other] = (way, joined)
        return tuple(parents)

    @cached_property
    def lines(self) -> tuple[tuple[int, ...], ...]:
        """Spots along each limb: from the base or a fork to the next fork or the end."""
        return tuple(self._limbs())

    def _limbs(self) -> Iterator[tuple[int, ...]]:
        behind = self._behind
        forks = [0]
        while forks:
            fork = forks.pop()
            for spot in behind[fork]:
                line = [fork, spot]
                while len(behind[line[-1]]) == 1:
                    line += behind[line[-1]]
                yield tuple(line)
                if behind[line[-1]]:
                    forks.append(line[-1])

    @cached_property
    def _behind(self) -> tuple[tuple[int, ...], ...]:
        found: list[list[int]] = [[] for _ in self.spots]
        for number, parent in enumerate(self.parents[1:], start=1):
            found[parent].append(number)
        return tuple(map(tuple, found))

    @cached_property
    def tips(self) -> tuple[Tip, ...]:
        """The ends that move, in the order of the frames."""
        names = {
            spot: frame.name
            for spot, frame in zip(self.of_frames, self.arm.frames, strict=True)
            if (frame.joint or self.arm.base) and spot and not self._behind[spot]
        }
        return tuple(Tip(spot, name) for spot, name in names.items())

    @cached_property
    def pins(self) -> tuple[int, ...]:
        """Numbers of the joints, counted from 1, that are parts by themselves, so that their axes are worth showing.

        A joint that turns about the same line as the one it stands on, as that of a gear does, is left out.
        """
        parts = {frame.name for frame in self.arm.frames}
        found = []
        for number, joint in enumerate(self.arm.joints, start=1):
            if joint.name not in parts:
                continue
            same = joint.host and self.of_joints[joint.host] == self.of_joints[number]
            along = abs(joint.turn[self.arm.joints[joint.host - 1].axis][joint.axis]) if same else 0.0
            if along < 1.0 - 1e-9:
                found.append(number)
        return tuple(found)

    @property
    def pin(self) -> float:
        """Half the length of a pin, m."""
        return PIN * longest_way(self.arm)

    def points(self, angles: Array) -> Array:
        """Return where the spots are.

        Parameters
        ----------
        angles : array, (k, n)
            Of the joints at some instants, rad; (k, 7 + n) where the base floats, its place and quaternion first.

        Returns
        -------
        array, (k, m, 3)
            In world axes, m.
        """
        return self.places(angles)[0]

    def places(self, angles: Array) -> tuple[Array, Array]:
        """Return where the spots are, (k, m, 3), and the outer ends of the pins, (k, pins, 3), m.

        A pin reaches as far to the other side of its joint's spot.

        Parameters
        ----------
        angles : array, (k, n)
            Of the joints at some instants, rad.
        """
        afloat = self.arm.base is not None
        places = (AfloatArm(self.arm) if afloat else Tree(self.arm)).places(angles)
        points = np.empty((len(angles), len(self.spots), 3))
        for number, spot in enumerate(self.spots):
            at = np.array(spot.at)
            if spot.body:
                body = spot.body - 1
                points[:, number] = places.point[:, body] + places.turn[:, body] @ at
            elif afloat:
                points[:, number] = angles[:, :3] + turned(angles[:, 3:7]) @ at
            else:
                points[:, number] = at
        joints = list(self.pins)
        ends = (
            points[:, [self.of_joints[joint] for joint in joints]]
            + self.pin * places.axis[:, [joint - 1 for joint in joints]]
        )
        return points, ends
