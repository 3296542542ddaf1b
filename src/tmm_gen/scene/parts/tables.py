"""The tables of parts as a scene file has them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, PlainValidator

from tmm_gen.scene.beam import Springs
from tmm_gen.scene.identifier import Name
from tmm_gen.scene.parts.fields import (
    BeamDamping,
    EncoderSide,
    Gear,
    GearDamping,
    GearStiffness,
    Mass,
    MotorDamping,
    OutputDamping,
    Rest,
    RotorInertia,
)
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.signal import FileInput, FileOutput
from tmm_gen.scene.table import STATION_LIMIT, Finite, Fraction, NonNegative, Positive, Table, fault

PartSprings = Literal["finite-segment", Springs]

ENDS = ("base", "arm")
"""Words for places that no part may be called by."""


def _part_name(value: str) -> str:
    if value in ENDS:
        raise fault(f'"{value}" is the name of a place', f"Choose another, for example '{value}_1'.")
    return value


def _named(value: object) -> object:
    """Reject what is no name of a part, numbers above all."""
    if isinstance(value, str):
        return value
    raise fault("must be the name of a part", 'Write a name in quotes, for example `"elbow"`.')


def _turning(value: float) -> float:
    if value == 0.0:
        raise fault(
            "is 0: what hangs on the gear would turn without end", "Write turns per turn, for example 5.0."
        )
    return value


PartName = Annotated[Name, BeforeValidator(_named), AfterValidator(_part_name)]
Where = Annotated[str, PlainValidator(_named)]


class Part(Table):
    """What all parts have.

    Parameters
    ----------
    name : str
        Identifier.
    on : str or None
        Name of the part it hangs on, or "base"; None where the file leaves it out.
    """

    name: PartName = Field(description="name of the part", examples=['"elbow"'])
    on: Where | None = Field(
        default=None,
        description="what it hangs on: a part's name or base",
        examples=['"upper"'],
        json_schema_extra={"absent": "the base"},
    )


class MotorPart(Part):
    """``[[motor]]``: a driven joint.

    Parameters
    ----------
    rotor_inertia : float
        On the motor's side, kg m^2, not negative; acts along the joint ``gear^2``-fold.
    gear : float
        Turns of the motor per turn of the joint, positive.
    damping : float
        At the output, N m s/rad, not negative; with an elastic gear, of the shaft against what the motor is mounted on.
    stiffness : float or None
        Of the gear, at the output, N m/rad; None for a rigid gear.
    motor_damping : float
        Of the rotor against what the motor is mounted on, on the motor's side, N m s/rad.
    damping_time : float
        Damping of the gear's spring over its stiffness, s.
    encoder : "rotor" or "output"
        On which side of an elastic gear control measures the joint's angle, which is also what its reference means.
    """

    rotor_inertia: RotorInertia = 0.0
    gear: Gear = 1.0
    damping: OutputDamping = 0.0
    stiffness: GearStiffness = None
    motor_damping: MotorDamping = 0.0
    damping_time: GearDamping = 0.0
    encoder: EncoderSide = "rotor"


class JointPart(Part):
    """``[[joint]]`` by name: a hinge, with a spring and a damper where they are given.

    Parameters
    ----------
    stiffness, damping : float
        N m/rad, N m s/rad, not negative.
    rest : float
        Angle at which the spring is slack, rad.
    """

    stiffness: NonNegative = Field(
        default=0.0, description="torsional stiffness in N m/rad; 0 is a free hinge", examples=["12.0"]
    )
    damping: NonNegative = Field(default=0.0, description="torsional damping in N m s/rad", examples=["0.5"])
    rest: Rest = 0.0


class BeamPart(Uniform, Part):
    """``[[beam]]``: a uniform beam, cut into rigid links with springs between them."""

    links: Annotated[int, Field(strict=True, ge=1, le=STATION_LIMIT)] = Field(
        description="number of pieces", examples=["5"]
    )
    springs: PartSprings | None = Field(
        default=None,
        description="rule of the springs",
        examples=['"finite-segment"'],
        json_schema_extra={"absent": "finite-segment on a motor or joint, clamped-segment elsewhere"},
    )
    damping_time: BeamDamping = 0.0


class LinkPart(Part):
    """``[[link]]`` by name: a rigid link."""

    length: Positive = Field(description="length in m", examples=["0.4"])
    mass: Positive = Field(description="mass in kg", examples=["0.2"])
    inertia: Positive = Field(
        description="moment of inertia about the centre of mass in kg m^2", examples=["0.003"]
    )
    center: Fraction = Field(
        default=0.5, description="centre of mass along the link, 0 to 1", examples=["0.5"]
    )


class BodyPart(Part):
    """``[[body]]``: a rigid body on the outer end of a beam or a link."""

    on: Where | None = Field(
        default=None,
        description="the beam or link on whose outer end it sits",
        examples=['"upper"'],
        json_schema_extra={"absent": "the only one"},
    )
    mass: Mass = 0.0
    inertia: NonNegative = Field(
        default=0.0, description="moment of inertia about its own centre in kg m^2", examples=["0.001"]
    )


class GearPart(Part):
    """``[[gear]]`` of a chain: a gear pair; rigid, or with teeth that give way.

    Parameters
    ----------
    ratio : float
        Turns of what it hangs on per turn of what hangs on it; negative where the sense of turning changes.
    stiffness, damping : float
        Of the teeth, seen from its outer side, N m/rad and N m s/rad; without stiffness it is rigid.
    """

    ratio: Annotated[Finite, AfterValidator(_turning)] = Field(
        description="turns of what it hangs on per turn of what hangs on it", examples=["5.0"]
    )
    stiffness: Positive | None = Field(
        default=None,
        description="stiffness of the teeth in N m/rad, seen from the outer side",
        examples=["2e4"],
        json_schema_extra={"absent": "rigid"},
    )
    damping: NonNegative = Field(
        default=0.0,
        description="damping of the teeth in N m s/rad, seen from the outer side",
        examples=["2.0"],
    )


class ChainJointPart(Part):
    """``[[joint]]`` by name in a chain: a shaft or a coupling that twists."""

    stiffness: Positive = Field(description="torsional stiffness in N m/rad", examples=["300.0"])
    damping: NonNegative = Field(default=0.0, description="torsional damping in N m s/rad", examples=["0.5"])


class ChainLinkPart(Part):
    """``[[link]]`` by name in a chain: a disc, rigidly on what it hangs on.

    Parameters
    ----------
    inertia : float
        About the axis of the chain, kg m^2, positive.
    mass, length, center : float
        Not of a chain, and refused.
    """

    inertia: Positive = Field(description="moment of inertia about the axis in kg m^2", examples=["2e-3"])
    mass: Finite = Field(default=0.0, json_schema_extra={"hidden": True})
    length: Finite = Field(default=0.0, json_schema_extra={"hidden": True})
    center: Finite = Field(default=0.0, json_schema_extra={"hidden": True})


class PartInput(FileInput):
    """``[[input]]`` of an arm by parts."""

    at: Where = Field(description="name of a part, or base", examples=['"elbow"'])  # type: ignore[assignment]


class PartOutput(FileOutput):
    """``[[output]]`` of an arm by parts."""

    at: Where = Field(description="name of a part, base or arm", examples=['"tool"'])  # type: ignore[assignment]
