"""A uniform beam cut into rigid links with torsion springs between them.

Gholampour (2018), eqs. 2-1 and 2-2 and the alternatives to them.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.section import Uniform
from tmm_gen.scene.station import Joint, Link
from tmm_gen.scene.table import STATION_LIMIT, NonNegative, Positive, Table, fault

Springs = Literal["clamped-segment", "half-clamp", "uniform", "thesis"]
"""Rules for a beam whose root is held by a base, a hub or another part."""

CLAMPED: Springs = "clamped-segment"
"""The rule where none is written."""


def springs_at_a_held_root(value: object) -> object:
    """Refuse the rule that is for beams on a motor or a joint, and say where one has it."""
    if value == "finite-segment":
        raise fault(
            "needs a motor or a joint at the beam's inner end, and [beam] is clamped to the base or its hub",
            'Write `springs = "clamped-segment"`, or remove the key; a [[beam]] by name on a [[motor]] is cut so.',
        )
    return value


class BeamEntry(Uniform):
    """``[beam]`` as written: a uniform beam, clamped to the base or to the hub.

    Parameters
    ----------
    links : int
        n, number of rigid links.
    springs : {"clamped-segment", "half-clamp", "uniform", "thesis"}
        Where it is cut and how stiff the joints are, see :func:`beam_joints` and :func:`beam_links`.
    damping_time : float
        Stiffness-proportional damping, s, not negative: the damping of a joint is this times its stiffness.
    """

    links: Annotated[int, Field(strict=True, ge=1, le=STATION_LIMIT)] = Field(
        description="number of rigid links", examples=["10"]
    )
    springs: Annotated[Springs, BeforeValidator(springs_at_a_held_root)] = Field(
        default=CLAMPED, description="rule of the joint springs", examples=[f'"{CLAMPED}"']
    )
    damping_time: NonNegative = Field(
        default=0.0, description="damping of a joint over its stiffness in s", examples=["0.002"]
    )

    def expanded(self) -> Beam:
        """Return the beam this entry stands for, by its numbers."""
        return by_numbers(self, self.links, self.springs, self.damping_time)


class Beam(BeamEntry):
    """A uniform beam by its numbers: length L in m, EI in N m^2, mass per length in kg/m, all positive."""

    bending_stiffness: Positive
    mass_per_length: Positive
    springs: Springs = "half-clamp"  # once what files did not write, so that fingerprints leave it out


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


def by_numbers(written: Uniform, links: int, springs: Springs, damping_time: float) -> Beam:
    """Return a beam by its numbers, however a file has its stiffness and mass."""
    stiffness, mass = written.stiffness_and_mass()
    return Beam.model_construct(
        length=written.length,
        bending_stiffness=stiffness,
        mass_per_length=mass,
        links=links,
        springs=springs,
        damping_time=damping_time,
    )


def beam_joints(beam: Beam) -> tuple[Joint, ...]:
    """Return the joints of a beam, base to tip, length n.

    With pieces of length ``l`` and ``k = EI/l``, a spring between the middles of two pieces stands for a length ``l``
    of beam, hence ``k``; between clamp or hub and the middle of the first piece there is only ``l/2``, hence
    ``2 k``.

    - ``clamped-segment``: ``2 k`` for the first joint, ``k`` for the others, and half a piece behind the last one:
      ``l = L/(n - 1/2)``. To a beam a clamp is a plane of symmetry, and beyond the last cut lies what it stands for.
    - ``half-clamp``: the same with ``l = L/n`` and a whole piece at the end, half of which no spring stands for.
    - ``uniform``: ``k`` for all, ``l = L/n``.
    - ``thesis``: ``8/9 k``, then ``(48 n - 72)/(42 n - 71) k``, then ``k`` (eqs. 2-1, 2-2), ``l = L/n``. A single
      link has the first spring only, so the second formula, negative over negative there, is never used at n = 1;
      from n = 2 on it is positive.
    """
    return _joints(beam, _exact_stiffnesses(beam))


def beam_links(beam: Beam) -> tuple[Link, ...]:
    """Return the links of a beam, base to tip, length n: slender uniform rods of inertia ``m l^2/12``.

    All are alike but the last one of ``clamped-segment``, which is half as long as the others.
    """
    piece = _rod(beam, piece_length(beam))
    if beam.springs == "clamped-segment":
        return (*(piece,) * (beam.links - 1), _rod(beam, piece_length(beam) / 2))
    return (piece,) * beam.links


def piece_length(beam: Beam) -> Fraction:
    """Return the length of a whole piece, m: errors of a cut beam go by it."""
    pieces = beam.links - Fraction(1, 2) if beam.springs == "clamped-segment" else beam.links
    return exact(beam.length) / pieces


def finite_segments(beam: Beam) -> tuple[tuple[Joint, ...], tuple[Link, ...]]:
    """Return a beam whose root turns, cut in the middle of ``n`` equal pieces, whatever its own rule.

    Returns
    -------
    tuple of Joint, length n
        ``k`` each.
    tuple of Link, length n + 1
        Half a piece, which is fixed to what turns the root; whole ones; half a piece.
    """
    length = exact(beam.length) / beam.links
    k = exact(beam.bending_stiffness) / length
    half, whole = _rod(beam, length / 2), _rod(beam, length)
    return _joints(beam, (k,) * beam.links), (half, *(whole,) * (beam.links - 1), half)


def _joints(beam: Beam, stiffnesses: Sequence[Fraction]) -> tuple[Joint, ...]:
    time = exact(beam.damping_time)
    return tuple(Joint.model_construct(stiffness=nearest(k), damping=nearest(time * k)) for k in stiffnesses)


def _rod(beam: Beam, length: Fraction) -> Link:
    mass = exact(beam.mass_per_length) * length
    return Link.model_construct(
        inertia=nearest(mass * length**2 / 12),
        mass=nearest(mass),
        length=nearest(length),
        center=0.5,
    )


def _exact_stiffnesses(beam: Beam) -> tuple[Fraction, ...]:
    n, k = beam.links, exact(beam.bending_stiffness) / piece_length(beam)
    if beam.springs == "uniform":
        return (k,) * n
    if beam.springs != "thesis":
        return (2 * k,) + (k,) * (n - 1)
    second = Fraction(48 * n - 72, 42 * n - 71) * k
    return (Fraction(8, 9) * k, second, *(k,) * (n - 2))[:n]
