"""Static equilibria of arms in space: known ones, what each is, and what is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from support.spatial.about_rest import equilibrium
from support.spatial.random_arms import random_arm
from support.spatial.yardsticks import cantilever

from tmm_gen.errors import UserError
from tmm_gen.modal.equilibria import equilibria
from tmm_gen.modal.space.equilibria import SpaceEquilibria, equilibria_in_space
from tmm_gen.modal.space.equilibrium import descended
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import parse_scene
from tmm_gen.scene.spatial.arm import ArmInput, Frame, Revolute, RigidBody, SpatialArm

G = 9.81
POINT = RigidBody(0.5, (0.0, 0.0, -0.3))


def found_of(arm: SpatialArm, given: dict[str, float] | None = None) -> SpaceEquilibria:
    return equilibria_in_space(ArmNumbers(arm), given or {}, "arm")


def double(first: int, second: int) -> SpatialArm:
    """Return two points on rods of 0.3 m, hung on hinges about frame axes, with a motor in the first."""
    joints = (
        Revolute("upper", 0, axis=first, body=POINT, angle=0.3),
        Revolute("lower", 1, at=(0.0, 0.0, -0.3), axis=second, body=POINT, angle=-0.2),
    )
    motor = ArmInput("torque", "torque", joint=1)
    return SpatialArm(joints, gravity=(0.0, 0.0, -G), inputs=(motor,))


@pytest.mark.parametrize(("first", "second"), [(0, 0), (1, 1), (0, 1)])
def test_double_pendulum_hangs_or_balances_in_three_ways(first: int, second: int) -> None:
    held = found_of(double(first, second))
    assert held.starts == 16
    assert held.found[0].reached
    assert [each.falls for each in held.found] == [0, 1, 1, 2]
    assert [each.state for each in held.found] == ["stable", *["falls over"] * 3]
    for each in held.found:
        turned = each.rest.angles / math.pi
        assert np.max(np.abs(turned - np.round(turned))) < 1e-12
        assert np.all((turned > -1.0 + 1e-9) & (turned < 1.0 + 1e-9))
        assert np.all(np.abs(each.rest.unbalanced) <= 1e-14 * each.rest.scale)


def test_a_torque_holds_it_aside_or_turns_it_on_and_on() -> None:
    """``2 m g l sin(first)`` at the first joint; the second hangs."""
    torque = 2.0
    held = found_of(double(0, 0), {"torque": torque})
    first = math.asin(torque / (2.0 * 0.5 * G * 0.3))
    assert held.found[0].rest.angles == pytest.approx([first, -first], abs=1e-12)
    assert held.found[0].stable
    assert held.found[0].rest.passed == pytest.approx([torque, 0.0], abs=1e-13)
    assert {round(each.rest.angles[0], 9) for each in held.found} == {
        round(first, 9),
        round(math.pi - first, 9),
    }
    with pytest.raises(UserError, match=r"no static equilibrium .*smaller values of --input"):
        found_of(double(0, 0), {"torque": 3.5})


def test_body_on_a_ball_joint_stays_however_it_is_turned() -> None:
    """Each way once, however many angles of three joints are the same: hanging, standing, and where a gimbal locks."""
    body = RigidBody(0.7, (0.05, 0.0, -0.4), (0.011, 0.013, 0.005, 0.0, 0.0, 0.0))
    joints = (
        Revolute("z", 0, axis=2, angle=0.4),
        Revolute("y", 1, axis=1, angle=0.2),
        Revolute("x", 2, axis=0, angle=-0.3, body=body),
    )
    held = found_of(SpatialArm(joints, gravity=(0.0, 0.0, -G)))
    first = held.found[0]
    assert first.reached
    assert first.state == "stays anywhere"
    assert all(each.idle.shape[1] == 1 for each in held.found)
    levels = [float(each.rest.heights[-1]) for each in held.found]
    lever = math.hypot(0.05, 0.4)
    assert sorted(levels) == pytest.approx([-lever, -0.05, 0.05, lever], abs=1e-9)
    assert levels[0] == pytest.approx(-lever, abs=1e-9)
    locked = [abs(float(each.rest.angles[1])) for each in held.found if abs(each.rest.heights[-1]) < 0.1]
    assert locked == pytest.approx([math.pi / 2.0] * 2, abs=1e-9)
    assert [each.falls for each in held.found] == [0, 1, 1, 2]


@pytest.mark.parametrize("seed", range(6))
def test_random_arms_come_to_rest_where_the_reference_has_it(seed: int) -> None:
    arm = random_arm(seed, loads=False)
    numbers = ArmNumbers(arm)
    still = descended(numbers, {}, numbers.start, "arm")
    zero = np.zeros(numbers.size)
    lacking = WorldArm(arm).inverse_dynamics(still.angles, zero, zero, {})
    assert np.all(np.abs(lacking) <= 1e-12 * still.scale)


def test_soft_beam_under_weight_and_a_dead_force_is_the_references() -> None:
    arm = replace(cantilever(6), gravity=(0.0, 3.0, -G))
    given = {"push_x": -1.0, "push_y": 0.5}
    held = found_of(arm, given)
    assert held.starts == 1
    exact = np.zeros(len(arm.joints))
    for share in (0.25, 0.5, 0.75, 1.0):
        weight = tuple(share * g for g in arm.gravity)
        pushed = {name: share * value for name, value in given.items()}
        exact = equilibrium(replace(arm, gravity=(weight[0], weight[1], weight[2])), pushed, exact)
    assert held.found[0].rest.angles == pytest.approx(exact, abs=1e-11)


def test_buckled_columns_are_found_from_the_straight_one() -> None:
    """Past its load, a standing strut falls to both sides; sprung both ways, in the softer plane alone."""
    top = RigidBody(1.0, (0.5, 0.0, 0.0), (1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0))
    upright = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    joints = (
        Revolute("soft", 0, turn=upright, axis=1, stiffness=4.0, armature=1e-4),
        Revolute("stiff", 1, axis=2, stiffness=6.0, body=top),
    )
    held = found_of(SpatialArm(joints, gravity=(0.0, 0.0, -G)))
    assert [each.falls for each in held.found] == [1, 0, 0]
    sides = [each.rest.angles[0] for each in held.found[1:]]
    assert sum(sides) == pytest.approx(0.0, abs=1e-9)
    # k q = m g l sin q
    assert 4.0 * abs(sides[0]) == pytest.approx(G * 0.5 * math.sin(abs(sides[0])), rel=1e-10)


def test_a_force_that_turns_with_its_body_has_no_energy() -> None:
    arm = cantilever(4)
    follower = ArmInput("push", "force", frame=arm.frames[0], axes="body")
    with pytest.raises(UserError, match=r'push_y turns with the arm.*in = "world"'):
        found_of(replace(arm, inputs=(follower,)), {"push_y": 0.3})


def test_moment_about_the_only_axis_there_is_has_one() -> None:
    tip = Frame("tip", 1, (0.0, 0.0, -0.3))
    arm = SpatialArm(
        (Revolute("pivot", 0, axis=0, body=POINT),),
        (tip,),
        (0.0, 0.0, -G),
        (ArmInput("twist", "moment", frame=tip, axes="world"),),
    )
    held = found_of(arm, {"twist_x": 0.7})
    assert held.found[0].rest.angles[0] == pytest.approx(math.asin(0.7 / (0.5 * G * 0.3)), abs=1e-12)


def test_planar_twin_has_the_same_equilibria() -> None:
    """The sample with motors at shoulder and elbow, written in space: angles of joints against those of links."""
    text = """
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
name = "shoulder"
{axis}
[[beam]]
name = "upper"
on = "shoulder"
length = 0.5
bending_stiffness = {bending}
mass_per_length = 0.5
links = 4
[[motor]]
name = "elbow"
on = "upper"
{axis}
[[link]]
name = "hand"
on = "elbow"
mass = 0.3
{hand}
[[output]]
name = "elbow"
at = "elbow"
of = "{angle}"
[[input]]
name = "lift"
at = "shoulder"
acts = "torque"
"""
    plane = parse_scene(
        text.format(
            kind="planar",
            gravity=G,
            axis="",
            bending="9.0",
            angle="angle",
            hand="length = 0.3\ncenter = 0.5\ninertia = 1e-3",
        )
    )
    space = parse_scene(
        text.format(
            kind="spatial",
            gravity="[0, -9.81, 0]",
            axis='axis = "z"',
            bending="[9.0, 9.0]",
            angle="angle",
            hand="end = [0.3, 0, 0]\ncenter = [0.15, 0, 0]\ninertia = [1e-4, 1e-3, 1e-3]",
        )
    )
    assert space.spatial is not None
    given = {"lift": 0.6}
    flat, solid = equilibria(plane, given), found_of(space.spatial, given)
    assert [each.falls for each in flat.found][:1] == [0]
    bends = [k for k, joint in enumerate(space.spatial.joints) if joint.axis == 2]
    known = [np.diff(np.concatenate([[0.0], each.rest.angles])) for each in flat.found]
    for each in solid.found:
        assert np.max(np.abs(np.delete(each.rest.angles, bends))) < 1e-9
    # across the plane an arm that stands may fall too, so only angles are held together
    for turns in known:
        apart = [
            np.max(np.abs(np.angle(np.exp(1j * (each.rest.angles[bends] - turns))))) for each in solid.found
        ]
        assert min(apart) < 1e-9
