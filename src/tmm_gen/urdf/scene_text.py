"""The scene that a robot makes, as text."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tmm_gen.scene.identifier import title_fault
from tmm_gen.scene.quantity import SPATIAL
from tmm_gen.urdf.entries import Entry, comment, document
from tmm_gen.urdf.flexibility import Flexibility
from tmm_gen.urdf.identifiers import Names, scene_identifier
from tmm_gen.urdf.parts import Parts
from tmm_gen.urdf.read import read_robot
from tmm_gen.urdf.robot import Robot
from tmm_gen.urdf.sidecar import read_sidecar
from tmm_gen.urdf.tree import tree_of

GRAVITY = 9.81
STEP = 1e-3


@dataclass(frozen=True)
class ImportedScene:
    """A scene made of a URDF.

    Parameters
    ----------
    name : str
        Of the scene.
    text : str
        TOML.
    motors : dict of str to str
        Names of its motors by those of the URDF's joints.
    gears, bodies, beams : tuple of str
        Names of its other parts; gears are those that give way.
    inputs, outputs : tuple of str
        Names of its signals.
    decisions : tuple of str
        Everything that a comment in the scene says.
    """

    name: str
    text: str
    motors: dict[str, str]
    gears: tuple[str, ...]
    bodies: tuple[str, ...]
    beams: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    decisions: tuple[str, ...]


def imported_scene(urdf: Path, sidecar: Path | None = None) -> ImportedScene:
    """Return the scene that a URDF file makes.

    Parameters
    ----------
    urdf : Path
        The robot.
    sidecar : Path or None
        A TOML file that says which of its joints and links give way.

    Raises
    ------
    UserError
        If a file cannot be read, or the robot is none that a scene can hold; every fault found is named, with its
        line, and a remedy.
    """
    robot = read_robot(urdf)
    flexibility = Flexibility() if sidecar is None else read_sidecar(sidecar, robot)
    parts = Parts(tree_of(robot, flexibility), flexibility)
    parts.make()
    name = scene_identifier(robot.name)
    signals, inputs, outputs = _signals(parts)
    root = parts.tree.root.name
    notes = [
        f"URDF has no gravity: {GRAVITY:g} m/s^2 along -z of link '{root}', whose frame is that of the base",
        *_renamed(parts, name),
        *robot.notes,
        *parts.notes,
    ]
    head = ["# SI units and radians.", "#"]
    head += comment(f"Imported from {robot.file}{f' and {flexibility.file}' if sidecar else ''}.")
    head += [line for note in notes for line in comment(f"- {note}")]
    top = Entry("", {})
    top.put("name", name)
    top.put("title", _title(robot, urdf))
    guessed = "URDF has no step: a guess, s, for you to choose by `tmm-gen run` at this step and half of it"
    model, integrator, base = Entry("[model]"), Entry("[integrator]", decisions=[guessed]), Entry("[base]")
    model.put("kind", "spatial")
    model.put("gravity", (0.0, 0.0, -GRAVITY))
    integrator.put("name", "newmark")
    integrator.put("step", STEP)
    base.put("kind", "clamp")
    entries = [model, integrator, base, *parts.entries, *signals]
    text = "\n".join(head) + "\n\n" + top.text() + "\n\n" + document(entries)
    return ImportedScene(
        name,
        text,
        {joint.name: motor for joint, motor in parts.turning},
        tuple(parts.gears),
        _named(parts.entries, "[[body]]"),
        _named(parts.entries, "[[beam]]"),
        tuple(inputs),
        tuple(outputs),
        (*notes, *(words for entry in entries for words in entry.decisions)),
    )


def _named(entries: list[Entry], header: str) -> tuple[str, ...]:
    return tuple(entry.keys["name"].strip('"') for entry in entries if entry.header == header)


def _signals(parts: Parts) -> tuple[list[Entry], list[str], list[str]]:
    """Return a torque for every motor, its angle, that of every gear that gives way, and places of the ends."""
    names, entries = Names({"time"}), []
    inputs, outputs = [], []
    for _, motor in parts.turning:
        entry = Entry("[[input]]")
        inputs.append(names.take(f"{motor}_torque"))
        entry.put("name", inputs[-1])
        entry.put("at", motor)
        entry.put("acts", "torque")
        entries.append(entry)
    wanted = [(f"{motor}_angle", motor, "angle") for _, motor in parts.turning]
    wanted += [(f"{gear}_angle", gear, "angle") for gear in parts.gears]
    wanted += [(parts.link_names[link.name], part, "position") for link, part in parts.ends]
    for name, at, of in wanted:
        entry = Entry("[[output]]")
        outputs.append(names.take(name, f"_{of}", SPATIAL[of].components))  # a word this file writes
        entry.put("name", outputs[-1])
        entry.put("at", at)
        entry.put("of", of)
        entries.append(entry)
    return entries, inputs, outputs


def _renamed(parts: Parts, scene: str) -> list[str]:
    """Say which names of the URDF are others in the scene."""
    robot = parts.tree.robot
    said = [] if scene == robot.name else [f"robot '{robot.name}' is called '{scene}'"]
    for what, names in (("joint", parts.joint_names), ("link", parts.link_names)):
        said += [f"{what} '{name}' is called '{given}'" for name, given in names.items() if given != name]
    return said


def _title(robot: Robot, urdf: Path) -> str:
    """Return a title, without what a title cannot hold."""
    title = f"{robot.name}, from {urdf.name}"
    return title if title_fault(title) is None else f"Imported from {scene_identifier(urdf.stem)}"
