"""An arm in space as URDF: what that can hold, and in comments what it cannot."""

from __future__ import annotations

from dataclasses import dataclass
from xml.etree import ElementTree as Xml

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import UPRIGHT, ZERO, Frame, Revolute, RigidBody, SpatialArm, Turn, Vector
from tmm_gen.urdf.placement import angles_of
from tmm_gen.version import __version__

_UNLIMITED = "1e9"
"""Effort and velocity of joints with limits: URDF wants both, a scene has neither."""


@dataclass(frozen=True)
class UrdfModel:
    """A model in URDF.

    Parameters
    ----------
    text : str
        The file.
    joints, links : int
        How many it has.
    left_out : tuple of str
        What URDF cannot hold, in words.
    """

    text: str
    joints: int
    links: int
    left_out: tuple[str, ...]


def urdf_model(scene: Scene) -> UrdfModel:
    """Return an arm in space as URDF.

    Every joint becomes one that turns, those of a beam's cells among them, and its body a link; what outputs are read
    of becomes a link without mass on a fixed joint. Springs, rotors, gears and gravity are told in comments.

    Parameters
    ----------
    scene : Scene
        Of kind "spatial".

    Raises
    ------
    UserError
        If it is of another kind.
    """
    arm = scene.spatial
    if arm is None:
        raise UserError(
            f"{scene.source.origin}: only arms in space can be URDF, and this is a {scene.model.kind} scene. "
            "Use --to mjcf, or --to fmu."
        )
    root = Xml.Element("robot", name=scene.name)
    names = _link_names(arm)
    base = Xml.SubElement(root, "link", name=names[0])
    if arm.base is not None:
        _add_inertial(base, arm.base.body)
    for number, joint in enumerate(arm.joints, start=1):
        _add_joint(root, joint, names[joint.host], names[number])
        link = Xml.SubElement(root, "link", name=names[number])
        _add_inertial(link, joint.body)
    for name, frame in _frames(arm, set(names)).items():
        fixed = Xml.SubElement(root, "joint", name=f"{name}_fixed", type="fixed")
        _add_ends(fixed, names[frame.joint], name, frame.at, frame.turn)
        Xml.SubElement(root, "link", name=name)
    left_out = _left_out(arm)
    Xml.indent(root, "  ")
    lines = [
        f"{scene.name}: {scene.title}",
        f"scene digest: {scene.digest}",
        "",
        "Left out, as URDF cannot hold it:",
        *(f"  {reason}" for reason in left_out),
    ]
    said = "\n".join(f"  {line}".rstrip() for line in lines).replace("--", "- -")
    head = f"<!-- Written by tmm-gen, version {__version__}\n{said}\n-->\n"
    return UrdfModel(
        f"{head}{Xml.tostring(root, encoding='unicode')}\n",
        len(root.findall("joint")),
        len(root.findall("link")),
        tuple(left_out),
    )


def _link_names(arm: SpatialArm) -> list[str]:
    """Return what the base and the body of each joint are called, by the joint's number."""
    taken, names = {"base_link"}, ["base_link"]
    for joint in arm.joints:
        name = f"{joint.name}_link"
        while name in taken:
            name += "_"
        taken.add(name)
        names.append(name)
    return names


def _frames(arm: SpatialArm, taken: set[str]) -> dict[str, Frame]:
    """Return the frames that outputs are read of and that are no link's own, by a name that is free."""
    found: dict[str, Frame] = {}
    for output in arm.outputs:
        frame = output.frame
        if frame is None or frame in found.values() or (frame.at == ZERO and frame.turn == UPRIGHT):
            continue
        name = frame.name
        while name in taken:
            name += "_"
        taken.add(name)
        found[name] = frame
    return found


def _add_joint(root: Xml.Element, joint: Revolute, host: str, link: str) -> None:
    kind = "continuous" if joint.limits is None else "revolute"
    element = Xml.SubElement(root, "joint", name=joint.name, type=kind)
    _add_ends(element, host, link, joint.at, joint.turn)
    Xml.SubElement(element, "axis", xyz=_text(*np.eye(3)[joint.axis]))
    if joint.limits is not None:
        lower, upper = map(_text, joint.limits)
        Xml.SubElement(element, "limit", lower=lower, upper=upper, effort=_UNLIMITED, velocity=_UNLIMITED)
    if joint.damping:
        Xml.SubElement(element, "dynamics", damping=_text(joint.damping))


def _add_ends(element: Xml.Element, host: str, link: str, at: Vector, turn: Turn) -> None:
    Xml.SubElement(element, "parent", link=host)
    Xml.SubElement(element, "child", link=link)
    Xml.SubElement(element, "origin", xyz=_text(*at), rpy=_text(*angles_of(np.array(turn))))


def _add_inertial(link: Xml.Element, body: RigidBody) -> None:
    if not body.mass and not any(body.inertia):
        return
    inertial = Xml.SubElement(link, "inertial")
    Xml.SubElement(inertial, "origin", xyz=_text(*body.center))
    Xml.SubElement(inertial, "mass", value=_text(body.mass))
    keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    numbers = {key: _text(value) for key, value in zip(keys, body.inertia, strict=True)}
    Xml.SubElement(inertial, "inertia", numbers)


def _left_out(arm: SpatialArm) -> list[str]:
    """Say what URDF cannot hold; rotors and gears as a file for `tmm-gen import --flex` has them."""
    said = [f"gravity: {_text(*arm.gravity)} m/s^2 in the axes of base_link"] if any(arm.gravity) else []
    if arm.base is not None:
        said.append("that base_link floats, and where it is and how it moves at first")
    said += [f"that input '{j.given}' moves joint '{j.name}'" for j in arm.joints if j.given]
    if arm.inputs:
        said.append(f"inputs: {', '.join(item.name for item in arm.inputs)}")
    for joint in arm.joints:
        if joint.stiffness:
            rest = f", slack at {joint.rest:g} rad" if joint.rest else ""
            said.append(f"spring of joint '{joint.name}': {joint.stiffness!r} N m/rad{rest}")
        if joint.armature:
            rotor = joint.armature / joint.gear**2
            said.append(
                f"rotor of joint '{joint.name}', for --flex: [joint.{joint.name}] rotor_inertia = {rotor!r}, "
                f"gear = {joint.gear!r}"
            )
        if joint.angle or joint.rate:
            said.append(f"start of joint '{joint.name}': {joint.angle!r} rad, {joint.rate!r} rad/s")
    return said


def _text(*values: float) -> str:
    return " ".join(repr(float(value) + 0.0) for value in values)
