"""Links and joints of a robot as a tree from its root; what is none is refused."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tmm_gen.urdf.faults import Faults
from tmm_gen.urdf.flexibility import Flexibility
from tmm_gen.urdf.placement import Place, about
from tmm_gen.urdf.robot import TURNING, Robot, RobotJoint, RobotLink


@dataclass(frozen=True)
class RobotTree:
    """A robot whose links hang on each other.

    Parameters
    ----------
    robot : Robot
        As read.
    root : RobotLink
        That nothing carries.
    leaving : dict of str to tuple of RobotJoint
        By link, the joints on it in the order of the file: only such that turn, or are fixed.
    locked : dict of str to str
        By name of a joint that was locked, in words how.
    """

    robot: Robot
    root: RobotLink
    leaving: dict[str, tuple[RobotJoint, ...]]
    locked: dict[str, str]

    def outward(self) -> tuple[RobotLink, ...]:
        """Return the links, each after the one that carries it; a branch is whole before the next."""
        found, waiting = [], [self.root]
        while waiting:
            found.append(waiting.pop())
            on = self.leaving.get(found[-1].name, ())
            waiting += reversed([self.robot.links[joint.child] for joint in on])
        return tuple(found)


def tree_of(robot: Robot, flexibility: Flexibility) -> RobotTree:
    """Return the tree that a robot is.

    Raises
    ------
    UrdfError
        If it is none, or has joints that move in ways an arm's cannot.
    """
    faults, links = Faults(robot.file), robot.links
    locked: dict[str, str] = {}
    joints: list[RobotJoint] = []
    for joint in robot.joints.values():
        gives = flexibility.joints.get(joint.name)
        if gives is not None and gives.lock is not None:
            unit = "m" if joint.kind == "prismatic" else "rad"
            locked[joint.name] = f"{joint.kind} joint '{joint.name}' locked at {gives.lock:g} {unit}"
            joints.append(_locked(joint, gives.lock))
            continue
        _refuse_kind(joint, faults)
        joints.append(joint)
    carriers: dict[str, RobotJoint] = {}
    leaving: dict[str, tuple[RobotJoint, ...]] = {}
    for joint in joints:
        for end in (joint.parent, joint.child):
            if end not in links:
                remedy = f'Add <link name="{end}"/>, or correct the name.'
                faults.add(
                    joint.line, f"joint '{joint.name}'", f"names a link '{end}' that is not there", remedy
                )
        if (first := carriers.get(joint.child)) is not None:
            faults.add(
                joint.line,
                f"joint '{joint.name}'",
                f"carries link '{joint.child}', as joint '{first.name}' on line {first.line} does: a loop",
                "Cut it open: remove one of the two joints.",
            )
            continue
        carriers[joint.child] = joint
        leaving[joint.parent] = (*leaving.get(joint.parent, ()), joint)
    faults.settle()
    roots = [link for link in links.values() if link.name not in carriers]
    for link in roots[1:]:
        faults.add(
            link.line,
            f"link '{link.name}'",
            f"is carried by no joint, nor is link '{roots[0].name}' on line {roots[0].line}",
            f'Join it by <joint type="fixed"> to what it stands on, for example "{roots[0].name}", or remove it.',
        )
    if roots:
        tree = RobotTree(robot, roots[0], leaving, locked)
        reached = {link.name for link in tree.outward()}
    else:
        reached = set()
    if len(roots) < 2:
        _refuse_circles(robot, carriers, reached, faults)
    faults.settle()
    return tree


def _refuse_circles(robot: Robot, carriers: dict[str, RobotJoint], reached: set[str], faults: Faults) -> None:
    """Refuse links that carry each other in a circle, one joint of each circle."""
    seen = set(reached)
    for link in robot.links.values():
        way: list[str] = []
        name = link.name
        while name not in seen:
            seen.add(name)
            way.append(name)
            name = carriers[name].parent
        if name in way:
            joint = carriers[name]
            around = " -> ".join([*way[way.index(name) :], name])
            faults.add(
                joint.line,
                f"joint '{joint.name}'",
                f"closes a circle of links that carry each other: {around}",
                "Remove it, so that one link stands on the ground.",
            )


def _locked(joint: RobotJoint, at: float) -> RobotJoint:
    """Return a joint that stays where it is as a fixed one."""
    axis = np.array(joint.axis)
    slid, turn = (at * axis, np.eye(3)) if joint.kind == "prismatic" else (np.zeros(3), about(axis, at))
    inner = Place(slid, turn)
    return replace(joint, kind="fixed", origin=joint.origin @ inner, mimic=None)


def _refuse_kind(joint: RobotJoint, faults: Faults) -> None:
    """Refuse a joint that can move otherwise than about one axis by itself."""
    lock = f"lock it: `[joint.{_bare(joint.name)}]` with `lock = 0.0` in a file given by --flex"
    free = "; to let it move by itself, remove <mimic>" if joint.kind in TURNING else ""
    if joint.mimic is not None and joint.kind != "fixed":
        faults.add(
            joint.line,
            f"joint '{joint.name}' <mimic>",
            "ties it to another joint, and every joint here moves by itself",
            f"To keep it in place, {lock}{free}.",
            joint.mimic,
        )
    elif joint.kind == "prismatic":
        faults.add(
            joint.line,
            f"joint '{joint.name}' type",
            "slides, and arms have joints that turn",
            f"To keep it in place, {lock}.",
            joint.kind,
        )
    elif joint.kind != "fixed" and joint.kind not in TURNING:
        faults.add(
            joint.line,
            f"joint '{joint.name}' type",
            "moves in several ways, and arms stand on a base that is clamped",
            'To keep it in place, write type="fixed".',
            joint.kind,
        )


def _bare(name: str) -> str:
    """Return a name as a key of TOML."""
    plain = name.isascii() and name.replace("_", "").replace("-", "").isalnum()
    return name if plain else '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
