"""An arm in space as everything behind the scene reads it: joints with bodies, frames, what acts and what is read.

Every body has a frame at the point of the joint that carries it; all that is said of a body is said in that frame.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from tmm_gen.scene.digest import UNSAID
from tmm_gen.scene.quantity import SPATIAL, Quantity
from tmm_gen.scene.signal import ALONG, Along

Vector = tuple[float, float, float]
Turn = tuple[Vector, Vector, Vector]
"""A rotation by rows; its columns are the turned axes, seen from those before the turn."""

UPRIGHT: Turn = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
ZERO: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class RigidBody:
    """All that is rigidly behind a joint, as one body.

    Parameters
    ----------
    mass : float
        kg, not negative.
    center : tuple of float, length 3
        Centre of mass from the joint's point, m.
    inertia : tuple of float, length 6
        About the centre of mass: xx, yy, zz, xy, xz, yz of the inertia matrix, kg m^2.
    """

    mass: float = 0.0
    center: Vector = ZERO
    inertia: tuple[float, float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Revolute:
    """A joint that turns about one axis of its own frame, and the body it carries.

    Parameters
    ----------
    name : str
        "shoulder" for a part of its own; "upper_3_bend_y" for one in a beam.
    host : int
        Number of the joint whose body it stands on, counted from 1; 0 for the base. Always below its own number, and
        each branch stands to its end before the next.
    at : tuple of float, length 3
        Its point in the frame of the host's body, m.
    turn : tuple of tuple of float
        Its axes at angle zero in those of the host's body.
    axis : {0, 1, 2}
        Which of its own axes it turns about: x, y or z.
    body : RigidBody
        In the joint's frame, which turns with it.
    stiffness, damping : float
        Of the joint's own spring and damper, N m/rad and N m s/rad.
    rest : float
        Angle at which the spring is slack, rad.
    armature : float
        Inertia of a rotor seen at the joint (gear ratio squared times its own), kg m^2.
    gear : float
        Turns of the motor per turn of the joint: a motor's torque acts gear-fold on the joint.
    angle, rate : float
        To start from, rad and rad/s.
    limits : tuple of float or None
        Lowest and highest angle, rad, for controllers; no stops are simulated.
    given : str
        Name of the input that is its angle; empty where it moves by forces. Such a joint stands on the base.
    """

    name: str
    host: int
    at: Vector = ZERO
    turn: Turn = UPRIGHT
    axis: Literal[0, 1, 2] = 2
    body: RigidBody = RigidBody()
    stiffness: float = 0.0
    damping: float = 0.0
    rest: float = 0.0
    armature: float = 0.0
    gear: float = 1.0
    angle: float = 0.0
    rate: float = 0.0
    limits: tuple[float, float] | None = None
    given: str = field(default="", metadata=UNSAID)


@dataclass(frozen=True)
class FreeBase:
    """A base that floats.

    Parameters
    ----------
    body : RigidBody
        All that is rigidly fixed to it, in its frame.
    at : tuple of float, length 3
        Where its frame is at first, in world axes, m.
    turn : tuple of tuple of float
        Its axes at first in those of the world.
    velocity : tuple of float, length 3
        Of its frame's origin at first, in world axes, m/s.
    rate : tuple of float, length 3
        Its angular velocity at first, in its own axes, rad/s.
    """

    body: RigidBody
    at: Vector = ZERO
    turn: Turn = UPRIGHT
    velocity: Vector = ZERO
    rate: Vector = ZERO


@dataclass(frozen=True)
class Frame:
    """A place on a body.

    Parameters
    ----------
    name : str
        Of the part whose outer end it is.
    joint : int
        Number of the joint whose body it is on, counted from 1; 0 for the base.
    at : tuple of float, length 3
        In the frame of that body, m.
    turn : tuple of tuple of float
        Its axes in those of that body.
    """

    name: str
    joint: int
    at: Vector = ZERO
    turn: Turn = UPRIGHT


@dataclass(frozen=True)
class ArmInput:
    """An input.

    Parameters
    ----------
    name : str
        Columns: with ``_x``, ``_y``, ``_z`` for a force or a moment, itself for all else.
    acts : {"torque", "force", "moment", "angle", "place_x", "place_y", "place_z"}
        Between both sides of a joint (of a motor: on the motor's side of its gear), or on a frame; or the angle of a
        joint whose motion is given; or how far the base is moved along an axis of the world, m.
    joint : int
        Number of the joint a torque acts in, or whose angle it is; 0 where it is neither.
    frame : Frame or None
        What a force or a moment acts on.
    axes : {"world", "body"}
        In whose axes its components are.
    """

    name: str
    acts: Literal["torque", "force", "moment", "angle", Along]
    joint: int = 0
    frame: Frame | None = None
    axes: Literal["world", "body"] = "body"

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of its scalars."""
        return (
            tuple(f"{self.name}_{axis}" for axis in "xyz")
            if self.acts in ("force", "moment")
            else (self.name,)
        )


ArmQuantity = Literal[
    "angle",
    "rate",
    "acceleration",
    "torque",
    "force",
    "position",
    "orientation",
    "velocity",
    "kinetic_energy",
    "elastic_energy",
    "gravitational_energy",
]


@dataclass(frozen=True)
class ArmOutput:
    """An output.

    Parameters
    ----------
    name : str
        Columns: itself for a scalar; with ``_x``, ``_y``, ``_z`` for force, position and velocity, all in world
        axes; with ``_w``, ``_x``, ``_y``, ``_z`` for an orientation: the quaternion
        that half of each joint's angle makes on the way, which never jumps, so that ``w`` may be negative.
    of : str
        angle, rate, acceleration of a joint and the torque it passes on (its spring's, damper's and motor's);
        force that a base exerts on all that stands on it by joints; position, orientation, velocity of a frame; an
        energy of the whole arm.
    joint : int
        Number of the joint; 0 where it is none's.
    frame : Frame or None
        Whose place it is.
    gear : int
        Number of the joint that the spring of its elastic gear is; 0 where there is none.
    """

    name: str
    of: ArmQuantity
    joint: int = 0
    frame: Frame | None = None
    gear: int = field(default=0, metadata=UNSAID)

    @property
    def turning(self) -> tuple[int, ...]:
        """Numbers of the joints by whose sum the outer side turns against the inner one."""
        return (self.joint, self.gear) if self.gear else (self.joint,)

    @property
    def passing(self) -> int:
        """Number of the joint that passes a torque on to the outer side."""
        return self.gear or self.joint

    @property
    def quantity(self) -> Quantity:
        """What it is."""
        return SPATIAL[self.of]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of its scalars."""
        return self.quantity.columns(self.name)


@dataclass(frozen=True)
class SpatialArm:
    """An arm in space.

    Parameters
    ----------
    joints : tuple of Revolute
        Base to tips; a beam's cells follow each other, so that like cells are neighbours.
    frames : tuple of Frame
        Outer ends of all parts, in the order of the joints: each after what it hangs on.
    gravity : tuple of float, length 3
        m/s^2, in world axes, which are those of a base that never moves.
    inputs : tuple of ArmInput
    outputs : tuple of ArmOutput
    base : FreeBase or None
        What the arm stands on; None for one that never moves, whose axes are those of the world.
    """

    joints: tuple[Revolute, ...]
    frames: tuple[Frame, ...] = ()
    gravity: Vector = ZERO
    inputs: tuple[ArmInput, ...] = ()
    outputs: tuple[ArmOutput, ...] = ()
    base: FreeBase | None = field(default=None, metadata=UNSAID)

    @property
    def along(self) -> tuple[ArmInput | None, ...]:
        """The inputs that move a prescribed base along x, y and z, (3,); None along which none does."""
        return tuple(next((i for i in self.inputs if i.acts == acts), None) for acts in ALONG)
