"""How far an arm in space reaches."""

from __future__ import annotations

import math

from tmm_gen.scene.spatial.arm import SpatialArm


def ways_to_joints(arm: SpatialArm) -> list[float]:
    """Return how far it is along the arm to each joint, m; first to the base."""
    found = [0.0]
    for joint in arm.joints:
        found.append(found[joint.host] + math.hypot(*joint.at))
    return found


def longest_way(arm: SpatialArm) -> float:
    """Return the longest way from the base along the joints to a part's outer end, m."""
    ways = ways_to_joints(arm)
    return max([*ways, *(ways[frame.joint] + math.hypot(*frame.at) for frame in arm.frames)])
