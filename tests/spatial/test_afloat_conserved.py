"""What nothing pushes keeps its momentum and its energy, to the order of the integrator; what is symmetric stays so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.spatial.afloat import coordinates, random_afloat, tumbling
from support.spatial.beams import Beam, add_beam
from support.spatial.kernels import package_of, stepped
from support.spatial.random_arms import undamped

from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.reference.spatial_afloat import AfloatArm, joint_mass
from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import FreeBase, Revolute, RigidBody, SpatialArm

SATELLITE = Path(__file__).parents[2] / "examples" / "space" / "satellite.toml"
METHODS = {
    "newmark": (SpaceChoices(1e-3, iterations=3), 2),
    "sdirk4": (SpaceChoices(1e-3, iterations=3, held=True), 4),
    "radau3": (SpaceChoices(1e-3, iterations=3), 5),
}


@pytest.mark.parametrize(("name", "step"), [("newmark", 0.02), ("sdirk4", 0.04), ("radau3", 0.08)])
def test_dzhanibekov(name: str, step: float) -> None:
    """A body turns about its middle axis, flips and flips back; its momentum stands, and its energy stays.

    It starts along the middle axis, a little off, so that by symmetry of the three moments it flips.
    """
    arm = tumbling((0.05, 2.0, 0.05))
    world, (choices, order) = AfloatArm(arm), METHODS[name]
    module = package_of(arm, name, choices)
    drifts, flips = [], 0
    for length in (step, step / 2):
        states = stepped(module, length, round(6.0 / length))
        y, u = (np.array(values) for values in zip(*map(coordinates, states), strict=True))
        _, momentum = world.momentum(y, u)
        energy = world.kinetic_energy(y, u)
        assert np.allclose(momentum[0], (0.05, 4.0, 0.15))
        assert np.abs(np.sum(y[:, 3:7] ** 2, axis=1) - 1.0).max() < 4e-15
        drifts.append([np.abs(momentum - momentum[0]).max() / 4.0, np.abs(energy / energy[0] - 1.0).max()])
        middle = np.array([float(state.base_omega_y) for state in states])
        flips = int(np.sum(np.diff(np.sign(middle)) != 0.0))
        assert all(float(state.angle[0]) == 0.0 for state in states)
    assert flips >= 1
    coarse, fine = drifts
    assert np.all(np.log2(np.array(coarse) / fine) > order - 0.3), drifts
    assert np.all(np.array(fine) < (3e-4 if order == 2 else 1e-6)), drifts


@pytest.mark.parametrize("name", METHODS)
def test_momentum_is_kept(name: str) -> None:
    """The satellite tumbles, and its panels, bent at first, swing; another arm does by steps of more stages."""
    choices, order = METHODS[name]
    arm = satellite() if name == "newmark" else weightless()
    world, until = AfloatArm(arm), 0.2
    module = package_of(arm, name, choices)
    drifts = []
    for step in (8e-3, 4e-3) if order == 5 else (4e-3, 2e-3):
        states = stepped(module, step, round(until / step))
        y, u = (np.array(values) for values in zip(*map(coordinates, states), strict=True))
        found = np.hstack(world.momentum(y, u))
        drifts.append(np.abs(found - found[0]).max(axis=0))
    coarse, fine = np.array(drifts)
    felt = fine > 1e-13
    assert np.count_nonzero(felt) >= 4
    assert np.all(np.log2(coarse[felt] / fine[felt]) > order - 0.4), drifts
    assert fine.max() < 1e-2


def weightless() -> SpatialArm:
    """Return a random arm in free fall."""
    return replace(undamped(random_afloat(5, 2, loads=False)), gravity=(0.0, 0.0, 0.0), inputs=(), outputs=())


def satellite() -> SpatialArm:
    """Return the example with two cells a panel, tumbling, with bent panels, slow enough to be followed."""
    scene = load_scene(SATELLITE).replace(**{"beam.left_panel.links": 2, "beam.right_panel.links": 2})
    arm = scene.spatial
    assert arm is not None
    assert arm.base is not None
    joints = tuple(
        replace(joint, angle=0.02 * (-1) ** k * (1 + k % 3), damping=0.0)
        for k, joint in enumerate(arm.joints)
    )
    base = replace(arm.base, rate=(0.3, -0.2, 0.4), velocity=(0.1, 0.0, -0.2))
    return replace(arm, joints=joints, base=base, inputs=(), outputs=())


PIECE = Beam(1.0, (2.0, 5.0), 0.8, 1.0, 2e-4)


def test_what_starts_symmetric_stays_so() -> None:
    """Two panels bent alike swing: the hub goes up and down, and neither aside nor turns."""
    joints: list[Revolute] = []
    add_beam(joints, PIECE, 2, twists=False)
    count = len(joints)
    back = ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))
    other = [
        replace(j, name=f"{j.name}_back", host=j.host + count * (j.host > 0), turn=j.turn if k else back)
        for k, j in enumerate(joints)
    ]
    other[0] = replace(other[0], at=tuple(-x for x in joints[0].at))  # type: ignore[arg-type]
    # both bend about their own y axes
    bent = [replace(j, angle=0.1 * (j.axis == 1)) for j in (*joints, *other)]
    hub = FreeBase(RigidBody(0.5, inertia=(0.01, 0.02, 0.03, 0.0, 0.0, 0.0)))
    module = package_of(SpatialArm(tuple(bent), base=hub))
    states = stepped(module, 1e-3, 300)
    y = np.array([coordinates(state)[0] for state in states])
    assert np.ptp(y[:, 2]) > 1e-3
    assert np.abs(y[:, :2]).max() < 1e-13
    assert np.abs(y[:, 3:7] - [1.0, 0.0, 0.0, 0.0]).max() < 1e-12


def test_free_free_beam() -> None:
    """Its half pieces at the inner end are the base; exact frequencies are those of cos x cosh x = 1."""
    from scipy.linalg import eigh
    from scipy.optimize import brentq

    root = brentq(lambda x: np.cos(x) * np.cosh(x) - 1.0, 4.0, 5.0, xtol=1e-14)
    errors = []
    for cells in (5, 10, 20):
        joints: list[Revolute] = []
        add_beam(joints, PIECE, cells, twists=True)
        half = PIECE.length / (2 * cells)
        across = PIECE.mass * half**3 / 12.0
        own = RigidBody(
            PIECE.mass * half, (half / 2.0, 0.0, 0.0), (PIECE.polar * half, across, across, 0.0, 0.0, 0.0)
        )
        arm = SpatialArm(tuple(joints), base=FreeBase(own))
        stiffness = np.diag([joint.stiffness for joint in joints])
        found = np.sqrt(eigh(stiffness, joint_mass(arm), eigvals_only=True))
        exact = root**2 * np.sqrt(PIECE.bending[0] / PIECE.mass) / PIECE.length**2
        errors.append(abs(found[np.argmin(np.abs(found - exact))] / exact - 1.0))
    assert np.all(np.log2(np.array(errors[:-1]) / errors[1:]) > 1.9), errors
    assert errors[-1] < 1e-5
