"""Sweeps of the exact linearisation in space are Newton's: one is enough for any order, each squares what is wrong."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise
from types import ModuleType

import numpy as np
import pytest
from support.spatial.kernels import angles_of, package_of, stepped
from support.spatial.random_arms import random_arm
from support.spatial.yardsticks import cantilever

from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.verify.check_row import SLOPE
from tmm_gen.verify.spatial_order import fitted_order

STEP = 0.02
"""s, long: one sweep leaves much to do."""


@cache
def moving(kind: str) -> SpatialArm:
    """Return a tree, or a beam under its weight."""
    if kind == "beam":
        return replace(cantilever(2), gravity=(0.0, 0.0, -9.81), inputs=(), outputs=())
    return replace(random_arm(5, 4, tree=True, loads=False), outputs=())


@cache
def kernel(kind: str, method: str, sweeps: int, exact: bool) -> ModuleType:
    held = method != "newmark"
    choices = SpaceChoices(1e-3, iterations=sweeps, held=held, exact=exact)
    return package_of(moving(kind), method, choices)


@pytest.mark.parametrize(
    ("kind", "method", "order"), [("tree", "newmark", 2), ("beam", "newmark", 2), ("tree", "sdirk4", 4)]
)
def test_one_sweep_is_enough_for_the_order(kind: str, method: str, order: int) -> None:
    fitted, _ = fitted_order(moving(kind), kernel(kind, method, 1, exact=True))
    assert fitted == pytest.approx(order, abs=SLOPE)


def lacking(sweeps: int, exact: bool) -> float:
    """Return what the equations lack after a step of the tree, as accelerations of its joints."""
    arm = moving("tree")
    state = stepped(kernel("tree", "newmark", sweeps, exact), STEP, 1)[-1]
    world = WorldArm(arm)
    torque = world.inverse_dynamics(state.angle, state.rate, state.acceleration, {})
    return float(np.max(np.abs(np.linalg.solve(world.mass_matrix(state.angle), torque))))


def test_residual_falls_quadratically() -> None:
    """What is left behind a sweep is about the square of what was left before, with one factor for all."""
    first, second, third = (lacking(sweeps, exact=True) for sweeps in (1, 2, 3))
    factor = second / first**2
    assert second < 0.1 * first
    assert third < max(10.0 * factor * second**2, 1e-11)


def test_inertial_residual_falls_linearly() -> None:
    """Its corrections keep the factors of the first sweep: each takes off a share, and no square."""
    found = [lacking(sweeps, exact=False) for sweeps in (1, 2, 3, 4)]
    shares = [after / before for before, after in pairwise(found)]
    assert all(share < 0.5 for share in shares)
    assert shares[-1] > 1e-3


def test_both_go_to_the_same_step() -> None:
    inertial, exact = (
        angles_of(stepped(kernel("tree", "newmark", sweeps, exact), 0.002, 50))
        for sweeps, exact in ((10, False), (4, True))
    )
    assert np.max(np.abs(inertial - exact)) < 1e-10
    assert np.max(np.ptp(exact, axis=0)) > 0.1
