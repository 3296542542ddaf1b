"""Arms on a base that floats, at single states: kernels against the reference, and the reference against MuJoCo."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest
from support.spatial.afloat import coordinates, random_afloat
from support.spatial.kernels import HEADED, package_of

from tmm_gen.export.mjcf import KEYFRAME, mujoco_model
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.spatial_afloat import AfloatArm
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.reference.spatial_turns import product
from tmm_gen.scene.spatial.arm import ArmOutput, SpatialArm


def random_inputs(arm: SpatialArm, seed: int) -> dict[str, float]:
    columns = [column for item in arm.inputs for column in item.columns]
    values = np.random.default_rng(seed).normal(size=len(columns))
    return dict(zip(columns, values.tolist(), strict=True))


def assert_starts(arm: SpatialArm, seed: int) -> None:
    """The start's accelerations and all outputs are those of the reference, under all kinds of loads."""
    accelerations = tuple(
        ArmOutput(f"a_{k + 1}", "acceleration", joint=k + 1) for k in range(len(arm.joints))
    )
    arm = replace(arm, outputs=(*arm.outputs, *accelerations))
    module, inputs = package_of(arm), random_inputs(arm, seed)
    state = module.initialise(module.Params(), module.Input(**inputs))
    read = module.output(module.prepare(), state)
    world = AfloatArm(arm)
    y, u = world.start()
    b = world.forward_dynamics(y, u, inputs)
    for found, wanted in zip(coordinates(state), (y, u), strict=True):
        assert np.allclose(found, wanted, rtol=0.0, atol=1e-15 * max(1.0, np.abs(wanted).max()) * 4)
    largest = float(np.abs(b).max())
    place = [float(getattr(state, f"base_acceleration_{k}")) for k in "xyz"]
    turning = [float(getattr(state, f"base_alpha_{k}")) for k in "xyz"]
    carrier = world.carrier(y, u, b)
    assert np.abs(place - b[:3]).max() < 1e-12 * largest
    assert np.abs(turning - carrier.axes.T @ carrier.spinning).max() < 1e-12 * largest
    values = {name: np.array([value]) for name, value in inputs.items()}
    for name, (value,) in outputs(arm, y[None], u[None], b[None], values).items():
        size = largest if name.startswith("a_") else max(1.0, abs(value))
        assert abs(getattr(read, name) - value) < 1e-12 * size, name


@pytest.mark.parametrize("seed", [7, 106])  # the last has loads on a joint without mass
def test_start_and_outputs(seed: int) -> None:
    assert_starts(random_afloat(seed, 2), seed)


def test_a_quaternion_of_any_length_is_a_start() -> None:
    module = package_of(random_afloat(0, 2, loads=False))
    states = [
        module.initialise(
            module.Params(), module.Input(), initial_base_quaternion=size * np.array([1.0, -2, 0.5, 1])
        )
        for size in (1.0, 1e3)
    ]
    one, other = (coordinates(state)[0] for state in states)
    assert np.allclose(one, other, rtol=1e-14)
    assert np.sum(one[3:7] ** 2) == pytest.approx(1.0, abs=1e-15)
    with pytest.raises(ArithmeticError):
        module.initialise(module.Params(), module.Input(), initial_base_quaternion=np.zeros(4))


def test_a_base_that_weighs_less_than_nothing_is_told() -> None:
    """By the pivots, where parameters are no longer the scene's."""
    module = package_of(random_afloat(1, 1, loads=False))
    module.initialise(module.Params(), module.Input())
    for wrong in ({"base_mass": -50.0}, {"base_center_inertia_zz": -50.0}):
        with pytest.raises(ArithmeticError):
            module.initialise(module.Params(**wrong), module.Input())


def loaded(arm: SpatialArm) -> tuple[Any, Any]:
    exported = mujoco_model(replace(HEADED, spatial=arm))
    model = mujoco.MjModel.from_xml_string(exported.text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.keyframe(KEYFRAME).id)
    return model, data


def test_reference_moves_as_mujoco() -> None:
    """By its RK4 at small steps, tumbling and under constant loads."""
    arm = random_afloat(2, 3)
    model, data = loaded(arm)
    model.opt.timestep = 1e-4
    inputs = random_inputs(arm, 2)
    for name, value in inputs.items():
        data.actuator(name).ctrl = value
    for _ in range(1000):
        mujoco.mj_step(model, data)
    y = motion(arm, {name: Constant(value) for name, value in inputs.items()}, np.array([0.1]))[0][0]
    turn = data.qpos[3:7] * np.sign(data.qpos[3:7] @ y[3:7])
    assert np.abs(np.concatenate([data.qpos[:3], turn, data.qpos[7:]]) - y).max() < 1e-10


@pytest.mark.parametrize("seed", range(6))
def test_reference_accelerates_as_mujoco(seed: int) -> None:
    arm = random_afloat(seed, 5)
    model, data = loaded(arm)
    world, (y, u) = AfloatArm(arm), AfloatArm(arm).start()
    turn = data.qpos[3:7].copy()
    sign = 1.0 if turn @ y[3:7] > 0.0 else -1.0
    assert np.allclose([*data.qpos[:3], *(sign * turn), *data.qpos[7:]], y, atol=1e-14)
    turning = 0.5 * product(sign * turn, np.array([0.0, *data.qvel[3:6]]))
    assert np.allclose([*data.qvel[:3], *turning, *data.qvel[6:]], u, atol=1e-14)
    inputs = random_inputs(arm, seed)
    for name, value in inputs.items():
        data.actuator(name).ctrl = value
    mujoco.mj_forward(model, data)
    b = world.forward_dynamics(y, u, inputs)
    carrier = world.carrier(y, u, b)
    found = np.concatenate([b[:3], carrier.axes.T @ carrier.spinning, b[7:]])
    assert np.abs(found - data.qacc).max() < 1e-12 * np.abs(data.qacc).max()
