"""The motors of a scene, whatever its arm is."""

from __future__ import annotations

import numpy as np

from tmm_gen.control.arm.encoders import behind_gears
from tmm_gen.control.arm.motor_rows import HUB, Motor, Motors
from tmm_gen.control.arm.space_motors import space_motors
from tmm_gen.scene import Scene


def motors_of(scene: Scene) -> Motors:
    """Return the motors of a scene that has ``[control]``."""
    if scene.spatial is not None:
        return space_motors(scene)
    links = [link.length for link in scene.links]
    if scene.base.kind == "motor":  # the short form, whose motor is no part with a name
        name = next(item.name for item in scene.inputs if item.at == "base" and item.acts == "torque")
        hub = Motor(HUB, name, place=0, host=-1, end=len(links) + 1, gear=1.0, hub=(0,))
        return Motors((hub,), np.array([0.0, *links]), on_hub=True)
    acting = {item.part: item.name for item in scene.inputs if item.acts == "drive"}
    parts = [part for part in scene.parts if part.joint and part.name in acting]
    behind = behind_gears(scene)
    ends = [part.joint - 1 for part in parts[1:]] + [len(links)]
    found = tuple(
        Motor(
            part.name,
            acting[part.name],
            place=part.joint - 1,
            host=scene.host(part.joint) - 1,
            end=end,
            gear=scene.joints[part.joint - 1].gear,
            hub=(part.gear - 1 if part.name in behind else part.joint - 1,),
        )
        for part, end in zip(parts, ends, strict=True)
    )
    return Motors(found, np.array(links), on_hub=False)
