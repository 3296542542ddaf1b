"""Where the joints of an arm in space stand, as tables of C."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JointTables:
    """Of each of d joints, in the axes of the body that it stands on.

    Parameters
    ----------
    at : array, (d, 3)
        Its point, m.
    turn : array, (d, 9)
        Its axes at angle zero, as columns of a matrix that is written row by row.
    axis : tuple of int, length d
        Which of its own axes it turns about.
    """

    at: Array
    turn: Array
    axis: tuple[int, ...]

    @classmethod
    def of(cls, arm: SpatialArm) -> JointTables:
        """Return those of an arm."""
        return cls(
            np.array([joint.at for joint in arm.joints]),
            np.array([np.ravel(joint.turn) for joint in arm.joints]),
            tuple(joint.axis for joint in arm.joints),
        )
