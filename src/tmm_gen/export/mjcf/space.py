"""Arms in space in MJCF: a hinge for every joint, beam cells among them, with springs, dampers and rotors."""

from __future__ import annotations

from xml.etree import ElementTree as Xml

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from tmm_gen.errors import UserError
from tmm_gen.export.mjcf.bodies import text_of
from tmm_gen.export.mjcf.space_hinges import Hinge, placed_bodies
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import Revolute, RigidBody, SpatialArm, Turn

_LIGHT = 2e-15
"""kg and kg m^2 of bodies that have none: MuJoCo wants more than 1e-15 of everything that moves.

Rods of beams that do not twist have none about their own axis."""

_LEAST = 2e-14
"""kg m^2; smaller principal moments are refused where there are products of inertia."""

_ROUNDING = 1e-13
"""Of the largest principal moment: what its own rounding may take off the others."""

_DRAWN = 0.02
"""Radius of what is drawn, over the reach of the arm."""


BASE_BODY = "base"
"""What a base that floats is called, and its joint."""


def add_arm(world: Xml.Element, scene: Scene, arm: SpatialArm) -> dict[int, Xml.Element]:
    """Add the bodies of an arm.

    Parameters
    ----------
    world : Element
        What they hang in, in the axes of the base.
    scene : Scene
        What is exported.
    arm : SpatialArm
        Its arm.

    Returns
    -------
    dict of int to Element
        The base by 0, and bodies by the numbers of the joints that carry them.

    Raises
    ------
    UserError
        If a body's inertia is one that MuJoCo refuses.
    """
    size = _DRAWN * max(scene.reach, 1e-3)
    bodies = {0: _add_base(world, scene, arm, size)}
    for number, placed in placed_bodies(arm).items():
        joint, host = arm.joints[number - 1], bodies[placed.host]
        body = Xml.SubElement(host, "body", name=_body_name(joint), pos=text_of(*placed.at))
        if not np.array_equal(placed.turn, np.eye(3)):
            body.set("quat", quaternion_text(placed.turn))
        for hinge in placed.hinges:
            _add_hinge(body, hinge)
        _add_inertial(body, joint.body, joint.name, scene)
        if placed.at.any():
            way = {"type": "capsule", "size": f"{size / 2:.4g}", "fromto": text_of(0, 0, 0, *placed.at)}
            Xml.SubElement(host, "geom", way)
        if joint.body.mass:
            Xml.SubElement(body, "geom", type="sphere", size=f"{size:.4g}", pos=text_of(*joint.body.center))
        bodies[number] = body
    return bodies


def _add_base(world: Xml.Element, scene: Scene, arm: SpatialArm, size: float) -> Xml.Element:
    """Add what the arm stands on: ground, or a body that floats."""
    if arm.base is None:
        return Xml.SubElement(world, "body", name="ground")
    body = Xml.SubElement(world, "body", name=BASE_BODY)
    Xml.SubElement(body, "freejoint", name=BASE_BODY)
    _add_inertial(body, arm.base.body, "the base", scene)
    Xml.SubElement(body, "geom", type="sphere", size=f"{2 * size:.4g}", pos=text_of(*arm.base.body.center))
    return body


def start_text(arm: SpatialArm) -> tuple[str, str]:
    """Return positions and velocities at the start, as MuJoCo has them: of a base that floats first."""
    place: list[float] = []
    moving: list[float] = []
    if arm.base is not None:
        x, y, z, w = Rotation.from_matrix(np.array(arm.base.turn)).as_quat()
        place, moving = [*arm.base.at, w, x, y, z], [*arm.base.velocity, *arm.base.rate]
    angles, rates = ([getattr(joint, key) for joint in arm.joints] for key in ("angle", "rate"))
    return text_of(*place, *angles), text_of(*moving, *rates)


def quaternion_text(turn: Turn | NDArray[np.float64]) -> str:
    """Return a turn as MuJoCo has it: w, x, y, z."""
    x, y, z, w = Rotation.from_matrix(np.array(turn)).as_quat()
    return text_of(w, x, y, z)


def _body_name(joint: Revolute) -> str:
    return f"{joint.name}_body" if joint.name in ("world", "ground", BASE_BODY) else joint.name


def _add_hinge(body: Xml.Element, hinge: Hinge) -> None:
    joint = hinge.joint
    element = Xml.SubElement(
        body,
        "joint",
        name=joint.name,
        type="hinge",
        axis=text_of(*hinge.axis),
        stiffness=text_of(joint.stiffness),
        damping=text_of(joint.damping),
    )
    if hinge.at.any():
        element.set("pos", text_of(*hinge.at))
    if joint.armature:
        element.set("armature", text_of(joint.armature))
    if joint.rest:
        element.set("springref", text_of(joint.rest))


def _add_inertial(body: Xml.Element, given: RigidBody, name: str, scene: Scene) -> None:
    inertia = _inertia(given)
    low, middle, high = np.linalg.eigvalsh(inertia)
    if high > (low + middle) * (1.0 + 1e-9):
        raise UserError(
            f"{scene.source.origin}: what '{name}' carries has principal moments of inertia {low:g}, {middle:g} "
            f"and {high:g} kg m^2: one exceeds the sum of the others, which MuJoCo refuses. Correct the inertia of "
            "what hangs on it, or use --to urdf."
        )
    element = Xml.SubElement(body, "inertial", mass=text_of(given.mass or _LIGHT), pos=text_of(*given.center))
    if not any(given.inertia[3:]):
        element.set("diaginertia", text_of(*(max(moment, _LIGHT) for moment in given.inertia[:3])))
        return
    least = max(_LEAST, _ROUNDING * float(high))
    if low < least:
        inertia += least * np.eye(3)
    xx, yy, zz, xy, xz, yz = (inertia[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
    element.set("fullinertia", text_of(xx, yy, zz, xy, xz, yz))


def _inertia(body: RigidBody) -> NDArray[np.float64]:
    xx, yy, zz, xy, xz, yz = body.inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
