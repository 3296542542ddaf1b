"""The whole scene file as written, table by table."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import Field

from tmm_gen.scene.beam import BeamEntry, Tip, beam_joints, beam_links
from tmm_gen.scene.control import Control
from tmm_gen.scene.emit import Emit
from tmm_gen.scene.identifier import SceneName, Title
from tmm_gen.scene.initial import InitialTable
from tmm_gen.scene.integrator import IntegratorTable
from tmm_gen.scene.model import Base, FlatModel
from tmm_gen.scene.problem import Path
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.signal import FileInput, FileOutput
from tmm_gen.scene.station import Joint, JointEntry, Link, LinkEntry
from tmm_gen.scene.table import Table


class Document(Table):
    """A scene file whose tables are each well formed; whether they fit together is for the rules to say."""

    name: SceneName = Field(description="identifier, names the generated package", examples=['"arm10"'])
    title: Title = Field("", description="one line of text", examples=['"Ten-link arm"'])
    model: FlatModel = Field(description="what is modelled", examples=['kind = "chain"'])
    integrator: IntegratorTable = Field(
        description="time integration", examples=['name = "newmark"` and `step = 0.001']
    )
    base: Base = Field(description="what the arm stands on", examples=['kind = "clamp"'])
    beam: BeamEntry | None = Field(default=None, description="uniform beam")
    tip: Tip | None = Field(default=None, description="body at the tip")
    joint: tuple[JointEntry, ...] = Field(default=(), description="joints, base to tip")
    link: tuple[LinkEntry, ...] = Field(default=(), description="links, base to tip")
    input: tuple[FileInput, ...] = Field(default=(), description="inputs")
    output: tuple[FileOutput, ...] = Field(default=(), description="outputs")
    initial: InitialTable = Field(default_factory=InitialTable, description="motion at time zero")
    emit: Emit = Field(default_factory=Emit, description="what is generated")
    control: Control | None = Field(default=None, description="controller")

    def beams(self) -> Mapping[Path, Uniform]:
        """Return the beams by their places in the file."""
        return {("beam",): self.beam} if self.beam else {}

    @property
    def stations(self) -> int:
        """Number of links, n."""
        return self.beam.links if self.beam else sum(entry.repeat for entry in self.link)

    def joints(self) -> tuple[Joint, ...]:
        """Return the joints, base to tip, those of the beam or those written out."""
        if self.beam:
            return beam_joints(self.beam.expanded())
        return tuple(joint for entry in self.joint for joint in entry.expanded())

    def links(self) -> tuple[Link, ...]:
        """Return the links, base to tip, those of the beam or those written out."""
        if self.beam:
            return beam_links(self.beam.expanded())
        return tuple(link for entry in self.link for link in entry.expanded())
