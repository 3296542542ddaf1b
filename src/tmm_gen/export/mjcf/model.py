"""A scene as a MuJoCo model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as Xml

from tmm_gen.errors import UserError
from tmm_gen.export.mjcf.bodies import add_bodies, text_of
from tmm_gen.export.mjcf.readings import Reading
from tmm_gen.export.mjcf.shafts import add_shafts
from tmm_gen.export.mjcf.signals import Signals
from tmm_gen.export.mjcf.space import add_arm, start_text
from tmm_gen.export.mjcf.space_signals import SpaceSignals
from tmm_gen.export.mjcf.timestep import stable_timestep
from tmm_gen.scene import Scene
from tmm_gen.version import __version__

KEYFRAME = "initial"
"""Name of the keyframe that holds the motion a scene starts from."""


@dataclass(frozen=True)
class MujocoModel:
    """A model in MJCF and how to read it.

    Parameters
    ----------
    text : str
        The file.
    timestep : float
        s, at which RK4 is stable; the scene's step or a simple fraction of it.
    readings : tuple of Reading
        How each output follows from the sensors.
    left_out : tuple of str
        Outputs MuJoCo has no sensor for, with the reason.
    """

    text: str
    timestep: float
    readings: tuple[Reading, ...]
    left_out: tuple[str, ...]


def mujoco_model(scene: Scene) -> MujocoModel:
    """Return a scene as a MuJoCo model: an arm in space, one in the x-y plane, or a chain along z.

    Inputs become actuators of the same name, outputs sensors; the keyframe ``initial`` is the start. MuJoCo's
    coordinates are angles of each link relative to the one before, and of each joint of an arm in space.

    Parameters
    ----------
    scene : Scene
        What to export.

    Raises
    ------
    UserError
        If the base's angle is prescribed: MuJoCo has forces and springs, but no motion that is given exactly; or a
        body in space has an inertia that MuJoCo refuses.
    """
    if scene.motions and scene.spatial:
        raise UserError(
            f"scene '{scene.name}': base.kind = \"prescribed\" cannot be a MuJoCo model, in which nothing moves "
            'as prescribed. Use base.kind = "clamp" with a [[motor]] on it.'
        )
    if scene.prescribed:
        raise UserError(
            f"scene '{scene.name}': base.kind = \"prescribed\" cannot be a MuJoCo model, in which nothing moves "
            'as prescribed. Use base.kind = "motor" with a torque input, or --to fmu.'
        )
    root = Xml.Element("mujoco", model=scene.name)
    Xml.SubElement(root, "compiler", angle="radian", inertiafromgeom="false", autolimits="true")
    timestep = stable_timestep(scene)
    arm = scene.spatial
    gravity = text_of(*arm.gravity) if arm else text_of(0.0, -(scene.model.gravity or 0.0), 0.0)
    option = Xml.SubElement(root, "option", timestep=text_of(timestep), gravity=gravity, integrator="RK4")
    Xml.SubElement(option, "flag", contact="disable", constraint="disable")
    default = Xml.SubElement(root, "default")
    Xml.SubElement(default, "geom", contype="0", conaffinity="0", rgba="0.35 0.45 0.6 1")
    world = Xml.SubElement(root, "worldbody")
    Xml.SubElement(world, "light", pos="0 0 3", dir="0 0 -1")
    signals: Signals | SpaceSignals
    if arm:
        signals = SpaceSignals(root, arm, add_arm(world, scene, arm))
    else:
        bodies = add_shafts(root, world, scene) if scene.drivetrain else add_bodies(world, scene)
        signals = Signals(root, scene, bodies)
    signals.add()
    _add_start(root, scene)
    return MujocoModel(
        _document(root, scene, signals), timestep, tuple(signals.readings), tuple(signals.left_out)
    )


def _add_start(root: Xml.Element, scene: Scene) -> None:
    if arm := scene.spatial:
        qpos, qvel = start_text(arm)
    else:
        start = (scene.initial.angles, scene.initial.rates)
        qpos, qvel = (text_of(*_relative(scene, values)) for values in start)
    frames = Xml.SubElement(root, "keyframe")
    Xml.SubElement(frames, "key", name=KEYFRAME, qpos=qpos, qvel=qvel)


def _relative(scene: Scene, values: Sequence[float]) -> list[float]:
    """Return what each joint turns by of absolute angles or rates of links; what the base does, from rest, first."""
    if scene.drivetrain:
        return [0.0] * scene.hub + list(values)
    absolute = [0.0, *values]
    turned = [absolute[number] - absolute[scene.host(number)] for number in range(1, len(absolute))]
    return [0.0] * (3 if scene.floats else scene.hub) + turned


def _document(root: Xml.Element, scene: Scene, signals: Signals | SpaceSignals) -> str:
    """Return the file, with what a reader has to know at its head."""
    lines = [
        f"{scene.name}: {scene.title}",
        f"Written by tmm-gen {__version__}; scene digest: {scene.digest}",
        "",
        f'Start from the keyframe "{KEYFRAME}". Outputs of the scene, by sensors:',
        *(f"  {reading}" for reading in signals.readings),
        *(f"  {reason}" for reason in signals.left_out),
    ]
    Xml.indent(root, "  ")
    text = "\n".join(f"  {line}".rstrip() for line in lines).replace("--", "- -")
    return f"<!--\n{text}\n-->\n{Xml.tostring(root, encoding='unicode')}\n"
