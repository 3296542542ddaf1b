"""Exported models, loaded and simulated by MuJoCo, move as the kernel does; every output is read off the sensors.

MuJoCo integrates relative angles with RK4 by the composite-rigid-body algorithm. Agreed tolerance: places within
1e-7 m of `sdirk4` at the scene's step, other outputs relative to their largest.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.export.mjcf import KEYFRAME, MujocoModel, mujoco_model
from tmm_gen.scene import Scene, parse_scene

pytestmark = pytest.mark.compiler

METRES = 1e-7


def accurate(scene: Scene) -> Scene:
    return scene.replace(**{"integrator.name": "sdirk4"})


def loaded(exported: MujocoModel) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(exported.text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.keyframe(KEYFRAME).id)
    return model, data


def compare(
    scene: Scene, kernel: Any, inputs: dict[str, float], until: float, step: float
) -> dict[str, float]:
    """Return by output the largest difference over the largest value, both over all instants."""
    exported = mujoco_model(scene)
    model, data = loaded(exported)
    times, ours = kernel.simulate(until, inputs, step=step)
    assert {reading.name for reading in exported.readings} <= set(ours)
    for name, value in inputs.items():
        data.actuator(name).ctrl = value
    stride = round(step / exported.timestep)
    assert stride * exported.timestep == pytest.approx(step, rel=1e-12)
    theirs: dict[str, list[float]] = {reading.name: [] for reading in exported.readings}
    for k in range(len(times)):
        if k:
            mujoco.mj_step(model, data, nstep=stride)
        mujoco.mj_forward(model, data)
        for reading in exported.readings:
            theirs[reading.name].append(reading.value(lambda sensor: data.sensor(sensor).data))
    return {
        name: float(np.max(np.abs(np.array(values) - ours[name])) / np.max(np.abs(ours[name])))
        for name, values in theirs.items()
    }


@pytest.mark.parametrize(
    ("name", "inputs"),
    [("arm10", {"hub_torque": 4.0, "tip_force": -0.5}), ("arm2", {"hub_torque": 6.0})],
)
def test_committed_arms(name: str, inputs: dict[str, float], scene_named: Any, direct: Any) -> None:
    scene = accurate(scene_named(name))
    found = compare(scene, direct(scene), inputs, 0.3, scene.integrator.step)
    assert found.pop("tip_x") < METRES  # the largest is the arm's length, 1 m or 0.8 m
    assert found.pop("tip_y") < METRES
    assert max(found.values()) < 1e-5
    assert found


@pytest.mark.parametrize(
    ("name", "inputs", "until", "step"),
    [
        ("thesis10", {"tip_torque": 1.0}, 2.0, 1e-2),
        ("drivetrain", {"motor_torque": 5.0, "load_torque": -3.0}, 0.02, 1e-5),
    ],
)
def test_committed_chains(
    name: str, inputs: dict[str, float], until: float, step: float, scene_named: Any, direct: Any
) -> None:
    # the stiff teeth of the drive make the error of the method, not of the export, seen at the scene's step
    scene = accurate(scene_named(name)).replace(**{"integrator.step": step})
    assert max(compare(scene, direct(scene), inputs, until, step).values()) < 1e-6


UNLIKE = """
name = "unlike"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "sdirk4"
step = 5e-4
[base]
kind = "{base}"
{hub}
[[joint]]
stiffness = 30.0
damping = 0.1
[[link]]
mass = 0.8
length = 0.3
inertia = 0.01
center = 0.3
[[joint]]
stiffness = 20.0
[[link]]
mass = 0.4
length = 0.2
inertia = 0.004
center = 0.8
[tip]
mass = 0.3
inertia = 0.002
[initial]
angles = [0.3, -0.2]
rates = [-1.0, 2.0]
[[output]]
name = "tip"
at = "tip"
of = "position"
"""

MOTIONS = ("position", "angle", "rate", "velocity", "acceleration")


def with_signals(scene: Scene, inputs: list[tuple[object, str]], outputs: list[tuple[object, str]]) -> Scene:
    return scene.replace(
        input=[{"name": f"{acts}_at_{at}", "at": at, "acts": acts} for at, acts in inputs],
        output=[{"name": f"{of}_of_{at}", "at": at, "of": of} for at, of in outputs],
    )


@pytest.fixture(scope="module", params=["clamp", "motor"])
def unlike(request: pytest.FixtureRequest) -> Scene:
    hub = "inertia = 0.05\ndamping = 0.2" if request.param == "motor" else ""
    return parse_scene(UNLIKE.format(base=request.param, hub=hub))


def test_every_kind_of_load_and_motion(unlike: Scene, direct: Any) -> None:
    motor = unlike.base.kind == "motor"
    loads: list[tuple[object, str]] = [("tip", "force_x"), ("tip", "torque"), (1, "force_y"), (1, "torque")]
    outputs: list[tuple[object, str]] = [(at, of) for at in (1, "tip") for of in MOTIONS]
    outputs += [(1, "torque"), (2, "torque"), ("base", "torque"), *([("base", "angle")] if motor else [])]
    scene = with_signals(unlike, loads + [("base", "torque")] * motor, outputs)
    inputs = {item.name: 0.3 + 0.4 * k for k, item in enumerate(scene.inputs)}
    found = compare(scene, direct(scene), inputs, 0.3, 5e-4)
    assert len(found) == 2 * (3 * 2 + 2) + 3 + motor
    assert max(found.values()) < 1e-6


def test_force_on_the_ground_and_energy(unlike: Scene, direct: Any) -> None:
    outputs: list[tuple[object, str]] = [
        ("base", "force"),
        ("arm", "kinetic_energy"),
        ("arm", "elastic_energy"),
    ]
    scene = with_signals(unlike, [("tip", "torque"), (1, "torque")], outputs)
    found = compare(scene, direct(scene), {"torque_at_tip": 0.3, "torque_at_1": -0.2}, 0.3, 5e-4)
    assert set(found) == {"force_of_base_x", "force_of_base_y", "kinetic_energy_of_arm"}
    assert max(found.values()) < 1e-6
    (left_out,) = mujoco_model(scene).left_out
    assert left_out.startswith("elastic_energy_of_arm: ")


def test_what_mujoco_cannot_measure_is_left_out_and_said(unlike: Scene) -> None:
    scene = with_signals(unlike, [("tip", "force_x")], [("base", "force"), (2, "force"), ("tip", "torque")])
    exported = mujoco_model(scene)
    assert [line.partition(":")[0] for line in exported.left_out] == [item.name for item in scene.outputs]
    assert exported.readings == ()
    assert all(line in exported.text for line in exported.left_out)
    loaded(exported)


def test_the_keyframe_is_the_start(unlike: Scene) -> None:
    _, data = loaded(mujoco_model(unlike))
    hub = [0.0] * (unlike.base.kind == "motor")
    np.testing.assert_allclose(np.cumsum(data.qpos), [*hub, 0.3, -0.2], atol=1e-15)
    np.testing.assert_allclose(np.cumsum(data.qvel), [*hub, -1.0, 2.0], atol=1e-15)


def test_the_step_is_stable_for_the_stiffest_mode(
    scene_named: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # MuJoCo writes a log where it stands when it warns
    stiff = scene_named("arm10").replace(**{"beam.bending_stiffness": 3200.0, "integrator.step": 1e-3})
    exported = mujoco_model(stiff)
    assert exported.timestep < 1e-6
    model, data = loaded(exported)
    data.actuator("hub_torque").ctrl = 4.0
    mujoco.mj_step(model, data, nstep=2000)
    assert np.max(np.abs(data.qvel)) < 10.0
    model.opt.timestep = 6.0 * exported.timestep  # so much more is too much
    mujoco.mj_resetDataKeyframe(model, data, 0)
    data.actuator("hub_torque").ctrl = 4.0
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    mujoco.mj_step(model, data, nstep=2000)
    assert not np.max(np.abs(data.qvel)) < 10.0


def test_a_prescribed_base_is_refused(scene_named: Any) -> None:
    with pytest.raises(UserError, match=r"prescribed.*--to fmu"):
        mujoco_model(scene_named("arm50"))
