"""What goes into a scene and what comes out: named inputs and outputs."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, PlainValidator

from tmm_gen.scene.identifier import Name
from tmm_gen.scene.table import Table, fault

FileActs = Literal["torque", "force_x", "force_y", "angle"]
Along = Literal["place_x", "place_y", "place_z"]
Acts = Literal[FileActs, "drive", "force_z", "moment_x", "moment_y", "moment_z", Along]
"""What inputs are; "drive", the torque of a motor or in a joint, acts between both sides (arms by parts alone); the
last ones are components in space."""
Of = Literal[
    "position",
    "angle",
    "rate",
    "velocity",
    "acceleration",
    "torque",
    "force",
    "kinetic_energy",
    "elastic_energy",
    "gravitational_energy",
    "dissipated_energy",
]
Read = Literal[Of, "joint_angle", "joint_rate", "joint_torque", "orientation"]
"""What outputs are; those of a joint between its two sides are asked for by its name (arms by parts alone), and
orientations in space."""


def _place(value: object) -> str | int:
    if value in ("base", "tip", "arm") or (isinstance(value, int) and not isinstance(value, bool)):
        return value
    raise fault(
        'must be "base", "tip" or the number of a link',
        'Write for example `at = "tip"`, or a whole number from 1 without quotes; energies are `at = "arm"`.',
    )


Place = Annotated[Literal["base", "tip", "arm"] | int, PlainValidator(_place)]
"""Where a signal acts or is measured: the base, the tip (outer end of the last link), a link from 1, or all of it."""


def station_of(at: str | int, stations: int) -> int:
    """Return the number of a place: 0 for the base, i for link i, n for the tip and for the arm as a whole."""
    if isinstance(at, int):
        return at
    return 0 if at == "base" else stations


class FileInput(Table):
    """``[[input]]`` as written: a load or a prescribed motion, zero unless it is given.

    Parameters
    ----------
    name : str
        Identifier, unique among inputs and outputs.
    at : {"base", "tip"} or int
        Where it acts; a link's forces act at its outer end.
    acts : {"torque", "force_x", "force_y", "angle"}
        N m on the hub or link, N along x or y (planar), or rad of a prescribed base, whose kernels take its rate and
        acceleration too (:func:`kernel_names`).
    """

    name: Name = Field(description="identifier", examples=['"tip_torque"'])
    at: Place = Field(description='"base", "tip" or a link number', examples=['"tip"'])
    acts: FileActs = Field(description="what the input is", examples=['"torque"'])


class Input(FileInput):
    """An input of a scene.

    Parameters
    ----------
    acts : {"torque", "force_x", "force_y", "angle", "drive"}
        "drive": N m, of the motor in a joint, times its gear between both sides.
    part : str
        Name of the part at which the file has it; empty where it has a place.
    factor : float
        What a unit of it is at its place, in the place's own angle: gears lie between a part and its station.
    """

    acts: Acts  # type: ignore[assignment]
    part: str = ""
    factor: float = 1.0


RATE, ACCELERATION = "_rate", "_acceleration"
"""What the rate and the acceleration of what is prescribed are called after its name."""

ALONG: tuple[Along, ...] = ("place_x", "place_y", "place_z")
"""What moves a prescribed base along the axes of the world, in space."""
PRESCRIBED = frozenset({"angle", *ALONG})
"""Inputs that say how a base moves, whatever that takes."""


def said(acts: str) -> str:
    """Return the words for how an input moves a prescribed base: "angle", "place along x"."""
    return acts.replace("_", " along ")


def kernel_names(item: FileInput) -> tuple[str, ...]:
    """Return the names under which kernels take an input: what is prescribed comes with its rate and acceleration."""
    if item.acts not in PRESCRIBED:
        return (item.name,)
    return (item.name, item.name + RATE, item.name + ACCELERATION)


class FileOutput(Table):
    """``[[output]]`` as written: what a simulation reports.

    Parameters
    ----------
    name : str
        Identifier, unique among inputs and outputs.
    at : {"base", "tip", "arm"} or int
        Where it is measured; energies are those of the whole arm. ``torque`` and ``force`` at link i are those in
        joint i, inboard of the link; at the base they are those in joint 1; at a planar tip, those between the last
        link and the tip mass.
    of : str
        A quantity of :mod:`tmm_gen.scene.quantity`. In a chain velocity and acceleration are those of the angle,
        in a planar scene those of the outer end of the link.
    """

    name: Name = Field(description="identifier", examples=['"tip_angle"'])
    at: Place = Field(description='"base", "tip" or a link number', examples=['"tip"'])
    of: Of = Field(description="quantity", examples=['"angle"'])


class Output(FileOutput):
    """An output of a scene.

    Parameters
    ----------
    of : str
        What joints have between their two sides is ``joint_angle``, ``joint_rate`` and ``joint_torque``, the torque
        that the inner side exerts on the outer one.
    part : str
        Name of the part at which the file has it; empty where it has a place.
    factor : float
        What it is for a unit at its place.
    """

    of: Read  # type: ignore[assignment]
    part: str = ""
    factor: float = 1.0
