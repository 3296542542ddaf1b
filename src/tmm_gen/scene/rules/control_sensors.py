"""What ``[control.sensors]`` asks for is where it can be."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from tmm_gen.scene.control import Control
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.spatial.document import SpatialDocument


def gauges_on_beams(control: Control, motors: tuple[str, ...], bent: Collection[str]) -> Iterator[Finding]:
    """Find strain gauges of motors that carry no beam.

    Parameters
    ----------
    control : Control
        Which names no motor that there is not.
    motors : tuple of str
        Names of those there are.
    bent : collection of str
        Names of those that carry a beam.
    """
    strain, path = control.sensors.strain, ("control", "sensors", "strain")
    if strain is None:
        return
    able = [name for name in motors if name in bent]
    for name in strain if isinstance(strain, dict) else motors:
        if name in bent:
            continue
        told: Path = path
        value: object = strain
        if isinstance(strain, dict):
            told, value = (*path, name), strain[name]
        remedy = f"Name others that do, such as {{ {able[-1]} = 0.01 }}." if able else "Remove the key."
        yield Finding(
            told, f"the motor '{name}' carries no beam that bends, on which a gauge could be", remedy, value
        )


def beams_in_plane(document: PartsDocument, motors: tuple[str, ...]) -> set[str]:
    """Return the motors of an arm without branches that carry a beam, up to the next motor."""
    found, last = set[str](), ""
    for part in document.expansion.parts:
        last = part.name if part.name in motors else last
        if part.kind == "beam" and part.last > part.first:
            found.add(last)
    return found


def beams_in_space(document: SpatialDocument, motors: tuple[str, ...]) -> set[str]:
    """Return the same of an arm in space."""
    made, names = document.expansion, {beam.name for beam in document.beam}
    driven = {made.numbers[name]: name for name in motors}
    found = set[str]()
    for number, inner in enumerate(made.inner, start=1):
        if inner not in names:
            continue
        while number and number not in driven:
            number = made.joints[number - 1].host
        found.add(driven.get(number, ""))
    return found
