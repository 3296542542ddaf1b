"""What parts make: the joints and links of a row, and what inputs, outputs and initial motion by name mean there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

from tmm_gen.scene.beam import Tip
from tmm_gen.scene.initial import Initial, InitialTable, Values, in_order
from tmm_gen.scene.model import Base
from tmm_gen.scene.parts.order import BASE
from tmm_gen.scene.signal import FileInput, FileOutput, Input, Output, Place
from tmm_gen.scene.station import Joint, Link

OF_JOINTS = {"angle": "joint_angle", "rate": "joint_rate", "torque": "joint_torque", "force": "force"}
"""What a motor or a joint has as an output, and what scenes call it."""


@dataclass(frozen=True)
class PlacedPart:
    """A part in the row.

    Parameters
    ----------
    name, kind : str
        Its name, and that of its table.
    joint : int
        Number of the joint that it is, from 1; 0 where it is none.
    first, last : int
        Numbers of its links, from 1; for a body that of the link it sits on. 0 where it is a joint, and of a body that
        is the base.
    fixed : str
        Name of the part that is rigidly fixed to its outer end, so that it has no frame of its own; in a chain, of the
        first link that turns as one with it; else empty.
    gear : int
        Number of the joint behind a motor's shaft where the gear is elastic, else that of its own joint.
    """

    name: str
    kind: str
    joint: int = 0
    first: int = 0
    last: int = 0
    fixed: str = ""
    gear: int = 0


@dataclass(frozen=True)
class Expansion:
    """What parts make.

    Parameters
    ----------
    joints : tuple of Joint, length n
    links : tuple of Link, length n
    tip : Tip or None
        Bodies on the last part of an arm without branches; on other parts they are in the links.
    parts : tuple of PlacedPart
        From the base outward, branch by branch.
    hosts : tuple of int, length n
        Number of the link on whose outer end each joint stands, 0 for the base.
    base : Base or None
        What the arm stands on, where that is not what the file says: parts may be a hub.
    """

    joints: tuple[Joint, ...]
    links: tuple[Link, ...]
    tip: Tip | None
    parts: tuple[PlacedPart, ...]
    hosts: tuple[int, ...]
    base: Base | None = None

    @property
    def by_name(self) -> dict[str, PlacedPart]:
        """The parts by name."""
        return {part.name: part for part in self.parts}

    @property
    def on_base(self) -> frozenset[str]:
        """Names of the base, and of the bodies that are the base."""
        bodies = (part.name for part in self.parts if not part.joint and not part.last)
        return frozenset((BASE, *bodies))

    @property
    def solid(self) -> tuple[PlacedPart, ...]:
        """Beams and links, base to tip."""
        return tuple(part for part in self.parts if part.kind in ("beam", "link"))

    def inputs(self, items: Sequence[FileInput]) -> tuple[Input, ...]:
        """Return inputs at the places that names mean."""
        return tuple(_input(item, self.by_name, len(self.links)) for item in items)

    def outputs(self, items: Sequence[FileOutput]) -> tuple[Output, ...]:
        """Return outputs at the places that names mean."""
        return tuple(_output(item, self.by_name, len(self.links)) for item in items)

    def initial(self, table: InitialTable) -> Initial:
        """Return the motion at time zero of each link."""
        n = len(self.links)
        found = [list(_spread(values, self.solid, n)) for values in (table.angles, table.rates)]
        for part in self.parts:
            if part.gear > part.joint:  # the gear is not wound up: its shaft moves with what it carries
                for values in found:
                    values[part.joint - 1] = values[part.joint]
        return Initial(*map(tuple, found))


def place_of(name: str, parts: dict[str, PlacedPart], stations: int) -> Place:
    """Return the place that a name means: the outer end of a part, or "base", "tip" or "arm"."""
    part = parts.get(name)
    if part is None:
        return cast(Place, name)
    return "tip" if part.last == stations else part.last or part.joint or "base"


def _input(item: FileInput, parts: dict[str, PlacedPart], stations: int) -> Input:
    name = str(item.at)
    part = parts.get(name)
    drives = part is not None and part.joint > 0
    return Input(
        name=item.name,
        at=part.joint if part is not None and drives else place_of(name, parts, stations),
        acts="drive" if drives else item.acts,
        part=name if part is not None else "",
    )


def _output(item: FileOutput, parts: dict[str, PlacedPart], stations: int) -> Output:
    name = str(item.at)
    part = parts.get(name)
    of_joint = (part is not None and part.joint > 0) or (name == BASE and item.of in ("torque", "force"))
    return Output(
        name=item.name,
        at=part.gear if part is not None and of_joint else place_of(name, parts, stations),
        of=OF_JOINTS[item.of] if of_joint else item.of,  # type: ignore[arg-type]
        part=name if part is not None else "",
    )


def _spread(values: Values, solid: Sequence[PlacedPart], stations: int) -> tuple[float, ...]:
    """Return one number per link of what is one number for all, or one per beam and link, in order or by name."""
    values = in_order(values, [part.name for part in solid])
    if not isinstance(values, tuple):
        return (values,) * stations
    found = [0.0] * stations
    for value, part in zip(values, solid, strict=True):
        found[part.first - 1 : part.last] = [value] * (part.last - part.first + 1)
    return tuple(found)
