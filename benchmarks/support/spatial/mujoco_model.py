"""An arm in space as MuJoCo has it: a body for every joint, hinges with armature, damper and spring."""

from __future__ import annotations

from xml.etree import ElementTree as Xml

import numpy as np
from scipy.spatial.transform import Rotation

from tmm_gen.scene.spatial.arm import SpatialArm

LITTLE = 1e-14
"""kg and kg m^2 of bodies without mass, which MuJoCo does not have."""


def mjcf(arm: SpatialArm, step: float = 2e-5) -> str:
    """Return an arm as MJCF, without its inputs; gears are for whoever applies torques."""
    root = Xml.Element("mujoco")
    Xml.SubElement(root, "compiler", angle="radian", inertiafromgeom="false", balanceinertia="false")
    option = {"timestep": repr(step), "gravity": _text(arm.gravity), "integrator": "RK4"}
    Xml.SubElement(Xml.SubElement(root, "option", option), "flag", contact="disable")
    bodies = [Xml.SubElement(root, "worldbody")]
    for number, joint in enumerate(arm.joints, start=1):
        x, y, z, w = Rotation.from_matrix(joint.turn).as_quat()
        body = Xml.SubElement(
            bodies[joint.host], "body", name=f"b{number}", pos=_text(joint.at), quat=_text((w, x, y, z))
        )
        bodies.append(body)
        inertia = {"mass": repr(joint.body.mass or LITTLE), "pos": _text(joint.body.center)}
        values = joint.body.inertia if any(joint.body.inertia) else (LITTLE,) * 3 + (0.0,) * 3
        Xml.SubElement(body, "inertial", inertia, fullinertia=_text(values))
        keys = {
            "axis": _text(np.eye(3)[joint.axis]),
            "stiffness": repr(joint.stiffness),
            "damping": repr(joint.damping),
            "springref": repr(joint.rest),
            "armature": repr(joint.armature),
        }
        Xml.SubElement(body, "joint", keys, name=f"j{number}", type="hinge")
    return Xml.tostring(root, encoding="unicode")


def _text(values: object) -> str:
    return " ".join(repr(float(value)) for value in np.asarray(values, float))
