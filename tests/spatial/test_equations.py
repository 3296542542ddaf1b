"""The reference's equations of arms in space against MuJoCo's, and against themselves written otherwise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.spatial.about_rest import equilibrium, stiffness
from support.spatial.mujoco_model import mjcf
from support.spatial.random_arms import random_arm, undamped

from tmm_gen.inputs.signals import Sine, Table
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_given import given
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene.spatial.arm import ArmInput, SpatialArm

ARMS, STATES = 50, 20
"""A thousand states."""


def drawn(arm: SpatialArm, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, dict[str, float]]:
    """Return random angles, rates, accelerations and inputs."""
    rng = np.random.default_rng(seed)
    q, v, a = rng.uniform(-3.0, 3.0, (3, len(arm.joints)))
    columns = [column for item in arm.inputs for column in item.columns]
    return q, v, a, dict(zip(columns, rng.normal(size=len(columns)).tolist(), strict=True))


@pytest.mark.parametrize("first", range(0, ARMS, 10))
def test_accelerations_are_mujocos(first: int) -> None:
    mujoco = pytest.importorskip("mujoco")
    for seed in range(first, first + 10):
        arm = random_arm(seed)
        world, model = WorldArm(arm), mujoco.MjModel.from_xml_string(mjcf(arm))
        data = mujoco.MjData(model)
        for state in range(STATES):
            q, v, a, inputs = drawn(arm, 1000 * seed + state)
            data.qpos[:], data.qvel[:] = q, v
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            data.qfrc_applied[:] = applied(mujoco, model, data, arm, inputs)
            mujoco.mj_forward(model, data)
            found = world.forward_dynamics(q, v, inputs)
            assert np.max(np.abs(found - data.qacc)) < 1e-11 * np.max(np.abs(data.qacc))
            places_are_mujocos(mujoco, model, data, arm, q, v, a)


def applied(mujoco, model, data, arm: SpatialArm, inputs: dict[str, float]) -> np.ndarray:
    """Return the torques of inputs in the joints, by MuJoCo's own Jacobians."""
    torques = np.zeros(len(arm.joints))
    for item in arm.inputs:
        if item.frame is None:
            torques[item.joint - 1] += arm.joints[item.joint - 1].gear * inputs[item.name]
            continue
        vector = np.array([inputs[column] for column in item.columns])
        turn = data.xmat[item.frame.joint].reshape(3, 3)
        if item.axes == "body":
            vector = turn @ np.array(item.frame.turn) @ vector
        point = data.xpos[item.frame.joint] + turn @ np.array(item.frame.at)
        pair = (vector, np.zeros(3)) if item.acts == "force" else (np.zeros(3), vector)
        mujoco.mj_applyFT(model, data, *pair, point, item.frame.joint, torques)
    return torques


def places_are_mujocos(mujoco, model, data, arm: SpatialArm, q, v, a) -> None:
    """Compare place and velocity of the first frame, and the energies."""
    found = {name: float(value[0]) for name, value in outputs(arm, q[None], v[None], a[None], {}).items()}
    frame = arm.frames[0]
    turn = data.xmat[frame.joint].reshape(3, 3)
    point = data.xpos[frame.joint] + turn @ np.array(frame.at)
    assert np.allclose([found[f"tip_{axis}"] for axis in "xyz"], point, rtol=0.0, atol=1e-13)
    jacobian = np.zeros((3, len(q)))
    mujoco.mj_jac(model, data, jacobian, None, point, frame.joint)
    assert np.allclose([found[f"tip_velocity_{axis}"] for axis in "xyz"], jacobian @ v, rtol=0.0, atol=1e-12)
    w, x, y, z = (found[f"tip_turn_{part}"] for part in "wxyz")
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, np.array([w, x, y, z]))
    assert np.allclose(matrix.reshape(3, 3), turn @ np.array(frame.turn), rtol=0.0, atol=1e-13)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_energyVel(model, data)
    potential, kinetic = data.energy
    assert found["elastic"] + found["weight"] == pytest.approx(potential, rel=1e-11, abs=1e-11)
    assert found["kinetic"] == pytest.approx(kinetic, rel=1e-11)


@pytest.mark.parametrize("seed", range(20))
def test_mass_matrix_is_what_inverse_dynamics_has(seed: int) -> None:
    arm = random_arm(seed)
    world = WorldArm(arm)
    q, v, a, inputs = drawn(arm, seed)
    mass = world.mass_matrix(q)
    by_parts = world.inverse_dynamics(q, v, a, inputs) - world.inverse_dynamics(q, v, 0.0 * a, inputs)
    assert np.allclose(mass @ a, by_parts, rtol=0.0, atol=1e-12 * np.max(np.abs(mass)) * np.max(np.abs(a)))
    assert np.allclose(mass, mass.T, rtol=0.0, atol=1e-14 * np.max(mass))
    assert np.min(np.linalg.eigvalsh(mass)) > 0.0


@pytest.mark.parametrize("seed", range(5))
def test_tangents_are_the_differences(seed: int) -> None:
    arm = random_arm(seed)
    world = WorldArm(arm)
    q, v, a, inputs = drawn(arm, seed)
    step = 1e-5
    found = world.tangents(q, v, a, inputs)
    for place, tangent in enumerate(found):
        for joint in range(len(q)):
            moved = [[q.copy(), v.copy()] for _ in range(2)]
            moved[0][place][joint] += step
            moved[1][place][joint] -= step
            ahead, back = (world.inverse_dynamics(*pair, a, inputs) for pair in moved)
            scale = 1.0 + np.max(np.abs(ahead))
            assert np.allclose((ahead - back) / (2.0 * step), tangent[:, joint], rtol=0.0, atol=1e-8 * scale)


def test_many_states_at_once_are_each_alone() -> None:
    arm = random_arm(3)
    world = WorldArm(arm)
    states = [drawn(arm, seed) for seed in range(4)]
    q, v, a = (np.array([state[part] for state in states]) for part in range(3))
    inputs = {name: np.array([state[3][name] for state in states]) for name in states[0][3]}
    together = world.forward_dynamics(q, v, inputs), *world.tangents(q, v, a, inputs)
    for number, (at, rate, pull, alone) in enumerate(states):
        apart = world.forward_dynamics(at, rate, alone), *world.tangents(at, rate, pull, alone)
        for one, other in zip(together, apart, strict=True):
            assert np.allclose(one[number], other, rtol=1e-12, atol=1e-12 * np.max(np.abs(other)))


@pytest.mark.parametrize("seed", range(4))
def test_motion_is_scipys(seed: int) -> None:
    """The same equations integrated by an explicit method of order 8, restarted where an input has a kink."""
    arm = random_arm(seed, 5)
    world, n = WorldArm(arm), 5
    kink = Table(np.array([0.0, 0.2, 0.5]), np.array([0.0, 0.3, -0.1]))
    signals = {"torque_2": Sine(0.05, 7.0), f"force_body_{arm.frames[0].name}_y": kink}

    def slope(time: float, state: np.ndarray) -> np.ndarray:
        inputs = {name: float(signal.at(time)) for name, signal in signals.items()}
        return np.concatenate([state[n:], world.forward_dynamics(state[:n], state[n:], inputs)])

    state = np.array([joint.angle for joint in arm.joints] + [joint.rate for joint in arm.joints])
    for begin, end in ((0.0, 0.2), (0.2, 0.5)):
        state = solve_ivp(slope, (begin, end), state, method="DOP853", rtol=1e-11, atol=1e-11).y[:, -1]
        q, v, a = motion(arm, signals, np.array([0.0, end]))
        assert np.max(np.abs(q[1] - state[:n])) < 1e-9 * max(1.0, np.max(np.abs(q)))
        assert np.max(np.abs(v[1] - state[n:])) < 1e-9 * max(1.0, np.max(np.abs(v)))
        assert np.allclose(a[1], slope(end, state)[n:], rtol=1e-8, atol=1e-8 * np.max(np.abs(a)))


@pytest.mark.parametrize("seed", range(4))
def test_energy_is_kept_without_dampers(seed: int) -> None:
    arm = undamped(random_arm(seed, 5, loads=False))
    found = outputs(arm, *motion(arm, {}, np.linspace(0.0, 1.0, 11)), {})
    total = found["kinetic"] + found["elastic"] + found["weight"]
    assert np.ptp(found["kinetic"]) > 0.01 * np.max(found["kinetic"])  # energy goes to and fro
    assert np.ptp(total) < 1e-9 * np.max(found["kinetic"])


@pytest.mark.parametrize("seed", range(4))
def test_power_of_inputs_is_what_the_energy_gains(seed: int) -> None:
    """The rate of all energy is the power of loads less that of dampers, at any instant."""
    arm = random_arm(seed)
    arm = replace(arm, outputs=tuple(output for output in arm.outputs if output.of.endswith("energy")))
    world = WorldArm(arm)
    q, v, _, inputs = drawn(arm, seed)
    a = world.forward_dynamics(q, v, inputs)
    step = 1e-30
    ahead = outputs(arm, (q + 1j * step * v)[None], (v + 1j * step * a)[None], a[None], {})
    gained = sum(float(ahead[name][0].imag) for name in ("kinetic", "elastic", "weight")) / step
    free = world.forward_dynamics(q, v, {})
    power = float(v @ world.mass_matrix(q) @ (a - free)) - float(v**2 @ world.damping)
    assert gained == pytest.approx(power, rel=1e-9, abs=1e-9)


def test_rest_is_where_nothing_lacks() -> None:
    arm = random_arm(11, 6, loads=False)
    stiff = SpatialArm(
        tuple(replace(joint, stiffness=60.0, rest=0.1) for joint in arm.joints),
        arm.frames,
        arm.gravity,
    )
    q = equilibrium(stiff)
    assert np.max(np.abs(WorldArm(stiff).inverse_dynamics(q, 0.0 * q, 0.0 * q, {}))) < 1e-11
    tangent = stiffness(stiff, q)
    assert np.allclose(tangent, tangent.T, atol=1e-11)  # weight and springs have an energy


def test_inputs_by_signal() -> None:
    """What moves a base comes with its derivatives."""
    times, told = np.array([0.0, 0.1]), Sine(2.0, 5.0)
    arm = SpatialArm((), inputs=(ArmInput("push", "torque", joint=1), ArmInput("along", "place_x")))
    found = given(arm, {"push": told, "along": told}, times)
    assert found["push"] == pytest.approx(2.0 * np.sin(5.0 * times))
    assert found["along_rate"] == pytest.approx(10.0 * np.cos(5.0 * times))
    assert found["along_acceleration"] == pytest.approx(-50.0 * np.sin(5.0 * times))
    assert found.keys() == {"push", "along", "along_rate", "along_acceleration"}
