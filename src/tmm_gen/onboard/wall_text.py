"""What the templates of real-time iterations ask for about walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tmm_gen.control.arm.space_frame import SpaceFrame
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.control.task.terms import Kind
from tmm_gen.onboard.held_text import HeldText
from tmm_gen.onboard.joint_tables import JointTables
from tmm_gen.onboard.rti_data import RtiData


@dataclass(frozen=True, eq=False)
class WallText(HeldText):
    """The part of :class:`~tmm_gen.onboard.rti_text.RtiText` that is about walls.

    Parameters
    ----------
    data : RtiData
        Tables.
    full : bool
        Whether sensitivities are computed along the trajectory.
    """

    data: RtiData
    full: bool

    @property
    def walls(self) -> tuple[Wall, ...]:
        """What parts are to stay on one side of."""
        return self.data.walls

    @property
    def keeps_answers(self) -> bool:
        """Whether those of all angles are kept, so that walls are found about the plan."""
        return bool(self.walls) and not self.full

    @property
    def answered(self) -> int:
        """Outputs that go with angles and rates alone, so that their answers are kept: all but those at walls."""
        return len(self.data.outputs) - len(self.walls)

    @property
    def steady_kinds(self) -> list[Kind]:
        """Those that are made of the answers that are kept."""
        return [kind for kind in self.data.kinds if kind.what != "keep"]

    @property
    def arm_joints(self) -> JointTables:
        """Where the joints of an arm in space stand."""
        assert self.data.joints is not None
        return self.data.joints

    def reach(self, wall: Wall) -> int:
        """Return how many links, in space joints, there are up to the part that keeps away from a wall."""
        if isinstance(wall.frame, SpaceFrame):
            return len(wall.frame.joints)
        return int(np.flatnonzero(wall.frame.lengths)[-1]) + 1
