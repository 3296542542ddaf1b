"""A scene file that writes its arm as parts by name."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from pydantic import Field

from tmm_gen.scene.document import Document
from tmm_gen.scene.parts.expansion import Expansion, expanded
from tmm_gen.scene.parts.tables import (
    BeamPart,
    BodyPart,
    JointPart,
    LinkPart,
    MotorPart,
    Part,
    PartInput,
    PartOutput,
)
from tmm_gen.scene.problem import Path
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.station import Joint, Link

PARTS = ("motor", "joint", "beam", "link", "body")


class PartsDocument(Document):
    """A scene file by parts, whose tables are each well formed."""

    motor: tuple[MotorPart, ...] = Field(default=(), description="driven joints")
    joint: tuple[JointPart, ...] = Field(default=(), description="joints")  # type: ignore[assignment]
    beam: tuple[BeamPart, ...] = Field(default=(), description="beams")  # type: ignore[assignment]
    link: tuple[LinkPart, ...] = Field(default=(), description="rigid links")  # type: ignore[assignment]
    body: tuple[BodyPart, ...] = Field(default=(), description="rigid bodies")
    input: tuple[PartInput, ...] = Field(default=(), description="inputs")
    output: tuple[PartOutput, ...] = Field(default=(), description="outputs")

    @cached_property
    def expansion(self) -> Expansion:
        """The row of links that the parts make; only where they hang together."""
        return expanded(self)

    def parts_by_table(self) -> dict[str, tuple[Part, ...]]:
        """Return all parts by the name of their table."""
        return {table: getattr(self, table) for table in PARTS}

    def beams(self) -> Mapping[Path, Uniform]:
        """Return the beams by their places in the file."""
        return {("beam", index): part for index, part in enumerate(self.beam)}

    @property
    def stations(self) -> int:
        """Number of links, n."""
        return len(self.expansion.links)

    def joints(self) -> tuple[Joint, ...]:
        """Return the joints, base to tip."""
        return self.expansion.joints

    def links(self) -> tuple[Link, ...]:
        """Return the links, base to tip."""
        return self.expansion.links


def by_parts(data: Mapping[str, object]) -> bool:
    """Return whether a file writes its arm as parts by name."""
    if "motor" in data or "body" in data or isinstance(data.get("beam"), list):
        return True
    entries = (entry for key in ("joint", "link") for entry in _entries(data.get(key)))
    return any("name" in entry or "on" in entry for entry in entries)


def _entries(value: object) -> tuple[Mapping[str, object], ...]:
    return tuple(entry for entry in value if isinstance(entry, dict)) if isinstance(value, list) else ()
