"""What ``[control]`` asks for can be had of an arm whose motors are parts by name."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.control import Control
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.rules.control import told_by_name, within_reach
from tmm_gen.scene.rules.control_payload import payload_in_plane
from tmm_gen.scene.rules.control_sensors import sensed_in_plane
from tmm_gen.scene.rules.control_trajectory import can_be_followed, can_be_kept
from tmm_gen.scene.table import closest

_OF_SOME: tuple[Path, ...] = (("control", "sensors", "accelerometer"), ("control", "sensors", "strain"))
"""What some motors have and others need not."""


def motors_controlled(document: PartsDocument) -> Iterator[Finding]:
    """Find a controller of an arm without driven joints, or one that speaks of motors there are not."""
    control = document.control
    if control is None:
        return
    if document.base.kind != "clamp":
        yield Finding(
            ("control",),
            f'does not control arms by parts on base.kind = "{document.base.kind}" yet',
            'Set base.kind = "clamp", or remove the table.',
        )
        return
    made = document.expansion
    if made.hosts != tuple(range(len(made.hosts))):
        yield Finding(
            ("control",), "does not control arms that branch yet", "Remove it, or one of the branches."
        )
        return
    motors = driven(document)
    if broken := list(motors_told(control, motors)):
        yield from broken
        return
    frames = tuple(part.name for part in made.parts if part.last)
    yield from can_be_kept(control, frames, "xy")
    yield from can_be_followed(control, motors, frames, "xy")
    yield from sensed_in_plane(document, control, motors)
    yield from payload_in_plane(document, control)


def motors_told(control: Control, motors: tuple[str, ...]) -> Iterator[Finding]:
    """Find a controller of no motor, or of motors there are not.

    Parameters
    ----------
    motors : tuple of str
        Names of the joints that inputs turn.
    """
    if not motors:
        yield Finding(
            ("control",),
            "turns motors by their torques, and no input is one",
            'Add [[input]] with `name = "..."`, `at = "<motor>"`, `acts = "torque"`.',
        )
        return
    broken = False
    for path, values in told_by_name(control):
        for name in (name for name in values if name not in motors):
            broken = True
            yield Finding((*path, name), "is not the name of a driven motor", closest(name, motors))
        missing = [name for name in motors if name not in values]
        if missing and path not in _OF_SOME:
            broken = True
            yield Finding(
                path, f"leaves out {', '.join(missing)}", f"Write one value for each of {', '.join(motors)}."
            )
    if not broken:
        yield from within_reach(control, motors)


def driven(document: PartsDocument) -> tuple[str, ...]:
    """Return the names of the joints that inputs turn, from the base outward."""
    turned = {str(item.at) for item in document.input}
    return tuple(part.name for part in document.expansion.parts if part.joint and part.name in turned)
