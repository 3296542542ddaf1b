"""How far an arm in space reaches."""

from __future__ import annotations

import math

from tmm_gen.scene.spatial.arm import SpatialArm


def longest_way(arm: SpatialArm) -> float:
    """Return the longest way from the base along the joints to a part's outer end, m."""
    ways = [0.0]
    for joint in arm.joints:
        ways.append(ways[joint.host] + math.hypot(*joint.at))
    return max([*ways, *(ways[frame.joint] + math.hypot(*frame.at) for frame in arm.frames)])
