"""What the sidecar of a URDF says of it: which joints and links give way, and which joints stay where they are."""

from __future__ import annotations

from dataclasses import dataclass, field

from tmm_gen.urdf.placement import Vector


@dataclass(frozen=True)
class JointGives:
    """``[joint.NAME]``.

    Parameters
    ----------
    line : int
        Of its table.
    stiffness : float or None
        Of the gear, at the joint, N m/rad; None where it is rigid.
    damping : float or None
        Of the gear's spring, N m s/rad; of the joint where the gear is rigid. None: as the URDF says, of the joint.
    rotor_inertia : float
        On the motor's side, kg m^2.
    gear : float
        Turns of the motor per turn of the joint.
    lock : float or None
        Angle, rad, or way, m, at which the joint stays; None where it moves.
    """

    line: int
    stiffness: float | None = None
    damping: float | None = None
    rotor_inertia: float = 0.0
    gear: float = 1.0
    lock: float | None = None


@dataclass(frozen=True)
class LinkGives:
    """``[link.NAME]``.

    Parameters
    ----------
    line : int
        Of its table.
    links : int
        Cells of the beam.
    bending : tuple of float, length 2
        EI about y and about z of the beam, N m^2.
    torsion : float or None
        GJ, N m^2; None where it does not twist.
    polar : float or None
        Polar inertia per length, kg m; None where it follows.
    gyration : float or None
        Square of the section's polar radius of gyration, m^2: polar inertia per mass. None without a section.
    damping_time : float
        Damping of its springs over their stiffness, s.
    to : str or None
        Joint to whose origin it reaches; None for the only one.
    end : tuple of float or None
        Its end in the link's frame, m, where no joint says it.
    """

    line: int
    links: int
    bending: tuple[float, float]
    torsion: float | None = None
    polar: float | None = None
    gyration: float | None = None
    damping_time: float = 0.0
    to: str | None = None
    end: Vector | None = None


@dataclass(frozen=True)
class Flexibility:
    """A sidecar.

    Parameters
    ----------
    file : str
        As the user named it; empty where there is none.
    joints : dict of str to JointGives
        By the URDF's names.
    links : dict of str to LinkGives
        By the URDF's names.
    """

    file: str = ""
    joints: dict[str, JointGives] = field(default_factory=dict)
    links: dict[str, LinkGives] = field(default_factory=dict)
