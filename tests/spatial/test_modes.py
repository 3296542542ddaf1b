"""Modes of arms in space: closed forms, continuous beams, planar twins, and what turns freely."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from support.spatial.about_rest import frequencies, stiffness
from support.spatial.beams import End, add_beam
from support.spatial.random_arms import random_arm
from support.spatial.yardsticks import (
    CANTILEVER,
    STRIP,
    cantilever,
    cantilever_frequencies,
    frame,
    frame_frequencies,
    strip,
    strip_force,
    strip_tip,
)

from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import Mode, find_modes
from tmm_gen.modal.situation import resting_arm
from tmm_gen.modal.space.equilibrium import descended
from tmm_gen.modal.space.matrices import space_matrices
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.modal.space.still import Still
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.spatial.arm import Revolute, RigidBody, SpatialArm, Turn

G = 9.81
CELLS = (5, 10, 20)
BODY = RigidBody(0.7, (0.0, 0.0, -0.4), (0.011, 0.013, 0.005, 0.0, 0.0, 0.0))


def rested(arm: SpatialArm, given: dict[str, float] | None = None) -> Still:
    numbers = ArmNumbers(arm)
    return descended(numbers, given or {}, numbers.start, "arm")


def modes_of(
    arm: SpatialArm, given: dict[str, float] | None = None, count: int | None = None
) -> tuple[Mode, ...]:
    return find_modes(space_matrices(rested(arm, given)), count)


def found_frequencies(arm: SpatialArm, given: dict[str, float] | None = None) -> np.ndarray:
    return np.array([mode.frequency for mode in modes_of(arm, given)])


def slopes(errors: list[float]) -> np.ndarray:
    return np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))


# -- pendulums ---------------------------------------------------------------------------------------------------


def tilted(angle: float) -> Turn:
    c, s = math.cos(angle), math.sin(angle)
    return ((c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c))


@pytest.mark.parametrize("angle", [0.0, 0.3, 1.2, 1.57])
def test_compound_pendulum_about_a_tilted_axis(angle: float) -> None:
    """Its weight counts by the share across the axis: ``w^2 = m g l cos(tilt) / J``."""
    joint = Revolute("pivot", 0, turn=tilted(angle), axis=0, body=BODY)
    (mode,) = modes_of(SpatialArm((joint,), gravity=(0.0, 0.0, -G)))
    inertia = BODY.inertia[0] + 0.7 * 0.4**2
    assert mode.frequency == pytest.approx(math.sqrt(0.7 * G * 0.4 * math.cos(angle) / inertia), rel=1e-13)
    assert mode.bound < 1e-14


def ball(body: RigidBody, gravity: tuple[float, float, float], *angles: float) -> SpatialArm:
    """Return a body on three hinges about z, y and x at one point."""
    z, y, x = angles
    joints = (
        Revolute("z", 0, axis=2, angle=z),
        Revolute("y", 1, axis=1, angle=y),
        Revolute("x", 2, axis=0, angle=x, body=body),
    )
    return SpatialArm(joints, gravity=gravity)


def test_body_on_a_ball_joint_swings_both_ways_and_turns_freely() -> None:
    turning, about_x, about_y = modes_of(ball(BODY, (0.0, 0.0, -G), 0.0, 0.0, 0.0))
    assert turning.frequency == 0.0
    assert not turning.unstable
    exact = sorted(math.sqrt(0.7 * G * 0.4 / (own + 0.7 * 0.4**2)) for own in BODY.inertia[:2])
    assert (about_x.frequency, about_y.frequency) == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize("seed", range(4))
def test_ball_joint_in_any_position(seed: int) -> None:
    """Which way gravity points makes no difference, and one motion is free however the joints stand in it."""
    rng = np.random.default_rng(seed)
    down = rng.normal(size=3)
    down *= G / np.linalg.norm(down)
    body = replace(BODY, center=tuple(rng.normal(0.0, 0.3, 3).tolist()))
    arm = ball(body, tuple(down.tolist()), *rng.uniform(-1.0, 1.0, 3).tolist())
    still = rested(arm)
    modes = find_modes(space_matrices(still))
    assert [mode.frequency > 0.0 for mode in modes] == [False, True, True]
    exact = frequencies(arm, still.angles)
    assert [mode.frequency for mode in modes[1:]] == pytest.approx(exact[1:], rel=1e-10)


def test_beam_on_a_ball_joint_hangs_bent_and_turns_freely() -> None:
    """Sixty-three joints, and still one motion that weight does not mind, whichever way it points."""
    rng, known = np.random.default_rng(0), []
    for _ in range(3):
        down = rng.normal(size=3)
        down *= G / np.linalg.norm(down)
        beside = RigidBody(0.2, (0.05, 0.03, 0.02), (1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0))
        joints = list(ball(beside, (0.0, 0.0, 0.0), *rng.normal(size=3).tolist()).joints)
        add_beam(joints, CANTILEVER, 20, End(3))
        still = rested(SpatialArm(tuple(joints), gravity=tuple(down.tolist())))
        assert np.all(np.abs(still.unbalanced) < 1e-14 * still.scale)
        modes = find_modes(space_matrices(still), 4)
        assert [mode.frequency > 0.0 for mode in modes] == [False, True, True, True]
        found = [mode.frequency for mode in modes[1:]]
        assert found == pytest.approx(frequencies(still.numbers.arm, still.angles)[1:4], rel=1e-9)
        known.append(found)
    assert known[1] == pytest.approx(known[0], rel=1e-12)
    assert known[2] == pytest.approx(known[0], rel=1e-12)


@pytest.mark.parametrize("axis", [0, 1])
def test_double_pendulum(axis: int) -> None:
    """Two mass points on equal strings: ``w^2 = (2 -+ sqrt 2) g / l``; about x and about y alike."""
    point, length = RigidBody(0.5, (0.0, 0.0, -0.3)), 0.3
    joints = (
        Revolute("upper", 0, axis=axis, body=point),
        Revolute("lower", 1, at=(0.0, 0.0, -length), axis=axis, body=point, angle=0.4),
    )
    found = found_frequencies(SpatialArm(joints, gravity=(0.0, 0.0, -G)))
    exact = [math.sqrt((2.0 + sign * math.sqrt(2.0)) * G / length) for sign in (-1.0, 1.0)]
    assert found == pytest.approx(exact, rel=1e-12)


def test_pendulums_in_planes_of_their_own() -> None:
    """The second hinge across the first: it swings the lower point alone, the first both, as one body."""
    point, length = RigidBody(0.5, (0.0, 0.0, -0.3)), 0.3
    joints = (
        Revolute("upper", 0, axis=0, body=point),
        Revolute("lower", 1, at=(0.0, 0.0, -length), axis=1, body=point),
    )
    found = found_frequencies(SpatialArm(joints, gravity=(0.0, 0.0, -G)))
    together = math.sqrt(3.0 * G / (5.0 * length))  # m g (l + 2 l) over m (l^2 + 4 l^2)
    assert found == pytest.approx([together, math.sqrt(G / length)], rel=1e-12)


# -- beams -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("way", ["bend_y", "bend_z", "twist_x"])
@pytest.mark.parametrize("number", [0, 1])
def test_cantilever(way: str, number: int) -> None:
    exact = cantilever_frequencies()[way][number]
    errors = []
    for cells in CELLS:
        found = found_frequencies(cantilever(cells))
        errors.append(float(found[np.argmin(np.abs(found - exact))]) / exact - 1.0)
    assert np.all(np.abs(slopes(errors) - 2.0) < 0.1), errors


def test_frame() -> None:
    exact = sorted((*frame_frequencies()[0], *frame_frequencies()[1]))
    errors = np.array([found_frequencies(frame(cells))[:4] / exact - 1.0 for cells in CELLS])
    for each in errors.T:
        assert np.all(np.abs(slopes(each.tolist()) - 2.0) < 0.1), each


def test_thin_beam_far_from_straight() -> None:
    """Where a dead load bends it, a Kirchhoff rod's tip is met with order two, and the reference's frequencies."""
    load, exact = strip_force(13.345, 45.0), strip_tip(13.345, 45.0)
    errors = []
    for cells in CELLS:
        still = rested(strip(cells), load)
        tip = still.numbers.arm.frames[0]
        errors.append(float(np.linalg.norm(still.place(tip) - exact)))
        assert np.linalg.norm(still.place(tip) - [STRIP.length, 0.0, 0.0]) > 0.15
        assert still.conservative
        by_angle, mass = stiffness(still.numbers.arm, still.angles, load), WorldArm(still.numbers.arm)
        squares = eigh(0.5 * (by_angle + by_angle.T), mass.mass_matrix(still.angles), eigvals_only=True)
        found = [mode.frequency for mode in find_modes(space_matrices(still), 6)]
        assert found == pytest.approx(np.sqrt(squares[:6]), rel=1e-9)
    assert np.all(np.abs(slopes(errors) - 2.0) < 0.1), errors


def test_sagging_beam_has_the_frequencies_of_the_reference() -> None:
    arm = replace(cantilever(6), gravity=(0.0, 3.0, -G))
    still = rested(arm)
    assert np.max(np.abs(still.unbalanced)) < 1e-13 * np.max(still.scale)
    assert still.place(arm.frames[0])[2] < -0.3
    found = [mode.frequency for mode in find_modes(space_matrices(still))]
    assert found == pytest.approx(frequencies(arm, still.angles), rel=1e-10)


def column(cells: int, load: float) -> SpatialArm:
    """Return a standing clamped beam of 1 m and unit stiffness, without mass but for a point on its top."""
    piece = 1.0 / cells
    top = RigidBody(load / G, (piece / 2.0, 0.0, 0.0))
    joints = []
    for number in range(cells):
        at = (piece / 2.0 if number == 0 else piece, 0.0, 0.0)
        turn = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)) if number == 0 else None
        side = Revolute(f"y{number}", 2 * number, at=at, axis=1, stiffness=cells, armature=1e-9)
        joints.append(side if turn is None else replace(side, turn=turn))
        last = number == cells - 1
        joints.append(
            Revolute(
                f"z{number}",
                2 * number + 1,
                axis=2,
                stiffness=1.5 * cells,
                body=top if last else RigidBody(),
                armature=1e-9,
            )
        )
    return SpatialArm(tuple(joints), gravity=(0.0, 0.0, -G))


def critical(cells: int) -> float:
    """Return the load at which the slowest square vanishes, from two loads beside it: it falls linearly there."""
    squares = []
    loads = (0.98 * math.pi**2 / 4.0, 0.97 * math.pi**2 / 4.0)
    for load in loads:
        still = Still(ArmNumbers(column(cells, load)), np.zeros(2 * cells), {})
        mode = find_modes(space_matrices(still), 1)[0]
        squares.append((mode.poles[0] * mode.poles[1]).real * load)
    slope = (squares[1] - squares[0]) / (loads[1] - loads[0])
    return loads[0] - squares[0] / slope


def test_column_gives_way_at_eulers_load() -> None:
    exact = math.pi**2 / 4.0
    errors = [critical(cells) / exact - 1.0 for cells in CELLS]
    assert np.all(np.abs(slopes(errors) - 2.0) < 0.1), errors
    for share, falls in ((0.95, 0), (1.05, 1), (1.55, 2)):
        still = Still(ArmNumbers(column(20, share * exact)), np.zeros(40), {})
        linear = space_matrices(still)
        assert linear.springs.negative == falls
        assert [mode.unstable for mode in find_modes(linear, 3)] == [k < falls for k in range(3)]


# -- planar twins ------------------------------------------------------------------------------------------------

TWINS = """
name = "twin"
[model]
kind = "{kind}"
gravity = {gravity}
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[motor]]
name = "hub"
rotor_inertia = 2e-4
gear = 10
damping = 0.02
{axis}
[[beam]]
name = "upper"
on = "hub"
length = 0.8
bending_stiffness = 2.0
mass_per_length = 0.4
links = 6
damping_time = 1e-3
[[joint]]
name = "hinge"
on = "upper"
stiffness = 1.5
damping = 0.01
rest = 0.4
{axis}
[[link]]
name = "hand"
on = "hinge"
mass = 0.2
{hand}
[[output]]
name = "hub"
at = "hub"
of = "angle"
"""


def twin(kind: str) -> Scene:
    spatial = kind == "spatial"
    return parse_scene(
        TWINS.format(
            kind=kind,
            gravity="[0, -9.81, 0]" if spatial else 9.81,
            axis='axis = "z"' if spatial else "",
            hand="end = [0.2, 0, 0]\ncenter = [0.06, 0, 0]\ninertia = [1e-3, 1e-3, 2e-3]"
            if spatial
            else "length = 0.2\ncenter = 0.3\ninertia = 2e-3",
        )
    )


def test_planar_twin() -> None:
    """An arm of the plane has the same modes in space, and those across it besides."""
    plane = find_modes(matrices(resting_arm(twin("planar"))))
    space = find_modes(resting_in_space(twin("spatial")).linear)
    assert len(space) == len(plane) + 6
    poles = np.array([pole for mode in space for pole in mode.poles])
    for mode in plane:
        for pole in mode.poles:
            assert np.min(np.abs(poles - pole)) < 1e-9 * abs(pole)


# -- what turns freely ---------------------------------------------------------------------------------------------


def test_without_weight_all_joints_without_a_spring_turn_freely() -> None:
    for seed in range(6):
        arm = replace(random_arm(seed), gravity=(0.0, 0.0, 0.0))
        free = sum(joint.stiffness == 0.0 for joint in arm.joints)
        found = np.array([mode.frequency for mode in modes_of(arm)])
        assert int(np.sum(found == 0.0)) == free
        assert free > 0


def yawing(tilt: float = 0.0, stiffness: float = 0.0) -> SpatialArm:
    """Return a pendulum across a yaw joint, whose axis is tilted from upright; its mass hangs beside the axis."""
    beside = RigidBody(0.7, (0.1, 0.0, -0.4), (0.011, 0.013, 0.005, 0.0, 0.0, 0.0))
    joints = (
        Revolute(
            "yaw", 0, turn=tilted(tilt), axis=2, stiffness=stiffness, body=RigidBody(0.3, (0.2, 0.0, 0.0))
        ),
        Revolute("swing", 1, axis=1, body=beside, angle=0.2),
    )
    return SpatialArm(joints, gravity=(0.0, 0.0, -G))


def test_what_weight_does_not_mind_is_free_and_what_it_minds_a_little_is_not() -> None:
    free, swing = found_frequencies(yawing())
    assert free == 0.0
    small = {}
    for tilt in (1e-3, 1e-5, 1e-7):
        slow, fast = found_frequencies(yawing(tilt))
        assert fast == pytest.approx(swing, rel=1e-2)
        small[tilt] = slow**2 / tilt
    # the square of the frequency goes with the tilt
    assert small[1e-5] == pytest.approx(small[1e-3], rel=1e-2)
    assert small[1e-7] == pytest.approx(small[1e-5], rel=1e-4)


def test_what_falls_over_beside_what_turns_freely() -> None:
    """On a yaw joint a pendulum stands on its head, another hangs from it by a spring across: one of each kind."""
    joints = (
        Revolute("yaw", 0, axis=2, body=RigidBody(0.3, (0.2, 0.0, 0.0))),
        Revolute("stands", 1, axis=1, body=BODY),
        Revolute("leans", 2, at=(0.0, 0.0, -0.4), axis=0, stiffness=9.0, body=BODY),
    )
    arm = SpatialArm(joints, gravity=(0.0, 0.0, -G))
    still = Still(ArmNumbers(arm), np.array([0.3, math.pi, 0.0]), {})
    assert np.all(np.abs(still.unbalanced) < 1e-14 * still.scale)
    modes = find_modes(space_matrices(still))
    exact = frequencies(arm, still.angles)
    assert [mode.unstable for mode in modes] == [True, False, False]
    assert [mode.frequency > 0.0 for mode in modes] == [False, False, True]
    assert modes[0].poles[0].real == pytest.approx(-exact[0], rel=1e-12)
    assert modes[2].frequency == pytest.approx(exact[2], rel=1e-12)
    assert max(mode.bound for mode in modes) < 1e-12


def test_a_weak_spring_is_a_spring() -> None:
    """Ten decades softer than weight: it is seen beside nothing, as nothing else resists there."""
    soft, softer = (found_frequencies(yawing(stiffness=k))[0] for k in (1e-10, 1e-14))
    assert softer == pytest.approx(1e-2 * soft, rel=1e-10)
    assert softer > 0.0


def test_bounds_are_small_and_hold() -> None:
    """Of frequencies of arms whose joints differ by eight decades, against the reference's matrices at 40 digits."""
    from mpmath import mp

    arm = replace(cantilever(3), gravity=(0.0, 0.0, -G))
    joints = tuple(
        replace(joint, stiffness=joint.stiffness * 10.0 ** (k % 3 * 4)) for k, joint in enumerate(arm.joints)
    )
    still = rested(replace(arm, joints=joints))
    modes = find_modes(space_matrices(still))
    stiffness = np.diag(still.numbers.stiffness) + 0.5 * (still.geometric + still.geometric.T)
    with mp.workdps(40):
        inverse = mp.cholesky(mp.matrix(still.mass.tolist())) ** -1
        square = inverse * mp.matrix(stiffness.tolist()) * inverse.T
        exact = sorted(float(mp.sqrt(value)) for value in mp.eigsy(square, eigvals_only=True))
    for mode, true in zip(modes, exact, strict=True):
        assert abs(mode.frequency / true - 1.0) <= max(mode.bound, 1e-12)
        assert mode.bound < 1e-6
