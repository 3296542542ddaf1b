"""Inputs and outputs of an arm in space, as a scene file has them."""

from __future__ import annotations

from typing import Literal

from pydantic import ConfigDict, Field

from tmm_gen.scene.identifier import Name
from tmm_gen.scene.parts.tables import Where
from tmm_gen.scene.signal import Along
from tmm_gen.scene.spatial.arm import ArmQuantity
from tmm_gen.scene.table import Table

OF_JOINTS: tuple[ArmQuantity, ...] = ("angle", "rate", "acceleration", "torque")
OF_BASE: tuple[ArmQuantity, ...] = ("force",)
OF_FRAMES: tuple[ArmQuantity, ...] = ("position", "orientation", "velocity")
OF_ARM: tuple[ArmQuantity, ...] = ("kinetic_energy", "elastic_energy", "gravitational_energy")


class SpatialInput(Table):
    """``[[input]]`` in space.

    Parameters
    ----------
    name : str
        Identifier.
    at : str
        Name of a part.
    acts : {"torque", "force", "moment", "angle", "place_x", "place_y", "place_z"}
        N m between both sides of a motor or joint; N or N m, as vectors, on a part's outer end; rad of a prescribed
        base, or m along an axis of the world.
    axes : {"world", "body"}
        ``in``: in whose axes a force or a moment has its components.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=False)

    name: Name = Field(description="identifier", examples=['"shoulder_torque"'])
    at: Where = Field(description="name of a part", examples=['"shoulder"'])
    acts: Literal["torque", "force", "moment", "angle", Along] = Field(
        description="torque of a motor or in a joint, force or moment on a part's outer end, "
        "angle of a prescribed base, or its place along an axis of the world",
        examples=['"torque"'],
    )
    axes: Literal["world", "body"] = Field(
        default="world",
        alias="in",
        description="axes of a force's or a moment's components",
        examples=['"body"'],
    )


class SpatialOutput(Table):
    """``[[output]]`` in space.

    Parameters
    ----------
    name : str
        Identifier.
    at : str
        Name of a part; "arm" for energies.
    of : str
        What is reported.
    """

    name: Name = Field(description="identifier", examples=['"tool"'])
    at: Where = Field(description="name of a part, or arm", examples=['"tool"'])
    of: ArmQuantity = Field(description="quantity", examples=['"position"'])
