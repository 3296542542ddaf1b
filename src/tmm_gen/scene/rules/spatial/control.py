"""What ``[control]`` asks for can be had of an arm in space."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.control import Control
from tmm_gen.scene.each import by_names
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.control_motors import motors_told
from tmm_gen.scene.rules.control_payload import payload_in_space
from tmm_gen.scene.rules.control_sensors import sensed_in_space
from tmm_gen.scene.rules.control_trajectory import can_be_followed, can_be_kept
from tmm_gen.scene.spatial.document import SpatialDocument


def motors_in_space_controlled(document: SpatialDocument) -> Iterator[Finding]:
    """Find a controller of an arm whose base moves, or that speaks of motors there are not."""
    control = document.control
    if control is None:
        return
    if document.base.kind != "clamp":
        yield Finding(
            ("control",),
            f'does not control arms in space on base.kind = "{document.base.kind}" yet',
            'Set base.kind = "clamp", or remove the table.',
        )
        return
    numbers = document.expansion.numbers
    turned = {numbers[item.at] for item in document.input if item.acts == "torque"}
    frames = tuple(name for name, frame in document.expansion.frames.items() if frame.joint)
    yield from can_be_kept(control, frames, "xyz")
    motors = tuple(name for name, number in numbers.items() if number in turned)
    if broken := list(motors_told(control, motors)):
        yield from broken
        return
    yield from can_be_followed(control, motors, frames, "xyz")
    yield from _beyond_limits(document, control, motors)
    yield from sensed_in_space(document, control, motors)
    yield from payload_in_space(document, control, turned)


def _beyond_limits(document: SpatialDocument, control: Control, motors: tuple[str, ...]) -> Iterator[Finding]:
    """Find references that joints have no room for."""
    made = document.expansion
    for name, angle in zip(motors, by_names(control.reference, motors), strict=True):
        limits = made.joints[made.numbers[name] - 1].limits
        if limits is None or limits[0] <= angle <= limits[1]:
            continue
        own = [name] if isinstance(control.reference, dict) else []
        yield Finding(
            ("control", "reference", *own),
            f"is beyond the limits of '{name}', [{limits[0]:g}, {limits[1]:g}] rad",
            "Set another reference, or widen `limits`.",
            angle,
        )
