"""A robot as its URDF says it, checked but not changed: what is of its mechanics, and what was passed over."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from tmm_gen.urdf.placement import Place, Vector

Kind = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"]
KINDS: tuple[Kind, ...] = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
TURNING: tuple[Kind, ...] = ("revolute", "continuous")
ONE_WAY: tuple[Kind, ...] = (*TURNING, "prismatic")
"""Those that move in one way, so that one number says where they are."""


@dataclass(frozen=True)
class Inertial:
    """Mass of a link.

    Parameters
    ----------
    line : int
        Of its element.
    mass : float
        kg, not negative.
    origin : Place
        Centre of mass, and the axes of the inertia, in the link's frame.
    inertia : tuple of float, length 6
        About the centre of mass, in those axes: xx, yy, zz, xy, xz, yz, kg m^2.
    inertia_line : int
        Of the element that says the inertia.
    """

    line: int
    mass: float
    origin: Place
    inertia: tuple[float, float, float, float, float, float]
    inertia_line: int


@dataclass(frozen=True)
class RobotLink:
    """A link.

    Parameters
    ----------
    name : str
        As written.
    line : int
        Of its element.
    inertial : Inertial or None
        None where it has no mass.
    """

    name: str
    line: int
    inertial: Inertial | None = None


@dataclass(frozen=True)
class RobotJoint:
    """A joint.

    Parameters
    ----------
    name : str
        As written.
    line : int
        Of its element.
    kind : str
        Its type.
    parent, child : str
        Names of links.
    origin : Place
        Of the child's frame in the parent's, at angle zero.
    axis : tuple of float, length 3
        Unit vector in the child's frame.
    limits : tuple of float or None
        Lowest and highest angle, rad.
    effort, velocity : float or None
        Limits, N m and rad/s.
    damping, friction : float
        N m s/rad and N m.
    mimic : str or None
        The joint whose motion it repeats.
    """

    name: str
    line: int
    kind: Kind
    parent: str
    child: str
    origin: Place
    axis: Vector = (1.0, 0.0, 0.0)
    limits: tuple[float, float] | None = None
    effort: float | None = None
    velocity: float | None = None
    damping: float = 0.0
    friction: float = 0.0
    mimic: str | None = None


@dataclass(frozen=True)
class Robot:
    """A robot.

    Parameters
    ----------
    name : str
        As written.
    file : str
        As the user named it.
    links : dict of str to RobotLink
        In the order of the file.
    joints : dict of str to RobotJoint
        In the order of the file.
    notes : tuple of str
        What was passed over, in words.
    """

    name: str
    file: str
    links: dict[str, RobotLink]
    joints: dict[str, RobotJoint]
    notes: tuple[str, ...] = ()
