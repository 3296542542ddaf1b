"""The tables of parts of an arm in space, as a scene file has them."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

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
from tmm_gen.scene.parts.tables import Part
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.spatial.arm import ZERO, Vector
from tmm_gen.scene.spatial.values import AxisVector, BothStiffnesses, Limits, Place, SixInertia
from tmm_gen.scene.table import STATION_LIMIT, NonNegative, Positive


class SpatialPart(Part):
    """What all parts in space have.

    Parameters
    ----------
    at : tuple of float, length 3
        Where it hangs, in the frame of the outer end of what it hangs on, m.
    turn : tuple of float, length 3
        Constant turn about x, then y, then z of that frame, rad.
    """

    at: Place = Field(
        default=ZERO,
        description="where it hangs, in the frame of the outer end of what it hangs on, in m",
        examples=["[0.0, 0.0, 0.2]"],
        json_schema_extra={"absent": "that outer end"},
    )
    turn: Place = Field(
        default=ZERO,
        description="constant turn in rad about x, then y, then z of that frame",
        examples=["[0.0, 1.5707963267948966, 0.0]"],
        json_schema_extra={"absent": "none"},
    )


class TurningPart(SpatialPart):
    """What motors and joints have.

    Parameters
    ----------
    axis : tuple of float, length 3
        What it turns about, in its own frame; of any length but 0.
    damping : float
        N m s/rad, not negative.
    limits : tuple of float, length 2, or None
        Lowest and highest angle, rad.
    """

    axis: AxisVector = Field(
        description='what it turns about, in its own frame: "x", "y", "z" or a vector', examples=['"z"']
    )
    damping: OutputDamping = 0.0
    limits: Limits | None = Field(
        default=None,
        description="lowest and highest angle in rad, for control: no stops are simulated",
        examples=["[-2.0, 2.0]"],
        json_schema_extra={"absent": "none"},
    )


class SpatialMotor(TurningPart):
    """``[[motor]]`` in space: a driven joint.

    Parameters
    ----------
    rotor_inertia : float
        On the motor's side, kg m^2, not negative; acts along the joint ``gear^2``-fold.
    gear : float
        Turns of the motor per turn of the joint, positive.
    stiffness : float or None
        Of the gear, at the output, N m/rad; None for a rigid gear. `damping` is then that of the shaft against what the
        motor is mounted on.
    motor_damping : float
        Of the rotor against what the motor is mounted on, on the motor's side, N m s/rad.
    damping_time : float
        Damping of the gear's spring over its stiffness, s.
    encoder : "rotor" or "output"
        On which side of an elastic gear control measures the joint's angle, which is also what its reference means.
    """

    rotor_inertia: RotorInertia = 0.0
    gear: Gear = 1.0
    stiffness: GearStiffness = None
    motor_damping: MotorDamping = 0.0
    damping_time: GearDamping = 0.0
    encoder: EncoderSide = "rotor"


class SpatialJoint(TurningPart):
    """``[[joint]]`` in space: a hinge, with a spring and a damper where they are given.

    Parameters
    ----------
    stiffness : float
        N m/rad, not negative.
    rest : float
        Angle at which the spring is slack, rad.
    """

    stiffness: NonNegative = Field(
        default=0.0, description="torsional stiffness in N m/rad; 0 is a free hinge", examples=["4000.0"]
    )
    rest: Rest = 0.0


class SpatialBeam(Uniform, SpatialPart):
    """``[[beam]]`` in space: a uniform beam along its own x axis, cut into cells.

    Parameters
    ----------
    bending_stiffness : tuple of float, length 2, or None
        EI about its y and about its z axis, N m^2.
    torsional_stiffness : float or None
        GJ, N m^2; None for a beam that does not twist, or where it follows from material and section.
    polar_inertia_per_length : float or None
        About its own axis, kg m; there must be one where the beam twists.
    links : int
        Cells.
    damping_time : float
        Damping of its springs over their stiffness, s.
    """

    bending_stiffness: BothStiffnesses | None = Field(  # type: ignore[assignment]
        default=None,
        description="EI in N m^2: one number, or those about the beam's y axis and about its z axis",
        examples=["[15.0, 15.0]"],
        json_schema_extra={"absent": "from material and section"},
    )
    torsional_stiffness: Positive | None = Field(
        default=None,
        description="GJ in N m^2",
        examples=["10.0"],
        json_schema_extra={"absent": "from material and section; without those, no twist"},
    )
    polar_inertia_per_length: Positive | None = Field(
        default=None,
        description="moment of inertia about the beam's own axis per length in kg m",
        examples=["1e-4"],
        json_schema_extra={"absent": "from material and section; without those, none"},
    )
    links: Annotated[int, Field(strict=True, ge=1, le=STATION_LIMIT)] = Field(
        description="number of cells", examples=["5"]
    )
    damping_time: BeamDamping = 0.0


class RigidPart(SpatialPart):
    """What rigid links and bodies have.

    Parameters
    ----------
    mass : float
        kg, not negative.
    center : tuple of float, length 3, or None
        Centre of mass in the part's frame, m.
    inertia : tuple of float, length 3 or 6
        About the centre of mass, in the part's axes: xx, yy, zz and maybe xy, xz, yz of the matrix, kg m^2.
    """

    mass: Mass = 0.0
    center: Place | None = Field(
        default=None,
        description="centre of mass in its own frame in m",
        examples=["[0.05, 0.0, 0.0]"],
        json_schema_extra={"absent": "of a link half way to its end, of a body where it hangs"},
    )
    inertia: SixInertia = Field(
        default=ZERO,
        description="moments of inertia about the centre of mass in kg m^2: xx, yy, zz, or xx, yy, zz, xy, xz, yz",
        examples=["[1e-3, 1e-3, 5e-4]"],
        json_schema_extra={"absent": "none"},
    )

    @property
    def outer(self) -> Vector:
        """Where its outer end is, in its own frame, m."""
        return ZERO

    @property
    def middle(self) -> Vector:
        """Its centre of mass in its own frame, m."""
        x, y, z = self.outer
        return self.center if self.center is not None else (x / 2, y / 2, z / 2)


class SpatialLink(RigidPart):
    """``[[link]]`` in space: a rigid link.

    Parameters
    ----------
    length : float or None
        Along its own x axis to its outer end, m.
    end : tuple of float, length 3, or None
        The outer end, where it is not on that axis, m.
    """

    length: Positive | None = Field(
        default=None,
        description="length along its own x axis in m",
        examples=["0.4"],
        json_schema_extra={"absent": "given by end"},
    )
    end: Place | None = Field(
        default=None,
        description="its outer end in its own frame in m, where the next part hangs",
        examples=["[0.1, 0.0, 0.3]"],
        json_schema_extra={"absent": "on its x axis"},
    )

    @property
    def outer(self) -> Vector:
        """Where its outer end is, in its own frame, m."""
        return self.end if self.end is not None else (self.length or 0.0, 0.0, 0.0)


class SpatialBody(RigidPart):
    """``[[body]]`` in space: a rigid body where it hangs; its frame is the one it hangs by."""
