"""Cross-sections of flexible links: area, moments of area about both axes, and the constant of torsion."""

from __future__ import annotations

import math
from dataclasses import dataclass

MEASURES = {
    "tube": ("outer", "inner"),
    "circle": ("diameter",),
    "rectangle": ("width", "thickness"),
}
"""By shape: its measures, m; a rectangle's width is along y of the beam, its thickness along z."""


@dataclass(frozen=True)
class CrossSection:
    """What a section does to a beam along x.

    Parameters
    ----------
    area : float
        m^2.
    second_y, second_z : float
        Second moments of area about y and about z, m^4.
    torsion : float
        Saint-Venant's constant of torsion, m^4.
    """

    area: float
    second_y: float
    second_z: float
    torsion: float


def cross_section(kind: str, measures: tuple[float, ...]) -> CrossSection:
    """Return the section of a shape.

    Parameters
    ----------
    kind : str
        One of `MEASURES`.
    measures : tuple of float
        In the order of `MEASURES`, m; a tube's inner diameter below its outer one.
    """
    if kind == "rectangle":
        width, thickness = measures
        area = width * thickness
        return CrossSection(
            area, area * thickness**2 / 12.0, area * width**2 / 12.0, _rectangle_torsion(width, thickness)
        )
    outer, inner = (measures[0], measures[1] if kind == "tube" else 0.0)
    area = math.pi / 4.0 * (outer**2 - inner**2)
    second = area * (outer**2 + inner**2) / 16.0
    return CrossSection(area, second, second, 2.0 * second)


def _rectangle_torsion(width: float, thickness: float) -> float:
    """Return the constant of torsion of a rectangle by Saint-Venant's series, m^4."""
    long, short = max(width, thickness), min(width, thickness)
    ends = sum(
        math.tanh(n * math.pi * long / (2.0 * short)) / n**5 for n in range(1, 400, 2)
    )  # the terms beyond are below rounding
    return long * short**3 / 3.0 * (1.0 - 192.0 / math.pi**5 * short / long * ends)
