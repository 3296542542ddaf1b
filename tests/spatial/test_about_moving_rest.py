"""Small motion of arms in space whose base moves, against the reference's equations, MuJoCo, clamps and kernels."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from scipy.linalg import eigh
from support.spatial.about_rest import stiffness
from support.spatial.afloat import random_afloat
from support.spatial.kernels import HEADED
from support.spatial.moving import AFLOAT, TABLE

from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.export.mjcf import KEYFRAME, mujoco_model
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.situation import RestingArm, arm_numbers, rest_in_space, resting_in_space
from tmm_gen.modal.space.still import Still
from tmm_gen.modal.space.sweep import inputs_of, swept
from tmm_gen.reference.spatial_afloat import BASE, AfloatArm
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_turns import product
from tmm_gen.scene import parse_scene
from tmm_gen.scene.spatial.arm import ArmOutput, SpatialArm
from tmm_gen.stability.limits import scene_integrators
from tmm_gen.stability.map import growth_map
from tmm_gen.stability.motion import small_motion

Array = np.ndarray
S = np.array([0.3 + 2.0j, 40.0j, -1.0 + 300.0j])


def apart(found: Array, exact: Array) -> float:
    return float(np.max(np.abs(found - exact)) / np.max(np.abs(exact)))


def adrift(seed: int) -> tuple[Still, AfloatArm, Array]:
    """Return a random arm that floats, its joints at random angles, and its coordinates in the reference."""
    arm = random_afloat(seed, 5)
    angles = np.random.default_rng(seed).uniform(-1.0, 1.0, len(arm.joints))
    world = AfloatArm(arm)
    return Still(ArmNumbers(arm), angles, {}), world, np.concatenate([world.start()[0][:BASE], angles])


@pytest.mark.parametrize("seed", range(4))
def test_an_arm_that_floats_has_the_references_mass_and_mujocos_frequencies(seed: int) -> None:
    still, world, y = adrift(seed)
    assert apart(still.mass, world.joint_mass(y)) < 1e-12
    arm = still.numbers.arm
    model = mujoco.MjModel.from_xml_string(mujoco_model(replace(HEADED, spatial=arm)).text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.keyframe(KEYFRAME).id)
    data.qpos[7:] = still.angles
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    for row, one in zip(mass, np.eye(model.nv), strict=True):
        mujoco.mj_mulM(model, data, row, one)
    squares = eigh(np.diag([*np.zeros(6), *still.numbers.stiffness]), mass, eigvals_only=True)
    undamped = tuple(replace(joint, damping=0.0) for joint in arm.joints)
    freed = Still(ArmNumbers(replace(arm, joints=undamped)), still.angles, {})
    modes = RestingArm(HEADED, freed).modes()
    assert [mode.frequency for mode in modes[:6]] == [0.0] * 6
    found = np.array([mode.frequency for mode in modes]) ** 2
    assert len(found) == len(squares) == 6 + len(arm.joints)
    assert np.sort(found) == pytest.approx(squares, rel=1e-9, abs=1e-12 * squares[-1])


@pytest.mark.parametrize("seed", range(4))
def test_what_acts_on_it_moves_it_as_the_references_matrices_say(seed: int) -> None:
    """Base and joints, under torques and under forces and moments on any body, the base's too."""
    still, world, y = adrift(seed)
    inputs, none = inputs_of(still), np.zeros_like(y)
    alone = world.inverse_dynamics(y, none, none, {})
    acting = np.array([alone - world.inverse_dynamics(y, none, none, {c: 1.0}) for c in inputs.columns]).T
    acting = np.delete(acting, BASE - 1, axis=0)
    spring, damper = (
        np.diag([*np.zeros(6), *own]) for own in (still.numbers.stiffness, still.numbers.damping)
    )
    found = swept(still, S, inputs).moved
    axes = still.numbers.base_facing.T  # of the base in the world's
    for k, s in enumerate(S):
        exact = np.linalg.solve(spring + s * damper + s**2 * world.whole_mass(y), acting)
        own = np.concatenate([axes.T @ exact[:3], axes.T @ exact[3:6], exact[6:]])
        assert apart(found[k], own) < 1e-11


@pytest.mark.parametrize("seed", range(2))
def test_places_and_turns_follow_the_base(seed: int) -> None:
    still, world, y = adrift(seed)
    frame = still.numbers.arm.frames[-1]
    arm = replace(
        still.numbers.arm,
        outputs=(
            ArmOutput("place", "position", frame=frame),
            ArmOutput("hub", "position", frame=replace(frame, joint=0, at=(0.0, 0.0, 0.0))),
        ),
    )
    still = replace(still, numbers=ArmNumbers(arm))
    whole, read = swept(still, S, inputs_of(still)).moved, space_response(still, S)
    axes = still.numbers.base_facing.T
    for k in range(len(S)):
        moved = axes @ whole[k, :3]
        assert np.allclose(np.array([read[f"hub_{a}"][k] for a in "xyz"]), moved, rtol=1e-12)
        turn = 0.5 * product(np.insert(axes @ whole[k, 3:6], 0, 0.0, axis=0).T, y[3:BASE])
        change = np.concatenate([moved, turn.T, whole[k, 6:]])
        parts = [
            world.places(y + 1e-40j * part.T).frame(frame)[1].imag / 1e-40
            for part in (change.real, change.imag)
        ]
        exact = (parts[0] + 1j * parts[1]).T
        assert apart(np.array([read[f"place_{a}"][k] for a in "xyz"]), exact) < 1e-12


def test_nothing_holds_it_against_a_force() -> None:
    scene = parse_scene(AFLOAT)
    with pytest.raises(
        UserError, match="nothing holds the base, so that what --input gives at push_x moves the arm"
    ):
        rest_in_space(scene, {"push_x": 1.0})
    assert rest_in_space(scene).angles == pytest.approx(0.0)  # it falls, and no joint feels its weight


# -- prescribed bases --------------------------------------------------------------------------------------------


def test_a_prescribed_base_is_a_clamp_that_the_reference_can_move() -> None:
    """About a turned base: equilibrium and stiffness as the whole arm has them, and what its angle does."""
    scene, angle = parse_scene(TABLE), 0.4
    arm = scene.spatial
    assert isinstance(arm, SpatialArm)
    given = {"table": angle, "push_x": 0.3}
    resting = resting_in_space(scene, given)
    q = np.array([angle, *resting.still.angles])
    world, zero = WorldArm(arm), np.zeros(len(q))
    lacking = world.inverse_dynamics(q, zero, zero, {"push_x": 0.3})
    assert np.max(np.abs(lacking[1:])) < 1e-12
    spring, mass = stiffness(arm, q, {"push_x": 0.3}), world.mass_matrix(q)
    assert apart(resting.still.mass, mass[1:, 1:]) < 1e-12
    assert apart(resting.linear.stiffness, spring[1:, 1:]) < 1e-12
    read = space_response(resting.still, S)
    column = inputs_of(resting.still).columns.index("table")
    for k, s in enumerate(S):
        dynamic = spring + s * np.diag(world.damping) + s**2 * mass
        change = np.concatenate([[1.0], np.linalg.solve(dynamic[1:, 1:], -dynamic[1:, 0])])
        assert (
            apart(swept(resting.still, S, inputs_of(resting.still)).moved[k, 6:, column], change[1:]) < 1e-11
        )
        assert read["turned"][k, column] == pytest.approx(s)
        frame = next(each for each in arm.frames if each.name == "tip")
        slope = [
            world.tree.places(q + 1e-40j * part).frame(frame)[1].imag / 1e-40
            for part in (change.real, change.imag)
        ]
        exact = slope[0] + 1j * slope[1]
        assert np.allclose(
            [read[f"load_{a}"][k, column] for a in "xyz"], exact, rtol=0.0, atol=1e-11 * np.max(np.abs(exact))
        )


def test_places_do_not_depend_on_who_turns_the_base() -> None:
    scene = parse_scene(TABLE)
    arm = scene.spatial
    assert isinstance(arm, SpatialArm)
    numbers = arm_numbers(scene, {"table": 0.7})
    still = Still(numbers, np.array([0.2, -0.3]), {})
    places = WorldArm(arm).tree.places(np.array([0.7, 0.2, -0.3]))
    for mine, own in zip(numbers.arm.frames, arm.frames, strict=True):
        assert np.allclose(still.place(mine), places.frame(own)[1], rtol=0.0, atol=1e-14)


# -- commands ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", [AFLOAT, TABLE], ids=["floats", "prescribed"])
def test_commands(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.toml").write_text(text)
    assert main(["rest", "arm.toml", "--plot"]) == 0
    assert ("nothing holds the base" in capsys.readouterr().out) == (text == AFLOAT)
    assert main(["modes", "arm.toml", "--plot", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    told = [row["mostly"] for row in rows if row["frequency_hz"] == 0.0]
    assert told == [f"base {way} {a} 100 %" for way in ("moves along", "turns about") for a in "xyz"] * (
        text == AFLOAT
    )
    assert all((row["base_shape"] is None) == (text == TABLE) for row in rows)
    assert main(["frequency", "arm.toml", "--json"]) == 0
    first = json.loads(capsys.readouterr().out)["rows"][0]
    assert first["mode"] == (7 if text == AFLOAT else 1)
    assert first["frequency_hz"] == pytest.approx(
        next(row["frequency_hz"] for row in rows if row["frequency_hz"])
    )


@pytest.mark.parametrize("text", [AFLOAT, TABLE], ids=["floats", "prescribed"])
def test_the_kernel_grows_as_derived(text: str) -> None:
    motion = small_motion(parse_scene(text))
    (method,) = scene_integrators(motion.scene, ["newmark"])
    found = growth_map(motion, method, 3)
    assert not found.differs.any()
    if motion.afloat:  # moving along it neither grows nor decays, however its springs are damped
        assert found.derived.min() == pytest.approx(1.0)
