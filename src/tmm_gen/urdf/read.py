"""From a URDF file to the robot it says."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path
from typing import TypeVar, get_args

from tmm_gen.scene.table import closest
from tmm_gen.urdf.attributes import Reader
from tmm_gen.urdf.content import content_of
from tmm_gen.urdf.faults import Faults
from tmm_gen.urdf.markup import Element, read_markup
from tmm_gen.urdf.placement import Vector
from tmm_gen.urdf.robot import KINDS, Inertial, Kind, Robot, RobotJoint, RobotLink

_OF_LINKS = ("inertial", "visual", "collision")
_OF_JOINTS = (
    "parent",
    "child",
    "origin",
    "axis",
    "limit",
    "dynamics",
    "mimic",
    "calibration",
    "safety_controller",
)
_OF_ROBOTS = ("link", "joint", "material", "transmission", "gazebo")
_PRODUCTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_Named = TypeVar("_Named", RobotLink, RobotJoint)


def read_robot(path: Path) -> Robot:
    """Read a URDF file; one in xacro is expanded if the package `xacro` is there.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Robot
        What it says, each element by itself; whether links and joints make a tree is not asked here.

    Raises
    ------
    UrdfError
        If the file cannot be read or an element is at fault; all of them are named.
    """
    content, origin = content_of(path)
    faults = Faults(origin)
    root = read_markup(content, origin)
    if root.tag != "robot":
        remedy = "Name a URDF file: its outermost element is <robot name=...>."
        faults.add(root.line, f"<{root.tag}>", "is no <robot>", remedy)
        faults.settle()
    _refuse_xacro(root, faults)
    name = root.attributes.get("name", "").strip() or path.name.partition(".")[0]
    Reader(faults, f"robot '{name}'").misspelt(root, _OF_ROBOTS)
    links: dict[str, RobotLink] = {}
    joints: dict[str, RobotJoint] = {}
    notes: list[str] = []
    if not root.attributes.get("name", "").strip():
        notes.append("the robot has no name: it is called after its file")
    for element in root.children:
        if element.tag == "link":
            _keep(links, _link(element, faults, notes), "link", faults)
        elif element.tag == "joint":
            _keep(joints, _joint(element, faults, notes), "joint", faults)
    if not links and not faults.found:
        faults.add(root.line, f"robot '{name}'", "has no <link>", "Name a file that holds the links.")
    faults.settle()
    return Robot(name, origin, links, joints, (*_passed_over(root), *notes))


def _keep(found: dict[str, _Named], item: _Named, what: str, faults: Faults) -> None:
    if item.name in found:
        faults.add(
            item.line,
            f"{what} '{item.name}'",
            f"is there twice, first on line {found[item.name].line}",
            "Give each a name of its own.",
        )
    elif item.name:
        found[item.name] = item


def _refuse_xacro(root: Element, faults: Faults) -> None:
    for element in root.walk():
        if element.tag.startswith("xacro:"):
            faults.add(
                element.line,
                f"<{element.tag}>",
                "is xacro, not URDF",
                "End the file's name in .xacro, or expand it by `xacro FILE > robot.urdf`.",
            )
            faults.settle()


def _link(element: Element, faults: Faults, notes: list[str]) -> RobotLink:
    name = Reader(faults, "").text(element, "name", "forearm")
    reader = Reader(faults, f"link '{name}'", notes)
    reader.misspelt(element, _OF_LINKS)
    inertial = reader.only(element, "inertial")
    return RobotLink(name, element.line, None if inertial is None else _inertial(inertial, reader))


def _inertial(element: Element, reader: Reader) -> Inertial:
    reader.misspelt(element, ("origin", "mass", "inertia"))
    mass_element, inertia_element = reader.only(element, "mass"), reader.only(element, "inertia")
    mass, numbers = 0.0, [0.0] * 6
    if mass_element is not None:
        reader.known(mass_element, ("value",))
        mass = reader.number(mass_element, "value", least=0.0)
    if inertia_element is not None:
        reader.known(inertia_element, _PRODUCTS)
        numbers = [reader.number(inertia_element, key, 0.0) for key in _PRODUCTS]
        if missing := [key for key in _PRODUCTS[:3] if key not in inertia_element.attributes]:
            reader.text(inertia_element, missing[0], "0.01")
    for tag, found, example in (
        ("mass", mass_element, '<mass value="1.0"/>'),
        ("inertia", inertia_element, '<inertia ixx="0.01" iyy="0.01" izz="0.01"/>'),
    ):
        if found is None:
            reader.faults.add(
                element.line, f"{reader.owner} <inertial>", f"has no <{tag}>", f"Add for example {example}."
            )
    ixx, iyy, izz, ixy, ixz, iyz = numbers
    inertia = (ixx, iyy, izz, ixy, ixz, iyz)
    line = element.line if inertia_element is None else inertia_element.line
    return Inertial(element.line, mass, reader.origin(element), inertia, line)


def _joint(element: Element, faults: Faults, notes: list[str]) -> RobotJoint:
    name = Reader(faults, "").text(element, "name", "elbow")
    reader = Reader(faults, f"joint '{name}'", notes)
    reader.misspelt(element, _OF_JOINTS)
    kind = reader.text(element, "type", "revolute")
    if kind and kind not in KINDS:
        faults.add(
            element.line, f"{reader.owner} type", "is no type of URDF", closest(kind, get_args(Kind)), kind
        )
    origin = reader.origin(element)
    parent, child = (_end(element, tag, reader) for tag in ("parent", "child"))
    axis = _axis(element, reader) if kind != "fixed" else (1.0, 0.0, 0.0)
    damping = friction = 0.0
    if (dynamics := reader.only(element, "dynamics")) is not None:
        reader.known(dynamics, ("damping", "friction"))
        damping, friction = (reader.number(dynamics, key, 0.0, 0.0) for key in ("damping", "friction"))
    limits, effort, velocity = _limits(element, reader, kind)
    mimic = reader.only(element, "mimic")
    return RobotJoint(
        name,
        element.line,
        next((known for known in KINDS if known == kind), "fixed"),
        parent,
        child,
        origin,
        axis,
        limits,
        effort,
        velocity,
        damping,
        friction,
        None if mimic is None else mimic.attributes.get("joint", "?"),
    )


def _end(element: Element, tag: str, reader: Reader) -> str:
    found = reader.only(element, tag)
    if found is None:
        reader.faults.add(
            element.line, reader.owner, f"has no <{tag}>", f'Add for example <{tag} link="forearm"/>.'
        )
        return ""
    reader.known(found, ("link",))
    return reader.text(found, "link", "forearm")


def _axis(element: Element, reader: Reader) -> Vector:
    """Return the axis as a unit vector; x where none is written, as URDF has it."""
    found = reader.only(element, "axis")
    if found is None:
        return 1.0, 0.0, 0.0
    reader.known(found, ("xyz",))
    x, y, z = reader.vector(found, "xyz", (1.0, 0.0, 0.0))
    length = math.hypot(x, y, z)
    if length == 0.0 or not math.isfinite(length):
        reader.faults.add(
            found.line,
            f"{reader.owner} <axis xyz>",
            "has no direction",
            'Write for example xyz="0 0 1".',
            found.attributes["xyz"],
        )
        return 1.0, 0.0, 0.0
    if abs(length - 1.0) < 4e-16:  # a unit vector but for its rounding: as written
        return x, y, z
    return x / length, y / length, z / length


def _limits(
    element: Element, reader: Reader, kind: str
) -> tuple[tuple[float, float] | None, float | None, float | None]:
    found = reader.only(element, "limit")
    if found is None:
        return None, None, None
    effort, velocity = (reader.limit(found, key, least=0.0) for key in ("effort", "velocity"))
    # as URDF has it, what is not written is 0
    lower, upper = (
        reader.limit(found, key) if key in found.attributes else 0.0 for key in ("lower", "upper")
    )
    if lower is None or upper is None:
        return None, effort, velocity
    if lower > upper:
        reader.faults.add(
            found.line,
            f"{reader.owner} <limit>",
            f"has lower {lower:g} above upper {upper:g}",
            "Exchange them.",
        )
    return ((lower, upper) if kind == "revolute" else None), effort, velocity


def _passed_over(root: Element) -> tuple[str, ...]:
    """Say which elements are not of the mechanics, and how many there were."""
    counts = Counter(child.tag for child in root.children if child.tag not in ("link", "joint"))
    for part in root.children:
        known = {"link": ("inertial",), "joint": (*_OF_JOINTS[:7],)}.get(part.tag)
        if known is not None:
            counts.update(child.tag for child in part.children if child.tag not in known)
    if not counts:
        return ()
    said = ", ".join(f"<{tag}> ({count})" for tag, count in sorted(counts.items()))
    return (f"left out, not of the mechanics or not of URDF: {said}",)
