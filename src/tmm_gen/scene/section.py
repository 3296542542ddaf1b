"""What beams are made of: bending stiffness and mass per length, or the material and section they follow from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Literal

from pydantic import Field, JsonValue

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.table import Positive, Table

Shape = Literal["rectangle", "tube", "circle"]

MEASURES: Mapping[Shape, tuple[str, ...]] = {
    "rectangle": ("width", "thickness"),
    "tube": ("diameter", "thickness"),
    "circle": ("diameter",),
}
"""What each section has; other measures do not go with it."""

NUMBERS, STUFF = ("bending_stiffness", "mass_per_length"), ("material", "section")
"""The two ways to say how a beam bends and weighs; one of them, and whole."""

_OTHERS: dict[str, JsonValue] = {"absent": "other shapes"}


class Material(Table):
    """``material``: what a beam is made of.

    Parameters
    ----------
    young, shear : float
        Moduli, Pa, positive. Motion in a plane has no use for the second, which is None where the file has none.
    density : float
        kg/m^3, positive.
    """

    young: Positive = Field(description="Young's modulus in Pa", examples=["70e9"])
    density: Positive = Field(description="density in kg/m^3", examples=["2700"])
    shear: Positive | None = Field(
        default=None,
        description="shear modulus in Pa, of which motion in a plane takes no notice",
        examples=["26e9"],
    )


class Section(Table):
    """``section``: the cross-section of a beam, symmetric about the plane of motion.

    Parameters
    ----------
    kind : {"rectangle", "tube", "circle"}
        Its shape.
    thickness : float or None
        Of a rectangle, in the plane of motion, so that it bends about its thin side; of a tube, that of its wall, m.
    width : float or None
        Of a rectangle, across the plane of motion, m.
    diameter : float or None
        Outer one, m.
    """

    kind: Shape = Field(description="shape of the section", examples=['"rectangle"'])
    width: Positive | None = Field(
        default=None,
        description="of a rectangle, across the plane of motion, in m",
        examples=["0.03"],
        json_schema_extra=_OTHERS,
    )
    thickness: Positive | None = Field(
        default=None,
        description="of a rectangle in the plane of motion, of a tube that of its wall, in m",
        examples=["0.002"],
        json_schema_extra=_OTHERS,
    )
    diameter: Positive | None = Field(
        default=None,
        description="of a circle or tube, the outer one, in m",
        examples=["0.02"],
        json_schema_extra=_OTHERS,
    )

    @property
    def area(self) -> Fraction:
        """Area, m^2; of a section that has its measures."""
        return self._moments()[0]

    @property
    def second_moment(self) -> Fraction:
        """Second moment of area about the axis that the arm bends about, m^4."""
        return self._moments()[1]

    def _moments(self) -> tuple[Fraction, Fraction]:
        width, thickness, outer = (exact(v or 0.0) for v in (self.width, self.thickness, self.diameter))
        if self.kind == "rectangle":
            return width * thickness, width * thickness**3 / 12
        inner = outer - 2 * thickness if self.kind == "tube" else Fraction(0)
        pi = exact(math.pi)
        return pi / 4 * (outer**2 - inner**2), pi / 64 * (outer**4 - inner**4)


class Uniform(Table):
    """What all uniform beams have: a length, and either both numbers or both material and section."""

    length: Positive = Field(description="length of the beam in m", examples=["1.0"])
    bending_stiffness: Positive | None = Field(
        default=None,
        description="EI in N m^2",
        examples=["3.2"],
        json_schema_extra={"absent": "from material and section"},
    )
    mass_per_length: Positive | None = Field(
        default=None,
        description="mass per length in kg/m",
        examples=["0.5"],
        json_schema_extra={"absent": "from material and section"},
    )
    material: Material | None = Field(
        default=None, description="what it is made of", examples=["{ young = 70e9, density = 2700 }"]
    )
    section: Section | None = Field(
        default=None,
        description="its cross-section",
        examples=['{ kind = "rectangle", width = 0.03, thickness = 0.002 }'],
    )

    def stiffness_and_mass(self) -> tuple[float, float]:
        """Return EI, N m^2, and mass per length, kg/m, as given or as they follow from material and section."""
        if self.bending_stiffness is not None and self.mass_per_length is not None:
            return self.bending_stiffness, self.mass_per_length
        assert self.material is not None  # rules/beams.py sees to both
        assert self.section is not None
        bending = exact(self.material.young) * self.section.second_moment
        return nearest(bending), nearest(exact(self.material.density) * self.section.area)

    def key_of(self, number: str) -> str:
        """Return the key that one of the two numbers comes from."""
        return number if getattr(self, number) is not None else "section"
