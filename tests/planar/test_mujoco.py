"""The same arm in MuJoCo: hinges with springs and dampers, no contact, a small step.

MuJoCo (Todorov, Erez & Tassa 2012, IROS) integrates joint angles relative to each other, by the composite-rigid-body
algorithm; here with RK4 and steps of 5e-5 s. Agreed tolerance: the tip of a 1 m arm within 1e-6 m over half a second,
against `sdirk4` at 1 ms, and converging with the fourth power of our step.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree as Xml

import mujoco
import numpy as np
import pytest

from tmm_gen.scene import Scene

pytestmark = pytest.mark.compiler

STEP = 5e-5
UNTIL = 0.5
TOLERANCE = 1e-6


def model_of(scene: Scene) -> str:
    """Write a planar scene as MJCF: the arm in the x-y plane, turning about z."""
    root = Xml.Element("mujoco")
    Xml.SubElement(root, "compiler", angle="radian", inertiafromgeom="false", autolimits="true")
    Xml.SubElement(
        root,
        "option",
        timestep=repr(STEP),
        gravity=f"0 {-(scene.model.gravity or 0.0)!r} 0",
        integrator="RK4",
    )
    place, parent = 0.0, Xml.SubElement(root, "worldbody")
    if scene.base.kind == "motor":
        parent = Xml.SubElement(parent, "body", name="hub")
        Xml.SubElement(
            parent, "joint", name="hub", type="hinge", axis="0 0 1", damping=repr(scene.base.damping)
        )
        _inertial(parent, 1.0, 0.0, scene.base.inertia)  # turns about a fixed point: any mass will do
    for number, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True), start=1):
        parent = Xml.SubElement(parent, "body", name=f"link{number}", pos=f"{place!r} 0 0")
        Xml.SubElement(
            parent,
            "joint",
            name=f"joint{number}",
            type="hinge",
            axis="0 0 1",
            stiffness=repr(joint.stiffness),
            damping=repr(joint.damping),
        )
        _inertial(parent, link.mass, link.center * link.length, link.inertia)
        place = link.length
    tip = Xml.SubElement(parent, "body", name="tip", pos=f"{place!r} 0 0")
    body = scene.tip
    _inertial(tip, body.mass if body else 1e-9, 0.0, body.inertia if body and body.inertia else 1e-12)
    return Xml.tostring(root, encoding="unicode")


def _inertial(parent: Xml.Element, mass: float, along: float, inertia: float) -> None:
    # a plane figure: the other two moments are out of play, and their sum must not be less than the third
    Xml.SubElement(
        parent,
        "inertial",
        mass=repr(mass),
        pos=f"{along!r} 0 0",
        diaginertia=f"{inertia!r} {inertia!r} {inertia!r}",
    )


def simulated(scene: Scene, times: np.ndarray, torque: float = 0.0) -> np.ndarray:
    """Return the tip's place at instants, (k, 2)."""
    model = mujoco.MjModel.from_xml_string(model_of(scene))
    data = mujoco.MjData(model)
    angles, rates = (np.array(x) for x in (scene.initial.angles, scene.initial.rates))
    hub = [0.0] * (scene.base.kind == "motor")
    data.qpos[:] = np.diff([*hub, *angles], prepend=0.0)
    data.qvel[:] = np.diff([*hub, *rates], prepend=0.0)
    tip = model.body("tip").id
    places = []
    done = 0
    for time in times:
        steps = round(time / STEP)
        if hub:
            data.qfrc_applied[0] = torque
        mujoco.mj_step(model, data, nstep=steps - done)
        mujoco.mj_kinematics(model, data)
        places.append(data.xpos[tip, :2].copy())
        done = steps
    return np.array(places)


TIMES = np.linspace(0.05, UNTIL, 10)


def ours(kernel: Any, step: float, inputs: dict[str, float]) -> np.ndarray:
    _, found = kernel.simulate(UNTIL, inputs, step=step)
    stride = round(0.05 / step)
    return np.column_stack([found[name][stride::stride] for name in found if name.startswith("tip_")])


@pytest.fixture(scope="module")
def tip_only() -> Callable[[Scene], Scene]:
    return lambda scene: scene.replace(
        output=[{"name": "tip", "at": "tip", "of": "position"}], **{"integrator.name": "sdirk4"}
    )


def test_the_falling_arm_is_mujocos(falling: Callable[..., Scene], compiled: Any, tip_only: Any) -> None:
    scene = tip_only(falling(5))
    theirs = simulated(scene, TIMES)
    assert np.max(np.abs(ours(compiled(scene), 1e-3, {}) - theirs)) < TOLERANCE


def test_unlike_links_on_a_driven_hub_are_mujocos(
    unlike: Callable[..., Scene], compiled: Any, tip_only: Any
) -> None:
    scene = tip_only(unlike("motor"))
    torque = 3.0
    theirs = simulated(scene, TIMES, torque)
    kernel = compiled(scene)
    errors = [np.max(np.abs(ours(kernel, h, {"hub": torque}) - theirs)) for h in (1e-2, 5e-3, 1e-3)]
    assert errors[-1] < TOLERANCE
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.5)
