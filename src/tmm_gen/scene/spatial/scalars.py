"""Inputs and outputs of an arm in space as all scenes have them: an input for each component."""

from __future__ import annotations

from tmm_gen.scene.signal import PRESCRIBED, Input, Output
from tmm_gen.scene.spatial.arm import SpatialArm


def arm_inputs(arm: SpatialArm) -> tuple[Input, ...]:
    """Return an input for each number that acts on an arm, at the part's name."""
    found = []
    for item in arm.inputs:
        if item.acts in PRESCRIBED:
            found.append(Input.model_construct(name=item.name, at="base", acts=item.acts, part=""))
            continue
        if item.acts == "torque":
            part = arm.joints[item.joint - 1].name
            found.append(Input.model_construct(name=item.name, at=part, acts="drive", part=part))
            continue
        assert item.frame is not None
        for column, axis in zip(item.columns, "xyz", strict=True):
            part, acts = item.frame.name, f"{item.acts}_{axis}"
            found.append(Input.model_construct(name=column, at=part, acts=acts, part=part))
    return tuple(found)


def arm_outputs(arm: SpatialArm) -> tuple[Output, ...]:
    """Return an arm's outputs, at the part's name or "arm"."""
    found = []
    for item in arm.outputs:
        part = arm.joints[item.joint - 1].name if item.joint else item.frame.name if item.frame else ""
        found.append(Output.model_construct(name=item.name, at=part or "arm", of=item.of, part=part))
    return tuple(found)
