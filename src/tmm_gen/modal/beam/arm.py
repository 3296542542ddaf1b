"""An arm of continuous beams: base, beams in a row, bodies and joints between them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.beam.member import Member
from tmm_gen.modal.beam.stiffness import dynamic_stiffness
from tmm_gen.scene import Scene

Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class BeamBase:
    """What the first beam stands on.

    Parameters
    ----------
    kind : {"clamp", "hub"}
        Ground; or a hub that turns about a fixed point, pinned where its inertia is zero.
    inertia : float
        Of the hub, kg m^2.
    damping, stiffness : float
        From hub to ground, N m s/rad and N m/rad.
    """

    kind: Literal["clamp", "hub"] = "clamp"
    inertia: float = 0.0
    damping: float = 0.0
    stiffness: float = 0.0

    @property
    def turns(self) -> bool:
        """Whether there is a hub."""
        return self.kind == "hub"


@dataclass(frozen=True)
class Body:
    """What sits at the outboard end of a beam.

    Parameters
    ----------
    mass, inertia : float
        Rigid, kg and kg m^2.
    joint_stiffness, joint_damping : float or None, float
        Torsion spring (N m/rad) and damper (N m s/rad) between this body and the next beam; None where they
        are one piece.
    """

    mass: float = 0.0
    inertia: float = 0.0
    joint_stiffness: float | None = None
    joint_damping: float = 0.0


@dataclass(frozen=True)
class BeamArm:
    """Beams in a row, in small motion across a straight line.

    Parameters
    ----------
    members : tuple of Member
        Base to tip.
    base : BeamBase
        Inboard end.
    bodies : tuple of Body
        One at the outboard end of each member; empty for none.

    Raises
    ------
    ValueError
        If there is no member, or not one body for each.
    """

    members: tuple[Member, ...]
    base: BeamBase = field(default_factory=BeamBase)
    bodies: tuple[Body, ...] = ()

    def __post_init__(self) -> None:
        """Complete the bodies."""
        if not self.members:
            raise ValueError("an arm needs at least one beam")
        if not self.bodies:
            object.__setattr__(self, "bodies", (Body(),) * len(self.members))
        if len(self.bodies) != len(self.members):
            raise ValueError(
                f"{len(self.bodies)} bodies for {len(self.members)} beams: one at each outboard end"
            )

    @property
    def ends(self) -> tuple[tuple[tuple[int, int], tuple[int, int]], ...]:
        """Numbers of the coordinates ``(w, psi)`` at both ends of each member; -1 where it is held."""
        inboard = (-1, 0 if self.base.turns else -1)
        count = inboard[1] + 1
        found = []
        for body in self.bodies:
            outboard = (count, count + 1)
            found.append((inboard, outboard))
            count += 2
            inboard = outboard
            if body.joint_stiffness is not None:  # the next beam has its own angle
                inboard = (outboard[0], count)
                count += 1
        return tuple(found)

    @property
    def coordinates(self) -> int:
        """Number of coordinates."""
        return self.ends[-1][1][1] + 1

    def undamped(self) -> BeamArm:
        """Return the same arm without damping."""
        base = BeamBase(self.base.kind, self.base.inertia, 0.0, self.base.stiffness)
        bodies = tuple(Body(b.mass, b.inertia, b.joint_stiffness) for b in self.bodies)
        return BeamArm(tuple(m.undamped() for m in self.members), base, bodies)

    def stiffness(self, s: ArrayLike) -> Complex:
        """Return the dynamic stiffness of the free coordinates, (f, coordinates, coordinates).

        Parameters
        ----------
        s : array_like, (f,)
            Laplace variable, 1/s.
        """
        points = np.atleast_1d(np.asarray(s, complex))
        size = self.coordinates
        total = np.zeros((len(points), size + 1, size + 1), complex)  # the last one collects what is held
        known: dict[Member, Complex] = {}
        for member, body, (inboard, outboard) in zip(self.members, self.bodies, self.ends, strict=True):
            if member not in known:
                known[member] = dynamic_stiffness(member, points)
            places = np.array([*inboard, *outboard])
            total[:, places[:, None], places[None, :]] += known[member]
            total[:, outboard[0], outboard[0]] += body.mass * points**2
            total[:, outboard[1], outboard[1]] += body.inertia * points**2
            if body.joint_stiffness is not None and outboard[1] + 1 < size:
                spring = body.joint_stiffness + body.joint_damping * points
                for one, other, sign in ((0, 0, 1), (1, 1, 1), (0, 1, -1), (1, 0, -1)):
                    total[:, outboard[1] + one, outboard[1] + other] += sign * spring
        if self.base.turns:
            total[:, 0, 0] += self.base.inertia * points**2 + self.base.damping * points + self.base.stiffness
        return total[:, :size, :size]


def beam_arm(scene: Scene) -> BeamArm:
    """Return the continuous arm that a scene's ``[beam]`` stands for: straight, weightless, in small motion.

    A prescribed base is held.

    Raises
    ------
    ValueError
        If the scene has no beam.
    """
    beam = scene.beam
    if beam is None:
        raise ValueError(f"scene '{scene.name}' has no [beam]")
    member = Member(beam.length, beam.bending_stiffness, beam.mass_per_length, damping_time=beam.damping_time)
    base = BeamBase("hub", scene.base.inertia, scene.base.damping) if scene.hub else BeamBase()
    tip = Body(scene.tip.mass, scene.tip.inertia) if scene.tip else Body()
    return BeamArm((member,), base, (tip,))
