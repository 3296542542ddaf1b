"""Generated kernels where arms in space are hard to solve: bent and twisted far, near buckling, spun fast."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support.spatial.about_rest import stiffness
from support.spatial.beams import Beam, End, add_beam, add_body
from support.spatial.kernels import angles_of, package_of, stepped
from support.spatial.yardsticks import STRIP, strip, strip_force, strip_tip

from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.scene.spatial.arm import Revolute, RigidBody, SpatialArm

LOAD = 8.896
"""N."""
SOFT = Beam(1.0, (2.0, 2.0), 1.5, 0.2, 2e-4, decay=5e-3)
BUCKLING = np.pi**2 * SOFT.bending[0] / (4.0 * SOFT.length**2)
"""Of a standing column under a load on its tip, N."""
WEIGHT = 9.81


@cache
def rested(cells: int, degrees: float) -> np.ndarray:
    """Return where a heavily damped strip's tip comes to rest under a dead load, (3,), m."""
    arm = strip(cells)
    damped = replace(arm, joints=tuple(replace(j, damping=0.02 * j.stiffness) for j in arm.joints))
    module = package_of(damped, "generalized_alpha", SpaceChoices(1e-3, iterations=3))
    force = strip_force(LOAD, degrees)
    last = stepped(module, 4e-3, 150, lambda _: force)[-1]
    assert np.max(np.abs(last.rate)) < 1e-4
    found = module.output(module.prepare(step=4e-3), last)
    return np.array([found.tip_x, found.tip_y, found.tip_z])


@pytest.mark.parametrize("degrees", [45.0, 75.0])
def test_strip_comes_to_rest_as_a_kirchhoff_rod(degrees: float) -> None:
    exact = strip_tip(LOAD, degrees)
    coarse, fine = (float(np.linalg.norm(rested(cells, degrees) - exact)) for cells in (3, 6))
    assert np.linalg.norm(exact - [STRIP.length, 0.0, 0.0]) > 0.1
    assert np.log2(coarse / fine) == pytest.approx(2.0, abs=0.1)


def column(share: float = 0.85) -> SpatialArm:
    """Return a beam along x with gravity along -x, a weight of a share of its buckling load on its tip, let go bent."""
    joints: list[Revolute] = []
    end = add_beam(joints, SOFT, 4)
    mass = share * BUCKLING / WEIGHT - 0.3 * SOFT.mass * SOFT.length  # its own weight presses too
    add_body(joints, end, RigidBody(mass, (0.0, 0.0, 0.0), (1e-4, 2e-4, 2e-4, 0.0, 0.0, 0.0)))
    bent = tuple(replace(joint, angle=0.02) for joint in joints)
    return SpatialArm(bent, gravity=(-WEIGHT, 0.0, 0.0))


def spun() -> SpatialArm:
    """Return a soft beam with a heavy end on a hub that turns at 10 rad/s."""
    joints = [
        Revolute("hub", 0, axis=2, body=RigidBody(1.0, (0.0, 0.0, 0.0), (0.1, 0.1, 0.1, 0.0, 0.0, 0.0)))
    ]
    end = add_beam(joints, SOFT, 4, End(1))
    add_body(joints, end, RigidBody(0.5, (0.0, 0.0, 0.0), (1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0)))
    joints[0] = replace(joints[0], rate=10.0)
    return SpatialArm(tuple(joints), gravity=(0.0, 0.0, -WEIGHT))


ARMS = {"column": column, "spin": spun}


@cache
def errors(kind: str) -> tuple[list[float], float]:
    """Return the largest errors of joints' angles at two steps, 1 ms and half of that, and how far joints turn."""
    arm, until = ARMS[kind](), 0.1
    times = np.linspace(0.0, until, 11)
    exact = motion(arm, {}, times)[0]
    module = package_of(arm, "newmark", SpaceChoices(1e-3, iterations=3))
    found = []
    for step in (1e-3, 5e-4):
        steps = round(until / step)
        mine = angles_of(stepped(module, step, steps))[:: steps // 10]
        found.append(float(np.max(np.abs(mine - exact))))
    return found, float(np.max(np.ptp(exact, axis=0)))


@pytest.mark.parametrize("kind", ARMS)
def test_small_steps_go_to_the_reference(kind: str) -> None:
    (coarse, fine), moved = errors(kind)
    assert np.log2(coarse / fine) == pytest.approx(2.0, abs=0.2), (coarse, fine)
    assert coarse < 0.02 * moved


def test_column_is_near_buckling() -> None:
    """Upright it still holds, with little stiffness left; a fifth more weight and it does not."""
    upright = np.zeros(len(column().joints))
    least = [np.linalg.eigvalsh(stiffness(column(share), upright))[0] for share in (0.0, 0.85, 1.1)]
    assert 0.0 < least[1] < 0.25 * least[0]
    assert least[2] < 0.0
