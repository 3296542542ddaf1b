"""What stands between base and tip: joints and links."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from tmm_gen.scene.table import STATION_LIMIT, Fraction, NonNegative, Positive, Table

Repeat = Annotated[int, Field(strict=True, ge=1, le=STATION_LIMIT)]


class Joint(Table):
    """A torsion spring with a viscous damper beside it, at the inboard end of a link; maybe with a motor in it.

    Parameters
    ----------
    stiffness : float
        N m/rad; 0 is a free hinge, which arms by parts alone have.
    damping : float
        N m s/rad, not negative.
    rest : float
        Angle between both sides at which the spring is slack, rad.
    rotor_inertia : float
        Of a motor, on its own side, kg m^2.
    gear : float
        Turns of the motor per turn of the joint.
    """

    stiffness: NonNegative
    damping: NonNegative = 0.0
    rest: float = 0.0
    rotor_inertia: NonNegative = 0.0
    gear: Positive = 1.0

    @property
    def armature(self) -> float:
        """What the rotor's inertia is at the joint, kg m^2: ``gear^2`` times it, between both sides."""
        return self.gear * self.gear * self.rotor_inertia  # a power would raise where this is infinite


class Link(Table):
    """A rigid link; a chain knows its inertia only.

    Parameters
    ----------
    inertia : float
        About the centre of mass, kg m^2, positive.
    mass : float
        kg; positive in a planar scene, 0 in a chain.
    length : float
        m; positive in a planar scene, 0 in a chain.
    center : float
        Place of the centre of mass along the link: 0 inboard end, 1 outboard end.
    """

    inertia: Positive = Field(description="moment of inertia in kg m^2", examples=["1.0"])
    mass: Positive = Field(default=0.0, description="mass in kg", examples=["0.5"])
    length: Positive = Field(default=0.0, description="length in m", examples=["0.1"])
    center: Fraction = Field(
        default=0.5, description="centre of mass along the link, 0 to 1", examples=["0.5"]
    )

    @property
    def massless(self) -> bool:
        """Whether it stands for what has no inertia of its own: the shaft behind a motor's elastic gear."""
        return self.inertia == 0.0


class JointEntry(Table):
    """``[[joint]]`` as written: one or more identical joints."""

    stiffness: Positive = Field(description="torsional stiffness in N m/rad", examples=["20.0"])
    damping: NonNegative = Field(default=0.0, description="torsional damping in N m s/rad", examples=["0.5"])
    repeat: Repeat = Field(default=1, description="number of identical joints", examples=["10"])

    def expanded(self) -> tuple[Joint, ...]:
        """Return the joints this entry stands for."""
        return (Joint.model_construct(stiffness=self.stiffness, damping=self.damping),) * self.repeat


class LinkEntry(Link):
    """``[[link]]`` as written: one or more identical links."""

    repeat: Repeat = Field(default=1, description="number of identical links", examples=["10"])

    def expanded(self) -> tuple[Link, ...]:
        """Return the links this entry stands for."""
        link = Link.model_construct(
            inertia=self.inertia, mass=self.mass, length=self.length, center=self.center
        )
        return (link,) * self.repeat
