"""What a motor of an arm in space carries: its tip, its beams, and how they lie about its axis.

All of it where the arm is at a reference and straight: no beam bends, and what has a spring is where that is slack.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from tmm_gen.scene.spatial.arm import UPRIGHT, ZERO, Frame, Revolute, SpatialArm, Turn, Vector
from tmm_gen.scene.spatial.beam import CellName
from tmm_gen.scene.spatial.reach import longest_way, ways_to_joints
from tmm_gen.scene.spatial.turns import across, applied, product, transposed, turned_about

_NEAR = 0.05
"""A tip nearer to its motor's axis than that, relative to the way along the arm, has no angle about it."""
_ASKEW = 0.1
"""A beam of whose bending so small a part is about its motor's axis shows nothing of what the motor does."""


@dataclass(frozen=True)
class Bend:
    """A joint in which a beam bends.

    Parameters
    ----------
    number, cell : int
        Of the joint, and of the cell along the beam, both from 1.
    about : float
        What it turns about the motor's axis, of 1: cosine of the angle between both axes.
    """

    number: int
    cell: int
    about: float


@dataclass(frozen=True)
class MotorEnds:
    """What the motors of an arm carry.

    Parameters
    ----------
    arm : SpatialArm
        The arm.
    beams : tuple of str
        Names of its beams.
    reference : mapping from int to float
        Angles of the joints that motors turn, by their numbers, rad.
    """

    arm: SpatialArm
    beams: tuple[str, ...]
    reference: Mapping[int, float]

    def tip(self, motor: int) -> Frame | None:
        """Return the end of the longest way along what a motor carries; None where that is near its axis.

        Parameters
        ----------
        motor : int
            Number of its joint.
        """
        end = self.end(motor)
        axis, at = self._axes[motor], self._points[motor]
        turn, point = self._bodies[end.joint]
        moved = applied(turn, end.at)
        lever = tuple(p + m - a for p, m, a in zip(point, moved, at, strict=True))
        way = math.hypot(*applied(across(axis), (lever[0], lever[1], lever[2])))
        return end if way > _NEAR * (longest_way(self.arm) or 1.0) else None

    def end(self, motor: int) -> Frame:
        """Return the end of the longest way along what a motor carries: of those as far away, the outermost."""
        carried = [frame for frame in self.arm.frames if motor in self._on_the_way(frame.joint)]
        return max(reversed(carried), key=lambda frame: self._ways[frame.joint] + math.hypot(*frame.at))

    def bends(self, motor: int) -> tuple[str, tuple[Bend, ...]] | None:
        """Return the first beam that a motor carries, and no motor behind it does, and that bends about its axis.

        Returns
        -------
        tuple of (str, tuple of Bend), or None
            Its name, and the joints in which it bends.
        """
        for name, joints in self._beams.items():
            if self._carrier(min(joints)) != motor:
                continue
            found = tuple(
                Bend(number, cell, sum(map(float.__mul__, self._axes[motor], self._axes[number])))
                for number, cell in joints.items()
            )
            if max(abs(bend.about) for bend in found) >= _ASKEW:
                return name, found
        return None

    def carries_beam(self, motor: int) -> bool:
        """Return whether a motor carries a beam that bends, about whatever, which no motor behind it carries."""
        return any(self._carrier(min(joints)) == motor for joints in self._beams.values())

    def _carrier(self, number: int) -> int:
        """Return the motor next to a joint on the way to the base; 0 where there is none."""
        return next((each for each in self._on_the_way(number) if each in self.reference), 0)

    def _on_the_way(self, number: int) -> Iterator[int]:
        while number:
            yield number
            number = self.arm.joints[number - 1].host

    @cached_property
    def _beams(self) -> dict[str, dict[int, int]]:
        """Cells by the numbers of the joints in which each beam bends, of the beams from the base outward."""
        found: dict[str, dict[int, int]] = {}
        for number, joint in enumerate(self.arm.joints, start=1):
            cell = CellName.of(joint.name)
            if cell is not None and cell.beam in self.beams and cell.way != "twist":
                found.setdefault(cell.beam, {})[number] = cell.number
        return found

    @cached_property
    def _ways(self) -> list[float]:
        return ways_to_joints(self.arm)

    @cached_property
    def _bodies(self) -> list[tuple[Turn, Vector]]:
        """How each body is turned and where its joint is, m, in the axes of the base, which comes first."""
        found: list[tuple[Turn, Vector]] = [(UPRIGHT, ZERO)]
        for number, joint in enumerate(self.arm.joints, start=1):
            turn, point = found[joint.host]
            moved = applied(turn, joint.at)
            x, y, z = (p + m for p, m in zip(point, moved, strict=True))
            own = turned_about(joint.axis, self._angle(number, joint))
            found.append((product(product(turn, joint.turn), own), (x, y, z)))
        return found

    @property
    def _points(self) -> list[Vector]:
        return [point for _, point in self._bodies]

    @cached_property
    def _axes(self) -> list[Vector]:
        """The joints' axes in those of the base, which comes first and turns about none."""
        axes = (
            transposed(turn)[j.axis] for (turn, _), j in zip(self._bodies[1:], self.arm.joints, strict=True)
        )
        return [ZERO, *axes]

    def _angle(self, number: int, joint: Revolute) -> float:
        return self.reference.get(number, joint.rest if joint.stiffness else 0.0)
