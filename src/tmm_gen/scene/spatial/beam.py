"""Beams in space: what they are per length, and the cells they are cut into.

A cell is half a piece, joints, half a piece; the joints of a cell stand at one point. Their order alternates from cell
to cell: turns about different axes do not commute, and in a fixed order what that leaves adds up along the beam.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import cycle, islice
from typing import Literal, NamedTuple, cast

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.section import Section
from tmm_gen.scene.spatial.geometry import Axis
from tmm_gen.scene.spatial.mass import Weight, rod
from tmm_gen.scene.spatial.tables import SpatialBeam

Way = Literal["bend_y", "bend_z", "twist"]
AXIS_OF: dict[Way, Axis] = {"twist": 0, "bend_y": 1, "bend_z": 2}

_NAME = re.compile(r"(.+)_(\d+)_(bend_y|bend_z|twist)")

_ORDERS: tuple[tuple[Way, ...], tuple[Way, ...]] = (
    ("bend_y", "bend_z", "twist"),
    ("twist", "bend_z", "bend_y"),
)


class CellName(NamedTuple):
    """What the name of a joint in a beam says: which beam, its cell counted from 1, and how it gives way."""

    beam: str
    number: int
    way: Way

    def __str__(self) -> str:
        """Return the name."""
        return f"{self.beam}_{self.number}_{self.way}"

    @classmethod
    def of(cls, joint: str) -> CellName | None:
        """Read the name of a joint; None where it is none of a beam's."""
        found = _NAME.fullmatch(joint)
        return cls(found[1], int(found[2]), cast("Way", found[3])) if found else None


@dataclass(frozen=True)
class PerLength:
    """A uniform beam per length.

    Parameters
    ----------
    bending : tuple of Fraction, length 2
        EI about its y and z axes, N m^2.
    twisting : Fraction or None
        GJ, N m^2; None where it does not twist.
    mass : Fraction
        kg/m.
    polar : Fraction
        kg m.
    """

    bending: tuple[Fraction, Fraction]
    twisting: Fraction | None
    mass: Fraction
    polar: Fraction


def per_length(beam: SpatialBeam) -> PerLength:
    """Return the numbers of a beam, as given or as they follow from material and section."""
    if beam.material is None or beam.section is None:
        assert beam.bending_stiffness is not None  # rules/beams.py sees to it
        assert beam.mass_per_length is not None
        y, z = map(exact, beam.bending_stiffness)
        twisting = beam.torsional_stiffness
        return PerLength(
            (y, z),
            None if twisting is None else exact(twisting),
            exact(beam.mass_per_length),
            exact(beam.polar_inertia_per_length or 0.0),
        )
    young, density, (y, z) = (
        exact(beam.material.young),
        exact(beam.material.density),
        second_moments(beam.section),
    )
    shear = beam.material.shear
    return PerLength(
        (young * y, young * z),
        None if shear is None else exact(shear) * torsion_constant(beam.section),
        density * beam.section.area,
        density * (y + z),
    )


def second_moments(section: Section) -> tuple[Fraction, Fraction]:
    """Return the second moments of area about y and z, m^4: a rectangle's width is along y, its thickness along z."""
    about_y = section.second_moment
    if section.kind != "rectangle":
        return about_y, about_y
    return about_y, exact(section.thickness or 0.0) * exact(section.width or 0.0) ** 3 / 12


def torsion_constant(section: Section) -> Fraction:
    """Return J of GJ, m^4: the polar moment of round sections, Saint-Venant's series for rectangles."""
    if section.kind != "rectangle":
        return 2 * section.second_moment
    short, long = sorted((section.width or 0.0, section.thickness or 0.0))
    slender = math.pi / 2 * (long / short)
    series = sum(math.tanh(n * slender) / n**5 for n in range(1, 100, 2))
    return exact(short) ** 3 * exact(long) / 3 * exact(1.0 - 192.0 / math.pi**5 * (short / long) * series)


@dataclass(frozen=True)
class CellJoint:
    """A joint of a cell.

    Parameters
    ----------
    name : str
        After the beam's name, its number and the way it gives way.
    axis : {0, 1, 2}
        Of the beam.
    stiffness, damping : float
        N m/rad, N m s/rad.
    """

    name: str
    axis: Axis
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Cells:
    """A beam cut into cells.

    Parameters
    ----------
    joints : tuple of tuple of CellJoint
        Of each cell, inner to outer, all at one point.
    half, whole : Weight
        Half a piece and a whole one, from their inner ends.
    piece : Fraction
        Length of a whole piece, m.
    """

    joints: tuple[tuple[CellJoint, ...], ...]
    half: Weight
    whole: Weight
    piece: Fraction


def cells(beam: SpatialBeam) -> Cells:
    """Cut a beam into cells."""
    numbers, n = per_length(beam), beam.links
    piece = exact(beam.length) / n
    half, whole = (rod(numbers.mass * at, at, numbers.polar * at) for at in (piece / 2, piece))
    return Cells(tuple(_cells(beam, numbers, piece)), half, whole, piece)


def _cells(beam: SpatialBeam, numbers: PerLength, piece: Fraction) -> Iterator[tuple[CellJoint, ...]]:
    along = {
        "bend_y": numbers.bending[0] / piece,
        "bend_z": numbers.bending[1] / piece,
        "twist": None if numbers.twisting is None else numbers.twisting / piece,
    }
    time = exact(beam.damping_time)
    for number, order in enumerate(islice(cycle(_ORDERS), beam.links), start=1):
        yield tuple(
            CellJoint(str(CellName(beam.name, number, way)), AXIS_OF[way], nearest(k), nearest(time * k))
            for way in order
            if (k := along[way]) is not None
        )
