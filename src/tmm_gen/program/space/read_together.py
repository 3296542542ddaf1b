"""Outputs of an arm in space that are read on one walk."""

from __future__ import annotations

from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.scene.spatial.arm import ArmOutput


def together(layout: SpaceLayout) -> list[list[ArmOutput]]:
    """Return outputs by what is read together: the same of several frames, on one way out to the last of them."""
    found: list[list[ArmOutput]] = []
    for output in layout.arm.outputs:
        # whatever it is: like outputs walk the same way
        group = next((g for g in found if g[0].of == output.of and _one_way(layout, [*g, output])), None)
        if group is None:
            found.append([output])
        else:
            group.append(output)
    return found


def _one_way(layout: SpaceLayout, outputs: list[ArmOutput]) -> bool:
    """Whether frames that joints carry lie behind each other."""
    joints = [o.frame.joint if o.frame else 0 for o in outputs]
    return min(joints) > 0 and {j - 1 for j in joints} <= layout.tree.inward_of(max(joints) - 1)
