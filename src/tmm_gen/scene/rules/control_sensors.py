"""What ``[control.sensors]`` asks for is where it can be."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Literal

from tmm_gen.scene.control import Control
from tmm_gen.scene.each import by_names
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.motor_ends import MotorEnds

_NO_BEAM = "carries no beam that bends, on which a gauge could be"


def sensed_in_plane(document: PartsDocument, control: Control, motors: tuple[str, ...]) -> Iterator[Finding]:
    """Find strain gauges of motors that carry no beam, of an arm without branches.

    Parameters
    ----------
    control : Control
        Which names no motor that there is not.
    motors : tuple of str
        Names of those there are.
    """
    bent, last = set[str](), ""
    for part in document.expansion.parts:
        last = part.name if part.name in motors else last
        if part.kind == "beam" and part.last > part.first:
            bent.add(last)
    yield from _where_it_can_be(
        control, "strain", motors, lambda name: "" if name in bent else f"the motor '{name}' {_NO_BEAM}"
    )


def sensed_in_space(
    document: SpatialDocument, control: Control, motors: tuple[str, ...]
) -> Iterator[Finding]:
    """Find accelerometers on the axis of their motor, and strain gauges where no bending is about it.

    Parameters
    ----------
    control : Control
        Which tells what is told by name of all motors, and names none that there is not.
    motors : tuple of str
        Names of those there are.
    """
    made = document.expansion
    reference = dict(zip(motors, by_names(control.reference, motors), strict=True))
    ends = MotorEnds(
        SpatialArm(made.joints, tuple(made.frames.values())),
        tuple(beam.name for beam in document.beam),
        {made.numbers[name]: angle for name, angle in reference.items()},
    )

    def nothing_felt(name: str) -> str:
        number = made.numbers[name]
        if ends.tip(number) is not None:
            return ""
        tip = f"the tip of the motor '{name}', the end of '{ends.end(number).name}'"
        return f"{tip}, is on its axis, where nothing is felt of its turning"

    def nothing_bent(name: str) -> str:
        number = made.numbers[name]
        if not ends.carries_beam(number):
            return f"the motor '{name}' {_NO_BEAM}"
        return "" if ends.bends(number) else f"the beam of the motor '{name}' does not bend about its axis"

    yield from _where_it_can_be(control, "accelerometer", motors, nothing_felt)
    yield from _where_it_can_be(control, "strain", motors, nothing_bent)


def _where_it_can_be(
    control: Control,
    sensor: Literal["accelerometer", "strain"],
    motors: tuple[str, ...],
    fault: Callable[[str], str],
) -> Iterator[Finding]:
    """Find sensors where they cannot be.

    Parameters
    ----------
    fault : callable
        What is wrong with that of a motor, by its name; empty where nothing is.
    """
    told, path = getattr(control.sensors, sensor), ("control", "sensors", sensor)
    if told is None:
        return
    faults = {name: fault(name) for name in motors}
    able = [name for name, wrong in faults.items() if not wrong]
    remedy = "Remove the key."
    if able:
        noise = told.get(able[-1]) if isinstance(told, dict) else told
        value = next(iter(told.values())) if noise is None else noise
        remedy = f"Name others, such as `{sensor} = {{ {able[-1]} = {value:g} }}`, or remove it."
    for name in told if isinstance(told, dict) else motors:
        if not faults[name]:
            continue
        key: Path = (*path, name) if isinstance(told, dict) else path
        yield Finding(key, faults[name], remedy, told[name] if isinstance(told, dict) else told)
