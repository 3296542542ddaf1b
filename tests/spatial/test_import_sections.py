"""Cross-sections of flexible links against integrals over their areas."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tmm_gen.urdf.cross_section import cross_section


@pytest.mark.parametrize("sides", [(1.0, 1.0), (0.02, 0.015), (0.004, 0.03), (1.0, 0.01)])
def test_torsion_of_a_rectangle_by_another_series(sides: tuple[float, float]) -> None:
    # Prandtl's stress function in a double series of sines: nothing of Saint-Venant's single one is used
    width, thickness = sides
    n = np.arange(1, 4001, 2)[:, None]
    m = n.T
    series = np.sum(1.0 / (m**2 * n**2 * ((m / width) ** 2 + (n / thickness) ** 2)))
    double = 256.0 / math.pi**6 * width * thickness * float(series)
    assert cross_section("rectangle", sides).torsion == pytest.approx(double, rel=2e-5)


def test_areas_and_moments_by_small_squares() -> None:
    fine = (np.arange(2000) + 0.5) / 2000 - 0.5
    y, z = np.meshgrid(fine * 0.05, fine * 0.05, indexing="ij")
    cell = (0.05 / 2000) ** 2
    inside = {
        ("rectangle", (0.04, 0.02)): (abs(y) < 0.02) & (abs(z) < 0.01),
        ("circle", (0.04,)): np.hypot(y, z) < 0.02,
        ("tube", (0.04, 0.03)): (np.hypot(y, z) < 0.02) & (np.hypot(y, z) > 0.015),
    }
    for (kind, measures), there in inside.items():
        section = cross_section(kind, measures)
        assert section.area == pytest.approx(np.sum(there) * cell, rel=1e-3)
        assert section.second_y == pytest.approx(np.sum(there * z**2) * cell, rel=1e-3)
        assert section.second_z == pytest.approx(np.sum(there * y**2) * cell, rel=1e-3)
        if kind != "rectangle":  # round ones do not warp
            assert section.torsion == pytest.approx(np.sum(there * (y**2 + z**2)) * cell, rel=1e-3)
