"""How far an arm in space reaches."""

from __future__ import annotations

import math

from tmm_gen.scene.spatial.arm import Frame, SpatialArm


def ways_to_joints(arm: SpatialArm) -> list[float]:
    """Return how far it is along the arm to each joint, m; first to the base."""
    found = [0.0]
    for joint in arm.joints:
        found.append(found[joint.host] + math.hypot(*joint.at))
    return found


def way_to(arm: SpatialArm, frame: Frame) -> float:
    """Return how far it is along the arm to a part's outer end, m."""
    return ways_to_joints(arm)[frame.joint] + math.hypot(*frame.at)


def longest_way(arm: SpatialArm) -> float:
    """Return the longest way from the base along the joints to a part's outer end, m."""
    return max([*ways_to_joints(arm), *(way_to(arm, frame) for frame in arm.frames)])


def outermost(arm: SpatialArm) -> Frame:
    """Return the outer end that is farthest along the arm, the last of several."""
    return max(reversed(arm.frames), key=lambda frame: way_to(arm, frame))
