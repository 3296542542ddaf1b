"""The same arm in MuJoCo, which knows nothing of transfer matrices, converges to ours."""

from __future__ import annotations

import mujoco
import numpy as np

from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene

TOLERANCE = 1e-7
"""Agreed distance of the tips, m, on an arm of 1 m: MuJoCo by RK4 at 0.1 ms against sdirk4 at 1 ms."""

SCENE = """
    name = "swing"
    [model]
    kind = "planar"
    gravity = 9.81
    [integrator]
    name = "sdirk4"
    step = 1e-3
    [base]
    kind = "motor"
    inertia = 0.05
    damping = 0.02
    [beam]
    length = 1.0
    bending_stiffness = 3.0
    mass_per_length = 0.5
    links = 4
    damping_time = 0.002
    [tip]
    mass = 0.1
    inertia = 1e-3
    [[input]]
    name = "hub_torque"
    at = "base"
    acts = "torque"
    [[output]]
    name = "tip"
    at = "tip"
    of = "position"
"""


def as_mjcf(scene: Scene) -> str:
    """Write the arm as bodies and hinges; angles of hinges are relative, stiffness and damping act on them."""
    tip = scene.tip
    assert tip is not None
    bodies, ends = "", ""
    for number, (link, joint) in enumerate(zip(scene.links, scene.joints, strict=True)):
        at = f"{scene.links[number - 1].length} 0 0" if number else "0 0 0"
        bodies += (
            f'<body name="link{number}" pos="{at}">'
            f'<joint type="hinge" axis="0 0 1" stiffness="{joint.stiffness!r}" damping="{joint.damping!r}"/>'
            f'<inertial pos="{link.center * link.length!r} 0 0" mass="{link.mass!r}" '
            f'diaginertia="{link.inertia!r} {link.inertia!r} {link.inertia!r}"/>'
        )
        ends += "</body>"
    last = scene.links[-1].length
    inertia = f"{tip.inertia!r} {tip.inertia!r} {tip.inertia!r}"
    bodies += f'<body name="tip" pos="{last} 0 0"><inertial pos="0 0 0" mass="{tip.mass!r}" diaginertia="{inertia}"/></body>'
    hub = scene.base
    return f"""
        <mujoco>
          <compiler angle="radian"/>
          <option timestep="1e-4" integrator="RK4" gravity="0 {-(scene.model.gravity or 0.0)!r} 0">
            <flag contact="disable" constraint="disable"/>
          </option>
          <worldbody>
            <body name="hub">
              <joint name="motor" type="hinge" axis="0 0 1" damping="{hub.damping!r}" armature="{hub.inertia!r}"/>
              <inertial pos="0 0 0" mass="1e-9" diaginertia="1e-12 1e-12 1e-12"/>
              {bodies}{ends}
            </body>
          </worldbody>
          <actuator><motor joint="motor"/></actuator>
        </mujoco>
    """


def test_mujoco_converges_to_ours() -> None:
    scene = parse_scene(SCENE)
    torque, duration = 4.0, 0.5
    model = mujoco.MjModel.from_xml_string(as_mjcf(scene))
    data = mujoco.MjData(model)
    data.ctrl[0] = torque
    for _ in range(round(duration / model.opt.timestep)):
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    theirs = data.body("tip").xpos[:2]
    kernel = compile_kernel(build_program(scene), scene)
    _, outputs = kernel.simulate(duration, {"hub_torque": torque})
    ours = np.array([outputs["tip_x"][-1], outputs["tip_y"][-1]])
    assert np.linalg.norm(ours - [1.0, 0.0]) > 0.1  # it has moved
    assert np.linalg.norm(ours - theirs) < TOLERANCE, (ours, theirs)
