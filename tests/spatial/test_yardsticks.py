"""The model of beams in space, cells with three springs, against continuous beams: right in the limit, of order two."""

from __future__ import annotations

import numpy as np
import pytest
from support.spatial.about_rest import equilibrium, frequencies
from support.spatial.yardsticks import (
    STRIP,
    Top,
    cantilever,
    cantilever_frequencies,
    frame,
    frame_frequencies,
    strip,
    strip_force,
    strip_tip,
)

from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_reference import spatial_response
from tmm_gen.scene.spatial.arm import SpatialArm

CELLS = (5, 10, 20)
KNOWN = {"bend_y": (4.972396, 31.161477), "bend_z": (7.862049, 49.270621), "twist_x": (99.345883,)}
"""rad/s, computed once by others: what `yardsticks` derives is to meet them."""


def slopes(errors: list[float]) -> np.ndarray:
    """Return the orders between neighbours."""
    return np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))


def nearest(arm: SpatialArm, exact: float) -> float:
    found = frequencies(arm)
    return float(found[np.argmin(np.abs(found - exact))])


@pytest.mark.parametrize("motion", ["bend_y", "bend_z", "twist_x"])
@pytest.mark.parametrize("number", [0, 1])
def test_cantilever(motion: str, number: int) -> None:
    exact = cantilever_frequencies()[motion][number]
    assert exact == pytest.approx((*KNOWN[motion], exact)[number], abs=1e-6)
    errors = [nearest(cantilever(cells), exact) / exact - 1.0 for cells in CELLS]
    assert np.all(np.abs(slopes(errors) - 2.0) < 0.1), errors
    assert abs(errors[-1]) < 3e-3


def test_frame() -> None:
    out_of, within = frame_frequencies()
    assert out_of == pytest.approx((8.782449, 24.272129), abs=1e-6)
    assert within == pytest.approx((9.374245, 25.527405), abs=1e-6)
    for exact in (*out_of, *within):
        errors = [nearest(frame(cells), exact) / exact - 1.0 for cells in CELLS]
        assert np.all(np.abs(slopes(errors) - 2.0) < 0.1), errors


@pytest.mark.parametrize(
    ("load", "degrees", "known"),
    [
        (8.896, 45.0, (-0.01438876, 0.10903812, 0.00888513)),
        (8.896, 75.0, (-0.02458311, 0.14221013, 0.00356748)),
        (13.345, 45.0, (-0.03035991, 0.15658288, 0.01533638)),
    ],
)
def test_kirchhoff_rod(load: float, degrees: float, known: tuple[float, float, float]) -> None:
    exact = strip_tip(load, degrees)
    axial, soft, stiff = known
    assert exact - [STRIP.length, 0.0, 0.0] == pytest.approx([axial, stiff, soft], abs=5e-8)
    errors = [float(np.linalg.norm(tip(strip(cells), load, degrees) - exact)) for cells in CELLS]
    assert np.all(np.abs(slopes(errors) - 2.0) < 0.1), errors


def test_fixed_order_of_joints_has_order_one() -> None:
    """Why the order of a cell's joints alternates."""
    exact = strip_tip(8.896, 45.0)
    errors = [
        float(np.linalg.norm(tip(strip(cells, alternate=False), 8.896, 45.0) - exact)) for cells in CELLS
    ]
    assert np.all(slopes(errors) < 1.4), errors


def tip(arm: SpatialArm, load: float, degrees: float) -> np.ndarray:
    """Return the tip's place under a dead load."""
    world, force = WorldArm(arm), strip_force(load, degrees)
    q = np.zeros(len(arm.joints))
    for share in (0.25, 0.5, 0.75, 1.0):
        q = equilibrium(arm, {name: share * value for name, value in force.items()}, q)
    return np.asarray(world.tree.places(q).frame(arm.frames[0])[1])


def test_heavy_top() -> None:
    top = Top()
    assert top.rates == pytest.approx((4.9605443797, 0.0, 245.6467127549), abs=1e-9)
    q, v = np.array([0.0, top.tilt, 0.0]), np.array(top.rates)
    lacking = WorldArm(top.arm).inverse_dynamics(q, v, 0.0 * q, {})
    assert np.max(np.abs(lacking)) < 1e-14 * top.along * top.spin**2
    found = spatial_response(top.arm, {}, np.linspace(0.0, 0.5, 6))
    for name, rate in zip(("precess_rate", "tilt_rate", "spin_rate"), top.rates, strict=True):
        assert np.max(np.abs(found[name] - rate)) < 1e-9 * top.spin
