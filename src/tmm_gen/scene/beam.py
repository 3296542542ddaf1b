"""A uniform beam cut into equal rigid links with torsion springs between them.

Gholampour (2018), eqs. 2-1 and 2-2 and the alternatives to them.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Literal

from pydantic import Field

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.station import Joint, Link
from tmm_gen.scene.table import STATION_LIMIT, NonNegative, Positive, Table

Springs = Literal["half-clamp", "uniform", "thesis"]


class BeamEntry(Uniform):
    """``[beam]`` as written: a uniform beam, clamped to the base or to the hub.

    Parameters
    ----------
    links : int
        n, number of rigid links, each of length L/n.
    springs : {"half-clamp", "uniform", "thesis"}
        Rule of the joint stiffnesses, see :func:`joint_stiffnesses`.
    damping_time : float
        Stiffness-proportional damping, s, not negative: the damping of a joint is this times its stiffness.
    """

    links: Annotated[int, Field(strict=True, ge=1, le=STATION_LIMIT)] = Field(
        description="number of rigid links", examples=["10"]
    )
    springs: Springs = Field(
        default="half-clamp", description="rule of the joint springs", examples=['"half-clamp"']
    )
    damping_time: NonNegative = Field(
        default=0.0, description="damping of a joint over its stiffness in s", examples=["0.002"]
    )

    def expanded(self) -> Beam:
        """Return the beam this entry stands for, by its numbers."""
        stiffness, mass = self.stiffness_and_mass()
        return Beam.model_construct(
            length=self.length,
            bending_stiffness=stiffness,
            mass_per_length=mass,
            links=self.links,
            springs=self.springs,
            damping_time=self.damping_time,
        )


class Beam(BeamEntry):
    """A uniform beam by its numbers: length L in m, EI in N m^2, mass per length in kg/m, all positive."""

    bending_stiffness: Positive
    mass_per_length: Positive


class Tip(Table):
    """``[tip]``: a rigid body at the outer end of the last link.

    Parameters
    ----------
    mass : float
        kg, not negative.
    inertia : float
        About its own centre, kg m^2, not negative.
    """

    mass: NonNegative = Field(default=0.0, description="mass at the tip in kg", examples=["0.1"])
    inertia: NonNegative = Field(
        default=0.0, description="moment of inertia at the tip in kg m^2", examples=["0.0"]
    )


def joint_stiffnesses(beam: Beam) -> tuple[float, ...]:
    """Return the torsional stiffness of each joint, base to tip.

    With ``l = L/n`` and ``k = EI/l``, a spring between the middles of two links stands for a length ``l`` of
    beam, hence ``k``; between clamp or hub and the middle of the first link there is only ``l/2``, hence
    ``2 k``.

    - ``half-clamp``: ``2 k`` for the first joint, ``k`` for the others.
    - ``uniform``: ``k`` for all.
    - ``thesis``: ``8/9 k``, then ``(48 n - 72)/(42 n - 71) k``, then ``k`` (eqs. 2-1, 2-2). A single link has
      the first spring only, so the second formula, negative over negative there, is never used at n = 1;
      from n = 2 on it is positive.

    Parameters
    ----------
    beam : Beam
        The beam.

    Returns
    -------
    tuple of float, length n
        N m/rad.
    """
    return tuple(map(nearest, _exact_stiffnesses(beam)))


def beam_joints(beam: Beam) -> tuple[Joint, ...]:
    """Return the joints of a beam, base to tip, length n; see :func:`joint_stiffnesses`."""
    time = exact(beam.damping_time)
    return tuple(
        Joint.model_construct(stiffness=nearest(k), damping=nearest(time * k))
        for k in _exact_stiffnesses(beam)
    )


def beam_links(beam: Beam) -> tuple[Link, ...]:
    """Return the links of a beam, base to tip, length n: slender uniform rods of inertia ``m l^2/12``."""
    length = exact(beam.length) / beam.links
    mass = exact(beam.mass_per_length) * length
    link = Link.model_construct(
        inertia=nearest(mass * length**2 / 12),
        mass=nearest(mass),
        length=nearest(length),
        center=0.5,
    )
    return (link,) * beam.links


def _exact_stiffnesses(beam: Beam) -> tuple[Fraction, ...]:
    n = beam.links
    k = exact(beam.bending_stiffness) * n / exact(beam.length)
    if beam.springs == "uniform":
        return (k,) * n
    if beam.springs == "half-clamp":
        return (2 * k,) + (k,) * (n - 1)
    second = Fraction(48 * n - 72, 42 * n - 71) * k
    return (Fraction(8, 9) * k, second, *(k,) * (n - 2))[:n]
