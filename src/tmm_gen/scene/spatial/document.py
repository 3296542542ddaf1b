"""A scene file that writes an arm in space."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from pydantic import Field

from tmm_gen.scene.document import Document
from tmm_gen.scene.model import Base
from tmm_gen.scene.parts.tables import GearPart
from tmm_gen.scene.problem import Path
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.spatial.arm import FreeBase, SpatialArm
from tmm_gen.scene.spatial.expansion import SpatialExpansion, expanded
from tmm_gen.scene.spatial.geometry import floats, turned
from tmm_gen.scene.spatial.settings import SpatialBase, SpatialModel
from tmm_gen.scene.spatial.signals import SpatialInput, SpatialOutput
from tmm_gen.scene.spatial.tables import (
    SpatialBeam,
    SpatialBody,
    SpatialJoint,
    SpatialLink,
    SpatialMotor,
    SpatialPart,
)
from tmm_gen.scene.spatial.tree import Tree, tree_of
from tmm_gen.scene.station import Joint, Link

SPATIAL_PARTS = ("motor", "joint", "beam", "link", "body")

CLAMP = Base.model_construct(kind="clamp")


class SpatialDocument(Document):
    """A scene file of an arm in space, whose tables are each well formed."""

    model: SpatialModel = Field(description="what is modelled", examples=['kind = "spatial"'])  # type: ignore[assignment]
    base: SpatialBase = Field(description="what the arm stands on", examples=['kind = "clamp"'])  # type: ignore[assignment]
    motor: tuple[SpatialMotor, ...] = Field(default=(), description="driven joints")
    joint: tuple[SpatialJoint, ...] = Field(default=(), description="joints")  # type: ignore[assignment]
    gear: tuple[GearPart, ...] = Field(default=(), description="gears", json_schema_extra={"hidden": True})
    beam: tuple[SpatialBeam, ...] = Field(default=(), description="beams")  # type: ignore[assignment]
    link: tuple[SpatialLink, ...] = Field(default=(), description="rigid links")  # type: ignore[assignment]
    body: tuple[SpatialBody, ...] = Field(default=(), description="rigid bodies")
    input: tuple[SpatialInput, ...] = Field(default=(), description="inputs")  # type: ignore[assignment]
    output: tuple[SpatialOutput, ...] = Field(default=(), description="outputs")  # type: ignore[assignment]

    @cached_property
    def tree(self) -> Tree:
        """What hangs on what."""
        tables: dict[str, tuple[SpatialPart, ...]] = {table: getattr(self, table) for table in SPATIAL_PARTS}
        return tree_of(tables)

    @cached_property
    def expansion(self) -> SpatialExpansion:
        """The joints that the parts make; only where they hang together."""
        turns = None
        if self.base.kind == "prescribed":
            named = next((item.name for item in self.input if item.acts == "angle"), "")
            turns = (self.base.axis, named) if named else None
        return expanded(self.tree, afloat=self.base.floats, turns=turns)

    @property
    def arm(self) -> SpatialArm:
        """The arm, of a document that keeps all rules."""
        made = self.expansion
        return SpatialArm(
            joints=made.moving(self.initial.angles, self.initial.rates),
            frames=tuple(made.frames.values()),
            gravity=self.model.gravity,
            inputs=made.inputs(self.input),
            outputs=made.outputs(self.output),
            base=self._floating if self.base.floats else None,
        )

    @property
    def base_turns(self) -> bool:
        """Whether an input says the angle of a prescribed base."""
        return self.base.kind == "prescribed" and any(item.acts == "angle" for item in self.input)

    @property
    def _floating(self) -> FreeBase:
        base = self.base
        turn = floats(turned(base.turn))
        return FreeBase(self.expansion.base, base.at, turn, base.velocity, base.rate)

    def beams(self) -> Mapping[Path, Uniform]:
        """Return the beams by their places in the file."""
        return {("beam", index): part for index, part in enumerate(self.beam)}

    @property
    def stations(self) -> int:
        """Number of joints."""
        return len(self.expansion.joints)

    def joints(self) -> tuple[Joint, ...]:
        """Return none: what a plane has."""
        return ()

    def links(self) -> tuple[Link, ...]:
        """Return none: what a plane has."""
        return ()
