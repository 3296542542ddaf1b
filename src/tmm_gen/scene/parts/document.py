"""A scene file that writes its arm as parts by name."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from pydantic import Field

from tmm_gen.scene.document import Document
from tmm_gen.scene.parts.drivetrain import drivetrain
from tmm_gen.scene.parts.expansion import expanded
from tmm_gen.scene.parts.order import hanging
from tmm_gen.scene.parts.placed import Expansion
from tmm_gen.scene.parts.tables import (
    BeamPart,
    BodyPart,
    ChainJointPart,
    ChainLinkPart,
    GearPart,
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

PARTS = ("motor", "joint", "gear", "beam", "link", "body")


class PartsDocument(Document):
    """A scene file by parts, whose tables are each well formed."""

    motor: tuple[MotorPart, ...] = Field(default=(), description="driven joints")
    joint: tuple[JointPart, ...] = Field(default=(), description="joints")  # type: ignore[assignment]
    gear: tuple[GearPart, ...] = Field(default=(), description="gears")
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


class ChainDocument(PartsDocument):
    """The same of a chain, whose parts turn about one axis and do nothing else."""

    joint: tuple[ChainJointPart, ...] = Field(default=(), description="joints")  # type: ignore[assignment]
    link: tuple[ChainLinkPart, ...] = Field(default=(), description="links")  # type: ignore[assignment]

    @cached_property
    def expansion(self) -> Expansion:
        """The row of links that the parts make; only where they hang together."""
        return drivetrain(hanging(self.parts_by_table()), self.base)


def document_class(data: Mapping[str, object]) -> type[Document]:
    """Return how a file writes its arm."""
    if not by_parts(data):
        return Document
    model = data.get("model")
    return ChainDocument if isinstance(model, dict) and model.get("kind") == "chain" else PartsDocument


def by_parts(data: Mapping[str, object]) -> bool:
    """Return whether a file writes its arm as parts by name."""
    if any(table in data for table in ("motor", "gear", "body")) or isinstance(data.get("beam"), list):
        return True
    entries = (entry for key in ("joint", "link") for entry in _entries(data.get(key)))
    return any("name" in entry or "on" in entry for entry in entries)


def _entries(value: object) -> tuple[Mapping[str, object], ...]:
    return tuple(entry for entry in value if isinstance(entry, dict)) if isinstance(value, list) else ()
