"""Arms by parts against MuJoCo, and their export to it."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np
import pytest

from tmm_gen.export.mjcf.model import mujoco_model
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene, parse_scene

mujoco = pytest.importorskip("mujoco")
pytestmark = pytest.mark.compiler

SCENES = Path(__file__).resolve().parents[2] / "scenes"
STEP, UNTIL = 5e-5, 0.2
MOTORS = {"shoulder_torque": 0.06, "elbow_torque": -0.02, "hinge_torque": 0.1}
TOLERANCE = 1e-6


def by_hand(scene: Scene) -> str:
    """Write the arm of the fixture as MJCF: armatures, motors with gears, a spring that is slack at an angle."""
    root = Xml.Element("mujoco")
    Xml.SubElement(root, "compiler", angle="radian", inertiafromgeom="false", autolimits="true")
    Xml.SubElement(root, "option", timestep=repr(STEP), gravity="0 -9.81 0", integrator="RK4")
    parent, place = Xml.SubElement(root, "worldbody"), 0.0
    # springs of the upper arm: EI/l between half a piece, a whole one and half a piece
    held = 14.0 / 0.25
    joints = [
        {"damping": 0.02, "armature": 100**2 * 2e-5},
        {"stiffness": held, "damping": 2e-3 * held},
        {"stiffness": held, "damping": 2e-3 * held},
        {"damping": 0.01, "armature": 50**2 * 1e-5},
        {"stiffness": 3.0, "springref": 0.2},
    ]
    rod = 0.16
    bodies = [(0.125, rod * 0.125, None, 0.5), (0.25, rod * 0.25, None, 0.5), (0.125, rod * 0.125, None, 0.5)]
    bodies += [(0.3, 0.2, 2e-3, 0.4), (0.1, 0.05, 1e-4, 0.5)]
    on_end = {2: (0.2, 1e-4), 4: (0.1, 1e-4)}
    for number, (joint, (length, mass, inertia, center)) in enumerate(zip(joints, bodies, strict=True)):
        parent = Xml.SubElement(parent, "body", name=f"b{number}", pos=f"{place!r} 0 0")
        keys = {key: repr(value) for key, value in joint.items()}
        Xml.SubElement(parent, "joint", keys, name=f"j{number}", type="hinge", axis="0 0 1")
        _inertial(parent, mass, center * length, mass * length**2 / 12 if inertia is None else inertia)
        if number in on_end:
            weight = Xml.SubElement(parent, "body", name=f"w{number}", pos=f"{length!r} 0 0")
            _inertial(weight, on_end[number][0], 0.0, on_end[number][1])
        place = length
    actuators = Xml.SubElement(root, "actuator")
    for name, joint, gear in (("shoulder_torque", 0, 100), ("elbow_torque", 3, 50), ("hinge_torque", 4, 1)):
        Xml.SubElement(actuators, "motor", name=name, joint=f"j{joint}", gear=str(gear))
    return Xml.tostring(root, encoding="unicode")


def _inertial(parent: Xml.Element, mass: float, along: float, inertia: float) -> None:
    Xml.SubElement(
        parent,
        "inertial",
        mass=repr(mass),
        pos=f"{along!r} 0 0",
        diaginertia=f"{inertia!r} {inertia!r} {inertia!r}",
    )


def ours(scene: Scene, step: float) -> np.ndarray:
    changed = scene.replace(**{"integrator.name": "sdirk4", "integrator.step": step})
    kernel = compile_kernel(build_program(changed), changed, flags=("-O1",))
    _, found = kernel.simulate(UNTIL, MOTORS, step=step)
    return np.array([found["tool_x"][-1], found["tool_y"][-1]])


def test_motors_with_gears_are_mujocos(elbow_text: str) -> None:
    scene = parse_scene(elbow_text)
    model = mujoco.MjModel.from_xml_string(by_hand(scene))
    data = mujoco.MjData(model)
    for name, torque in MOTORS.items():
        data.ctrl[model.actuator(name).id] = torque
    mujoco.mj_step(model, data, nstep=round(UNTIL / STEP))
    mujoco.mj_kinematics(model, data)
    theirs = data.xpos[model.body("w4").id, :2]
    assert np.abs(ours(scene, 1e-3) - theirs).max() < TOLERANCE


def test_the_exported_model_moves_alike(elbow_text: str) -> None:
    text = elbow_text + '\n[[output]]\nname = "bend"\nat = "elbow"\nof = "angle"\n'
    text += '\n[[output]]\nname = "through"\nat = "elbow"\nof = "torque"\n'
    scene = parse_scene(text)
    exported = mujoco_model(scene)
    assert 'name="elbow" type="hinge" axis="0 0 1"' in exported.text
    assert 'gear="50' in exported.text
    model = mujoco.MjModel.from_xml_string(exported.text)
    assert model.dof_armature[model.joint("shoulder").dofadr[0]] == pytest.approx(0.2)
    model.opt.timestep = STEP
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    acting = {**MOTORS, "push": 0.5}
    for name, torque in acting.items():
        data.ctrl[model.actuator(name).id] = torque
    mujoco.mj_step(model, data, nstep=round(UNTIL / STEP))
    mujoco.mj_forward(model, data)
    changed = scene.replace(**{"integrator.name": "sdirk4", "integrator.step": 1e-3})
    kernel = compile_kernel(build_program(changed), changed, flags=("-O1",))
    _, found = kernel.simulate(UNTIL, acting, step=1e-3)
    place = data.sensor("tool").data
    assert abs(found["tool_x"][-1] - place[0]) < TOLERANCE
    assert abs(found["tool_y"][-1] - place[1]) < TOLERANCE
    assert abs(found["bend"][-1] - data.sensor("bend").data[0]) < TOLERANCE
    through = next(reading for reading in exported.readings if reading.name == "through")
    theirs = through.constant + sum(f * data.sensor(name).data[k] for name, k, f in through.terms)
    assert abs(found["through"][-1] - theirs) < TOLERANCE * np.abs(found["through"]).max()


def test_a_tree_moves_alike() -> None:
    # few soft pieces: MuJoCo's explicit method cannot take stiff ones
    softer = {"beam.wrist.links": 2, "beam.wrist.damping_time": 1e-4}
    scene = load_scene(SCENES / "gripper.toml").replace(**softer)
    exported = mujoco_model(scene)
    model = mujoco.MjModel.from_xml_string(exported.text)
    model.opt.timestep = STEP
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    acting = {"left_torque": -0.004, "right_torque": 0.002}
    for name, torque in acting.items():
        data.ctrl[model.actuator(name).id] = torque
    mujoco.mj_step(model, data, nstep=round(UNTIL / STEP))
    mujoco.mj_forward(model, data)
    changed = scene.replace(**{"integrator.name": "sdirk4", "integrator.step": 1e-4})
    _, found = compile_kernel(build_program(changed), changed, flags=("-O1",)).simulate(
        UNTIL, acting, step=1e-4
    )
    for side in ("left", "right"):
        place = data.sensor(f"{side}_tip").data
        assert abs(found[f"{side}_tip_x"][-1] - place[0]) < TOLERANCE
        assert abs(found[f"{side}_tip_y"][-1] - place[1]) < TOLERANCE
        assert abs(found[side][-1] - data.sensor(side).data[0]) < TOLERANCE
