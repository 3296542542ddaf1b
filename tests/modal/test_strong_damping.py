"""Dampers that hold joints nearly still, as geared motors do: the lowest modes in ascending order, none left out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import cholesky, eigvals, solve_triangular

from tmm_gen.modal.creeping import creeping_pairs
from tmm_gen.modal.linear import Linear
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes, modes_up_to
from tmm_gen.modal.pairs import quadratic
from tmm_gen.modal.situation import resting_arm
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import load_scene, parse_scene

ROOT = Path(__file__).resolve().parents[2]
ELBOW = (ROOT / "scenes" / "elbow.toml").read_text()
Matrices = tuple[np.ndarray, np.ndarray, np.ndarray]


def elbow(shoulder: float, forearm: float, links: int = 5) -> tuple[Linear, Matrices]:
    """The two motors damped as told, N m s/rad at the joints: its matrices here and by the reference."""
    text = ELBOW
    for before, after in (
        ("damping = 0.5 ", f"damping = {shoulder} "),
        ("damping = 0.1\n", f"damping = {forearm}\n"),
        ("links = 5", f"links = {links}"),
    ):
        assert before in text
        text = text.replace(before, after)
    scene = parse_scene(text)
    arm = resting_arm(scene)
    assert arm.rest is not None
    still = np.zeros((1, len(arm.rest.free_angles)))
    stiffness, damping, mass = (
        each[0] for each in Arm(scene, {}).slopes(np.zeros(1), arm.rest.free_angles[None], still, still)
    )
    return matrices(arm), (mass, damping, stiffness)


def six_axes(motor_damping: float) -> tuple[Linear, Matrices]:
    """Every motor of `arm6` damped as told, on its own side."""
    scene = load_scene(ROOT / "examples" / "space" / "arm6.toml")
    assert scene.spatial is not None
    joints = tuple(
        replace(joint, damping=motor_damping * 100.0**2) if joint.armature else joint
        for joint in scene.spatial.joints
    )
    resting = resting_in_space(replace(scene, spatial=replace(scene.spatial, joints=joints)))
    world, angles = WorldArm(resting.arm), resting.still.angles
    still = np.zeros_like(angles)
    stiffness = world.tangents(angles, still, still, {})[0]
    return resting.linear, (world.mass_matrix(angles), np.diag(world.damping), stiffness)


def all_poles(given: Matrices) -> np.ndarray:
    """Eigenvalues of the first-order system."""
    root = cholesky(given[0])
    damping, stiffness = (
        solve_triangular(root, solve_triangular(root, each, trans="T").T, trans="T") for each in given[1:]
    )
    zero, unit = np.zeros_like(root), np.eye(len(root))
    return eigvals(np.block([[zero, unit], [-stiffness, -damping]]))


ARMS = {
    "one motor": (lambda: elbow(2000.0, 0.1), 1),
    "both motors": (lambda: elbow(2000.0, 500.0), 2),
    "fine beams": (lambda: elbow(2000.0, 500.0, links=36), 2),
    "in space": (lambda: six_axes(0.2), 6),
}


@pytest.mark.parametrize("name", ARMS)
def test_the_lowest_modes_are_found_in_order(name: str) -> None:
    """Against eigenvalues of the reference's matrices: which swing, which creep, and that none is left out."""
    make, motors = ARMS[name]
    linear, given = make()
    modes = find_modes(linear, motors + 4)
    frequencies = np.array([mode.frequency for mode in modes])
    assert np.all(np.diff(frequencies) >= 0.0)
    exact = all_poles(given)
    swinging = exact[exact.imag > 1e-3 * np.abs(exact)]
    swinging = swinging[np.argsort(np.abs(swinging))]
    found = np.array([mode.poles[0] for mode in modes if mode.motion == "swings"])
    assert len(found) == 4  # one creeping pair for each motor, below those that swing or between
    assert found == pytest.approx(swinging[:4], rel=1e-6)
    creeping = np.array([mode.poles for mode in modes if mode.motion != "swings"]).real
    for fast in creeping[:, 1]:
        assert np.min(np.abs(exact - fast)) <= 1e-6 * abs(fast)
    assert len(np.unique(creeping[:, 1])) == motors
    real = np.sort(exact.real[exact.imag == 0.0])
    assert np.sort(creeping[:, 0]) == pytest.approx(real[-motors:], rel=1e-5, abs=1e-6)


@pytest.mark.parametrize("name", ["one motor", "in space"])
def test_a_mode_that_damping_makes_has_its_own_shape(name: str) -> None:
    """The vector that the reference's matrices balance at the pole, turned to where its motion is largest."""
    linear, (mass, damping, stiffness) = ARMS[name][0]()
    told = [mode for mode in find_modes(linear, 8) if mode.undamped is None]
    assert len(told) >= 2
    for mode in told:
        pole = mode.poles[0]
        vector = np.linalg.svd(pole**2 * mass + pole * damping + stiffness)[2][-1].conj()
        sides = np.array([vector.real, vector.imag])
        turns = np.linspace(0.0, np.pi, 2001)
        ways = np.stack([np.cos(turns), np.sin(turns)], axis=1) @ sides
        largest = ways[np.argmax(np.einsum("ki,ij,kj->k", ways, mass, ways))]
        largest = largest / largest[np.argmax(np.abs(largest))]
        assert np.minimum(np.abs(largest - mode.shape).max(), np.abs(largest + mode.shape).max()) < 5e-3


def test_light_damping_leaves_shapes_as_they_are() -> None:
    modes = find_modes(elbow(1e-4, 1e-4)[0], 6)
    assert [mode.undamped for mode in modes] == list(range(6))


def test_what_swings_below_a_limit_is_found() -> None:
    linear, given = elbow(2000.0, 500.0, links=36)
    exact = all_poles(given)
    limit = 2.0 * np.pi * 60.0
    modes = [
        mode for mode in modes_up_to(linear, limit) if mode.motion == "swings" and mode.frequency <= limit
    ]
    assert len(modes) == np.sum((exact.imag > 1e-3 * np.abs(exact)) & (np.abs(exact) <= limit))


def test_two_real_poles_belong_to_one_motion() -> None:
    """Oscillators apart, turned into coordinates that mix them: the fast pole of each goes with its own slow one.

    By size alone they cannot be told: the slowest is not that of the fastest.
    """
    rng = np.random.default_rng(1)
    dampers, squares = np.array([7.0, 0.0, 10.0, 1000.0, 40.0]), np.array([0.0, 0.0, 1.0, 2500.0, 0.5])
    turn = np.eye(5)
    turn[2:, 2:] = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    right = [[pole.real for pole in quadratic(k, d)] for k, d in zip(squares, dampers, strict=True)]
    order = rng.permutation(10)
    poles, vectors = np.ravel(right)[order], np.repeat(turn, 2, axis=1)[:, order] * rng.uniform(1, 9, 10)
    found = creeping_pairs(poles, vectors, turn @ np.diag(dampers) @ turn.T, np.array([0, 1]))
    assert sorted(map(tuple, found.tolist())) == sorted(map(tuple, right))


def test_a_held_joint_is_as_good_as_none() -> None:
    """The stiffer the damper, the nearer what swings is to an arm whose shoulder is held."""
    linear, (mass, damping, stiffness) = elbow(1e7, 0.0)
    joint = int(np.argmax(np.diag(damping)))
    held = [k for k in range(len(mass)) if k != joint]
    squares = np.sort(eigvals(stiffness[np.ix_(held, held)], mass[np.ix_(held, held)]).real)
    modes = find_modes(linear, 4)
    assert modes[0].motion == "creeps back"
    # the beams' own dampers leave the slow ones alone
    assert [mode.frequency for mode in modes[1:]] == pytest.approx(np.sqrt(squares[:3]), rel=1e-2)
