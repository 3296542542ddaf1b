"""What in an arm in space looks like a mistake of units, beside what its beams are made of."""

from __future__ import annotations

import math

from tmm_gen.explain.hint import Hint, Measured, gyration_hint, rotor_hint, turns_hint
from tmm_gen.scene import Scene
from tmm_gen.scene.document import Document
from tmm_gen.scene.spatial.document import SpatialDocument


def _reach(scene: Scene, document: Document) -> Measured:
    if scene.reach > 0.0:
        yield (
            next((name,) for name in ("beam", "link", "motor", "joint") if getattr(document, name)),
            scene.reach,
        )


def _gravity(scene: Scene, _document: Document) -> Measured:
    if scene.spatial is not None:
        yield ("model", "gravity"), math.hypot(*scene.spatial.gravity)


def _turn(_scene: Scene, document: Document) -> Measured:
    """Return how many turns a constant turn or an angle of the file is."""
    assert isinstance(document, SpatialDocument)
    for hung in document.tree.every:
        yield (*hung.path, "turn"), max(map(abs, hung.part.turn)) / (2.0 * math.pi)
    for number, joint in enumerate(document.joint):
        yield ("joint", number, "rest"), abs(joint.rest) / (2.0 * math.pi)
    angles = document.initial.angles
    for name, angle in angles.items() if isinstance(angles, dict) else ():
        yield ("initial", "angles", name), abs(angle) / (2.0 * math.pi)


def _rotor(scene: Scene, document: Document) -> Measured:
    """Return what each rotor's inertia is at its joint, over that of the arm with all its mass at the end."""
    arm = scene.spatial
    assert arm is not None
    whole = sum(joint.body.mass for joint in arm.joints) * scene.reach * scene.reach  # a power would raise
    for number, motor in enumerate(document.motor if isinstance(document, SpatialDocument) else ()):
        if whole > 0.0:
            yield ("motor", number, "rotor_inertia"), motor.gear * motor.gear * motor.rotor_inertia / whole


def _gyration(scene: Scene, document: Document) -> Measured:
    """Return the radius of gyration of each rigid part over the arm's reach."""
    assert isinstance(document, SpatialDocument)
    for table in ("link", "body"):
        for number, part in enumerate(getattr(document, table)):
            if part.mass > 0.0 and scene.reach > 0.0:
                radius = math.sqrt(max(part.inertia[:3]) / part.mass)
                yield (table, number, "inertia"), radius / scene.reach


SPACE_HINTS = (
    Hint(_reach, 1e-3, 100.0, "the arm reaches {value:.3g} m", "Lengths are in m: 500 mm are 0.5."),
    Hint(_gravity, 0.0, 100.0, "gravity is {value:.3g} m/s^2", "On earth it is 9.81."),
    gyration_hint(_gyration, "arm's reach"),
    rotor_hint(_rotor),
    turns_hint(_turn),
)
