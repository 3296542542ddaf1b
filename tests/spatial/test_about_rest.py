"""Arms in space about rest, derived, against the reference's equations: other axes, other formulation."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from support.spatial.about_rest import stiffness
from support.spatial.mujoco_model import mjcf
from support.spatial.random_arms import random_arm

from tmm_gen.modal.space.matrices import space_matrices
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.still import Still
from tmm_gen.modal.space.sweep import inputs_of, swept
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene.spatial.arm import ArmOutput, SpatialArm

SEEDS = range(8)
ALIKE = 1e-12
"""Relative to the largest entry."""


def drawn(seed: int) -> Still:
    """Return a random arm at random angles under random inputs: what is derived holds wherever it is held."""
    arm, rng = random_arm(seed), np.random.default_rng(100 + seed)
    columns = [column for item in arm.inputs for column in item.columns]
    given = dict(zip(columns, rng.normal(size=len(columns)).tolist(), strict=True))
    return Still(ArmNumbers(arm), rng.uniform(-2.0, 2.0, len(arm.joints)), given)


def apart(found: np.ndarray, exact: np.ndarray) -> float:
    return float(np.max(np.abs(found - exact)) / np.max(np.abs(exact)))


@pytest.mark.parametrize("seed", SEEDS)
def test_matrices_and_balance(seed: int) -> None:
    still = drawn(seed)
    arm, q = still.numbers.arm, still.angles
    world, zero = WorldArm(arm), np.zeros_like(q)
    assert apart(still.mass, world.mass_matrix(q)) < ALIKE
    geometric = stiffness(arm, q, still.given) - np.diag(still.numbers.stiffness)
    assert apart(still.geometric, geometric) < ALIKE
    assert apart(-still.unbalanced, world.inverse_dynamics(q, zero, zero, still.given)) < ALIKE
    # torques are no larger than what they are said to be sums of
    assert np.all(np.abs(still.needed) <= still.acting * (1.0 + ALIKE))
    # rates have no first-order part but the dampers'
    by_v = world.tangents(q, zero, zero, still.given)[1]
    assert apart(space_matrices(still).damping, by_v) < ALIKE
    places = world.tree.places(q)
    for frame in arm.frames:
        assert apart(still.place(frame), places.frame(frame)[1]) < ALIKE


def exact_response(still: Still, s: complex) -> dict[str, np.ndarray]:
    """Return outputs for a unit of each input from the reference: its equations are linear in the inputs."""
    arm, q, n = still.numbers.arm, still.angles, still.numbers.size
    world, zero = WorldArm(arm), np.zeros(n)
    columns = [column for item in arm.inputs for column in item.columns]
    acting = np.array(
        [
            world.inverse_dynamics(q, zero, zero, {}) - world.inverse_dynamics(q, zero, zero, {c: 1.0})
            for c in columns
        ]
    ).T
    dynamic = (
        stiffness(arm, q, still.given) + s * np.diag(still.numbers.damping) + s**2 * world.mass_matrix(q)
    )
    moved = np.linalg.solve(dynamic, acting)
    small = 1e-4 / np.maximum(1.0, np.max(np.abs(moved), axis=0))  # of each input
    found = {}
    for part in ("real", "imag"):
        way, rate, pull = (getattr(s**order * moved, part) for order in range(3))
        ahead, behind = (
            outputs(
                arm,
                q + sign * (small * way).T,
                sign * (small * rate).T,
                sign * (small * pull).T,
                {
                    c: still.given.get(c, 0.0)
                    + sign * small * (np.eye(len(columns))[k] if part == "real" else 0.0)
                    for k, c in enumerate(columns)
                },
            )
            for sign in (1.0, -1.0)
        )
        for name, value in ahead.items():
            slope = (value - behind[name]) / (2.0 * small)
            found[name] = found.get(name, 0.0) + (slope if part == "real" else 1j * slope)
    return found


def read_all(arm: SpatialArm) -> SpatialArm:
    """Return an arm with every kind of output but energies."""
    more = (
        ArmOutput("rate", "rate", joint=2),
        ArmOutput("acceleration", "acceleration", joint=2),
        ArmOutput("other", "position", frame=arm.frames[1]),
    )
    kept = tuple(item for item in arm.outputs if item.quantity.read != "energy")
    return replace(arm, outputs=(*kept, *more))


@pytest.mark.parametrize("seed", SEEDS)
def test_responses(seed: int) -> None:
    held = drawn(seed)
    still = Still(ArmNumbers(read_all(held.numbers.arm)), held.angles, held.given)
    s = np.array([0.3 + 2.0j, 40.0j, -1.0 + 300.0j])
    found = space_response(still, s)
    for k, point in enumerate(s):
        exact = exact_response(still, complex(point))
        assert exact.keys() == found.keys()
        for name, values in exact.items():
            size = np.max(np.abs(values))
            assert np.max(np.abs(found[name][k] - values)) < 1e-6 * size, name


@pytest.mark.parametrize("seed", SEEDS)
def test_the_sweep_solves_the_matrices(seed: int) -> None:
    """To rounding, where the reference's outputs are differences."""
    still = drawn(seed)
    linear, inputs = space_matrices(still), inputs_of(still)
    s = np.array([1e-3j, 5.0j, 2.0 + 100.0j])
    found = swept(still, s, inputs).moved[:, 6:]  # its base stands still
    acting = inputs.torque + np.einsum("bij,bik->jk", still.moves, inputs.force)
    for k, point in enumerate(s):
        # the matrices' own stiffness is symmetric, and loads that turn with bodies are not
        springs = np.diag(still.numbers.stiffness) + still.geometric
        dynamic = springs + point * linear.damping + point**2 * still.mass
        residual = dynamic @ found[k] - acting
        sizes = np.abs(dynamic) @ np.abs(found[k]) + np.abs(acting)
        assert np.max(np.abs(residual) / np.max(sizes, axis=0)) < 1e-13


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_mujoco_has_the_same_matrices(seed: int) -> None:
    """Its mass matrix, and central differences of what weight takes."""
    arm = random_arm(seed, loads=False)
    still = Still(ArmNumbers(arm), np.linspace(-1.0, 1.0, len(arm.joints)), {})
    model = mujoco.MjModel.from_xml_string(mjcf(arm))
    data = mujoco.MjData(model)

    def taken(q: np.ndarray) -> np.ndarray:
        data.qpos[:], data.qvel[:] = q, 0.0
        mujoco.mj_forward(model, data)
        return np.array(data.qfrc_bias - data.qfrc_passive)

    taken(still.angles)
    rows = np.zeros((model.nv, model.nv))
    for row, one in zip(rows, np.eye(model.nv), strict=True):
        mujoco.mj_mulM(model, data, row, one)
    assert apart(still.mass, rows) < 1e-10
    small = 1e-4
    columns = [taken(still.angles + small * e) - taken(still.angles - small * e) for e in np.eye(model.nv)]
    exact = np.array(columns).T / (2.0 * small)
    assert apart(np.diag(still.numbers.stiffness) + still.geometric, exact) < 1e-7
