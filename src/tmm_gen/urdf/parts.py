"""From a robot's tree to the parts of a scene: motors, bodies and beams that hang on each other by name."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from tmm_gen.urdf.beams import BeamLine, beam_entry, beam_line
from tmm_gen.urdf.entries import Entry
from tmm_gen.urdf.faults import Faults
from tmm_gen.urdf.flexibility import Flexibility, JointGives
from tmm_gen.urdf.identifiers import Names
from tmm_gen.urdf.placement import Place
from tmm_gen.urdf.robot import RobotJoint, RobotLink
from tmm_gen.urdf.tree import RobotTree
from tmm_gen.urdf.weights import cannot_be, is_rounding, own_inertia, require_inertia, require_possible

PLACES = ("base", "arm", "tip")
"""Words that a scene has for places, which no part may be called by."""


@dataclass(frozen=True)
class Standing:
    """Where a link stands.

    Parameters
    ----------
    on : str
        Part whose outer end it is fixed to, or "base".
    place : Place
        Of the link's frame in the frame of that end.
    merged : tuple of str
        What was decided about the fixed joint it stands on, in words.
    """

    on: str
    place: Place
    merged: tuple[str, ...] = ()


@dataclass
class Parts:
    """The parts of a robot, made link by link.

    Parameters
    ----------
    tree : RobotTree
        The robot.
    flexibility : Flexibility
        What gives way in it.
    """

    tree: RobotTree
    flexibility: Flexibility
    entries: list[Entry] = field(default_factory=list)
    turning: list[tuple[RobotJoint, str]] = field(default_factory=list)
    gears: list[str] = field(default_factory=list)
    ends: list[tuple[RobotLink, str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def make(self) -> None:
        """Make them.

        Raises
        ------
        UrdfError
            If there is nothing that moves, nothing that resists, or a link cannot be a beam.
        """
        robot = self.tree.robot
        faults, of_sidecar = Faults(robot.file), Faults(self.flexibility.file)
        self._name()
        require_possible(self.tree, faults)
        require_inertia(self.tree, self.flexibility, faults)
        standing = {self.tree.root.name: Standing("base", Place.of())}
        for link in self.tree.outward():
            self._link(link, standing, of_sidecar)
        of_sidecar.settle()
        if not self.turning:
            root = self.tree.root
            remedy = "Make one of its joints revolute or continuous."
            faults.add(root.line, f"robot '{robot.name}'", "has no joint that turns", remedy)
        faults.settle()

    def _name(self) -> None:
        """Give every joint and link its name in the scene; joints first: they are what is driven and read."""
        names = Names(set(PLACES))
        robot = self.tree.robot
        turning = [
            j.name for link in robot.links for j in self.tree.leaving.get(link, ()) if j.kind != "fixed"
        ]
        self.joint_names = {name: names.take(name, "_joint") for name in turning}
        self.gear_names = {
            name: names.take(f"{self.joint_names[name]}_gear")
            for name, gives in self.flexibility.joints.items()
            if gives.stiffness is not None
        }
        self.link_names = {name: names.take(name, "_link") for name in robot.links}

    def _link(self, link: RobotLink, standing: dict[str, Standing], of_sidecar: Faults) -> None:
        here, leaving = standing[link.name], self.tree.leaving.get(link.name, ())
        line: BeamLine | None = None
        if (gives := self.flexibility.links.get(link.name)) is not None:
            line = beam_line(link, gives, leaving, of_sidecar)
        if line is not None and gives is not None:
            entry = beam_entry(link, gives, line, of_sidecar)
            end = self._hang(entry, self.link_names[link.name], here, line.turn)
            if not leaving:
                self.ends.append((link, end))
        else:
            end = self._rigid(link, here, bool(leaving))
        for joint in leaving:
            at_end = line is not None and line.nearer_end(joint)
            on, place = (end, line.beyond(joint)) if line and at_end else (here.on, here.place @ joint.origin)
            hung: tuple[str, ...] = ()
            if line is not None:
                where = "outer end" if at_end else "root"
                hung = (f"joint '{joint.name}' stands on the {where} of beam '{end}', rigidly",)
            if joint.kind == "fixed":
                fixed = self.tree.locked.get(joint.name, f"fixed joint '{joint.name}'")
                words = f"{fixed} merged into '{on}'"
                standing[joint.child] = Standing(on, place, (*hung, words))
            else:
                last = self._joint(joint, on, place, hung)
                standing[joint.child] = Standing(last, Place.of())

    def _rigid(self, link: RobotLink, here: Standing, carries: bool) -> str:
        """Put a rigid link where it stands, and note its frame if nothing is on it; return what it stands on."""
        inertial, name = link.inertial, self.link_names[link.name]
        weighs = inertial is not None and (inertial.mass > 0.0 or any(inertial.inertia))
        if here.on == "base":
            self.notes += here.merged
            said = ": its mass does nothing" if weighs else ""
            self.notes.append(f"link '{link.name}' is part of the clamped base{said}")
            return "base"
        if inertial is not None and weighs:
            entry = Entry("[[body]]", decisions=[f"link '{link.name}'"])
            inertia = own_inertia(inertial)
            if not np.array_equal(inertial.origin.turn, np.eye(3)):
                entry.decisions.append(
                    "inertia turned from the axes of its <inertial> into those of the link"
                )
            if cannot_be(inertia):
                entry.decisions.append(
                    "one principal moment exceeds the sum of the others: no real body has this inertia"
                )
            part = self._hang(entry, name, here)
            entry.put("mass", inertial.mass)
            if inertial.origin.at.any():
                entry.put("center", inertial.origin.at.tolist())
            if is_rounding(inertial):
                entry.decisions.append("inertia left out: it is what rounding left of zero")
            elif inertia.any():
                entry.put("inertia", _six(inertia))
        else:
            moves = here.place.at.any() or not np.array_equal(here.place.turn, np.eye(3))
            if not moves and (carries or not here.merged):
                part = here.on
                self.notes += [
                    *here.merged,
                    f"link '{link.name}' has no mass: it is the frame of '{here.on}'",
                ]
            elif carries:
                part = here.on
                self.notes += [*here.merged, f"link '{link.name}' has no mass and is left out"]
            else:
                entry = Entry("[[body]]", decisions=[f"link '{link.name}' has no mass: a frame to read"])
                part = self._hang(entry, name, here)
        if not carries:
            self.ends.append((link, part))
        return here.on

    def _hang(self, entry: Entry, name: str, here: Standing, turn: Place | None = None) -> str:
        """Say of a part what it hangs on and where; return its name."""
        place = here.place if turn is None else here.place @ turn
        entry.decisions += here.merged
        rest, entry.keys = entry.keys, {}
        entry.put("name", name)
        _put_place(entry, here.on, place)
        entry.keys |= rest
        self.entries.append(entry)
        return name

    def _joint(self, joint: RobotJoint, on: str, place: Place, hung: tuple[str, ...]) -> str:
        """Put a motor, and behind it the gear that gives way; return the name of the last."""
        gives = self.flexibility.joints.get(joint.name, JointGives(0))
        name = self.joint_names[joint.name]
        motor = Entry("[[motor]]", decisions=[*_said_of(joint), *hung])
        motor.put("name", name)
        _put_place(motor, on, place)
        motor.put("axis", axis_of(joint))
        if gives.rotor_inertia:
            motor.put("rotor_inertia", gives.rotor_inertia)
        if gives.gear != 1.0:
            motor.put("gear", gives.gear)
        damping = joint.damping
        if gives.stiffness is None and gives.damping is not None:
            damping = gives.damping
            if joint.damping:
                motor.decisions.append(
                    f"damping from {self.flexibility.file}, not {joint.damping:g} of the URDF"
                )
        if damping:
            motor.put("damping", damping)
        if joint.limits is not None and joint.limits[0] < joint.limits[1]:
            motor.put("limits", joint.limits)
        elif joint.kind == "revolute":
            motor.decisions.append("no limits: the URDF has none, one is infinite, or both are the same")
        self.entries.append(motor)
        self.turning.append((joint, name))
        if gives.stiffness is None:
            return name
        gear = Entry("[[joint]]", decisions=[f"the gear of '{name}' gives way, by {self.flexibility.file}"])
        gear.put("name", self.gear_names[joint.name])
        gear.put("on", name)
        gear.put("axis", axis_of(joint))
        gear.put("stiffness", gives.stiffness)
        if gives.damping:
            gear.put("damping", gives.damping)
        if joint.damping:
            motor.decisions.append("damping of the URDF acts on the motor's side of the gear")
        self.entries.append(gear)
        self.gears.append(self.gear_names[joint.name])
        return self.gear_names[joint.name]


def _said_of(joint: RobotJoint) -> list[str]:
    """Say what a joint is, and what of it is left out."""
    said = [f"joint '{joint.name}', {joint.kind}"]
    limits = []
    if joint.effort is not None:
        limits.append(f"effort {joint.effort:g} N m")
    if joint.velocity is not None:
        limits.append(f"velocity {joint.velocity:g} rad/s")
    if limits:
        said.append(f"limits of {' and '.join(limits)} are not simulated")
    if joint.friction:
        said.append(f"friction {joint.friction:g} N m left out: dampers here are linear")
    return said


def axis_of(joint: RobotJoint) -> Literal["x", "y", "z"] | tuple[float, float, float]:
    """Return the axis of a joint as a scene writes it."""
    named: dict[tuple[float, float, float], Literal["x", "y", "z"]] = {
        (1.0, 0.0, 0.0): "x",
        (0.0, 1.0, 0.0): "y",
        (0.0, 0.0, 1.0): "z",
    }
    return named.get(joint.axis, joint.axis)


def _put_place(entry: Entry, on: str, place: Place) -> None:
    entry.put("on", on)
    if place.at.any():
        entry.put("at", place.at.tolist())
    if any(angles := place.angles()):
        entry.put("turn", angles)


def _six(inertia: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> list[float]:
    """Return the numbers of an inertia: three, or six where it has products."""
    moments = [max(float(inertia[k, k]), 0.0) for k in range(3)]
    products = [float(inertia[i, j] + inertia[j, i]) / 2.0 for i, j in ((0, 1), (0, 2), (1, 2))]
    return [*moments, *products] if any(products) else moments
