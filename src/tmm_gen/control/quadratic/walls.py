"""Half-planes and half-spaces that parts of the arm are to stay in: how far along the normals, and what turns them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.part_frame import Frame, part_frame
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.quadratic.condensed import BEYOND
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.trajectory import Keep

Array = NDArray[np.float64]


def keeps_no_walls(scene: Scene, controller: str, others: str) -> UserError:
    """Return the error of a controller that knows of none, with the names of others that do."""
    place = where(scene, "control.keep")
    return UserError(
        f"{place}: the controller '{controller}' keeps no walls; take {others}, or remove the table."
    )


def far_behind(scene: Scene, problem: ControlProblem) -> list[str]:
    """Return a line for each wall that is no bound where the arm starts, since a part is far behind it already.

    Parameters
    ----------
    scene : Scene
        With walls.
    problem : ControlProblem
        Of the scene.
    """
    if not problem.keeps:
        return []
    angles, found = rest_with(scene, problem.start, "initial.angles").angles, []
    for number, keep in enumerate(problem.keeps, 1):
        behind = keep.offset + keep.margin - float(Wall.of(scene, keep).along(angles[None])[0])
        if behind > BEYOND:
            place = where(scene, f"control.keep[{number}]")
            found.append(
                f"{place}: '{keep.frame}' starts {behind:.3g} m beyond what it is to keep, and what is "
                f"more than {BEYOND:g} m beyond is held by no wall until it is back. Set a smaller offset, or other "
                "initial.angles."
            )
    return found


@dataclass(frozen=True, eq=False)
class Wall:
    """A half-plane, or in space a half-space, and the part that stays in it.

    Parameters
    ----------
    frame : Frame
        Outer end of the part.
    normal : array, (2,) or (3,)
        Of length 1, away from the wall.
    offset : float
        Of the wall along it, m.
    """

    frame: Frame
    normal: Array
    offset: float

    @classmethod
    def of(cls, scene: Scene, keep: Keep) -> Wall:
        """Return a wall of a scene, or of one of the same parts in other links."""
        normal = np.array(keep.normal)
        normal /= np.max(
            np.abs(normal)
        )  # of any length: squares of what is very long or short leave the range
        return cls(part_frame(scene, keep.frame), normal / np.linalg.norm(normal), keep.offset)

    def along(self, angles: Array) -> Array:
        """Return how far the part is along the normal, (k,), m, for angles of the arm, (k, d), rad."""
        return np.asarray(self.frame.place(angles) @ self.normal, float)

    def along_of(self, angles: Sequence[Any]) -> Any:
        """Return the same of one pose as an expression, for symbols of CasADi."""
        place = self.frame.place_of(np.array(angles, dtype=object))
        return sum(float(share) * each for share, each in zip(self.normal, place, strict=True))

    def slopes(self, angles: Array) -> Array:
        """Return the derivatives by the angles, (k, d)."""
        return np.asarray(np.einsum("i,kid->kd", self.normal, self.frame.slopes(angles)), float)
