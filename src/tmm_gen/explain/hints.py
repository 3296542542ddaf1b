"""What in a scene looks like a mistake of units: quantities far from those of any arm, as hints, never as errors."""

from __future__ import annotations

import contextlib
import math

from tmm_gen.explain.hint import Hint, Measured, gyration_hint, rotor_hint, turns_hint
from tmm_gen.explain.space_hints import SPACE_HINTS
from tmm_gen.scene import Scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.document import Document
from tmm_gen.scene.locate import nearest_line
from tmm_gen.scene.problem import Path, show_path

_MOST_LINKS = 200
"""Links up to which frequencies are found in no time."""


def hints(scene: Scene) -> list[str]:
    """Return what is probably mistaken in a scene, one line each: file, line, key, what is odd and what to look at."""
    document, source = document_of(scene.source), scene.source
    return [
        f"{source.origin}:{nearest_line(source.lines, path)}: {show_path(path)}: "
        f"{hint.said.format(value=value)}. {hint.look}"
        for hint in (HINTS if scene.spatial is None else (*OF_BEAMS, *SPACE_HINTS))
        for path, value in hint.measured(scene, document)
        if not hint.low <= value <= hint.high
    ]


def _length(scene: Scene, document: Document) -> Measured:
    length = sum(link.length for link in scene.links)
    if length > 0.0:  # a chain has none
        yield next((name,) for name in ("beam", "link") if getattr(document, name)), length


def _gravity(scene: Scene, _document: Document) -> Measured:
    yield ("model", "gravity"), scene.model.gravity or 0.0


def _slowest(scene: Scene, _document: Document) -> Measured:
    """Return the lowest frequency, Hz, at which springs give way; turning on free hinges is none."""
    import numpy as np

    from tmm_gen.reference.duration import slowest_vibration

    if scene.stations > _MOST_LINKS:
        return
    # numbers beyond floating point: others tell
    with contextlib.suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
        if (found := slowest_vibration(scene)) is not None and found > 0.0:
            yield ("joint",) if "joint" in scene.source.data else ("beam",), found / (2.0 * math.pi)


def _young(_scene: Scene, document: Document) -> Measured:
    for path, beam in document.beams().items():
        if beam.material is not None:
            yield (*path, "material", "young"), beam.material.young


def _density(_scene: Scene, document: Document) -> Measured:
    for path, beam in document.beams().items():
        if beam.material is not None:
            yield (*path, "material", "density"), beam.material.density


def _height(_scene: Scene, document: Document) -> Measured:
    """Return the height of each section in the plane of motion over the length of its beam."""
    for path, beam in document.beams().items():
        if beam.section is not None:
            key = "diameter" if beam.section.diameter is not None else "thickness"
            yield (*path, "section", key), getattr(beam.section, key) / beam.length


def _stiff_for_weight(_scene: Scene, document: Document) -> Measured:
    """Return EI over the squared mass per length: (E/density^2)(I/A^2), a material times a shape, N m^4/kg^2."""
    for path, beam in document.beams().items():
        if beam.section is None:
            stiffness, mass = beam.stiffness_and_mass()
            yield (*path, "bending_stiffness"), stiffness / mass / mass


def _heavy(_scene: Scene, document: Document) -> Measured:
    for number, link in enumerate(document.link):
        if link.length > 0.0:
            yield ("link", number, "mass"), link.mass / link.length


def _payload(_scene: Scene, document: Document) -> Measured:
    """Return the mass of each body over that of all beams and links."""
    own = sum(beam.stiffness_and_mass()[1] * beam.length for beam in document.beams().values())
    own += sum(link.mass * getattr(link, "repeat", 1) for link in document.link)
    bodies: dict[Path, float] = {
        ("body", number): body.mass for number, body in enumerate(getattr(document, "body", ()))
    }
    if document.tip is not None:
        bodies["tip",] = document.tip.mass
    yield from (((*path, "mass"), mass / own) for path, mass in bodies.items() if own > 0.0)


def _gyration(_scene: Scene, document: Document) -> Measured:
    """Return the radius of gyration of each rigid link over its length."""
    for number, link in enumerate(document.link):
        if link.length > 0.0:
            yield ("link", number, "inertia"), math.sqrt(link.inertia / link.mass) / link.length


def _rotor(scene: Scene, document: Document) -> Measured:
    """Return what each rotor's inertia is at its joint, over that of the arm with all its mass at the end."""
    arm = sum(link.mass for link in scene.links) * sum(link.length for link in scene.links) ** 2
    for number, motor in enumerate(getattr(document, "motor", ())):
        if arm > 0.0:
            yield ("motor", number, "rotor_inertia"), motor.gear * motor.gear * motor.rotor_inertia / arm


def _turns(scene: Scene, document: Document) -> Measured:
    """Return how many turns an angle of the file is; of the start those between one link and what it stands on."""
    angles = (0.0, *scene.initial.angles)
    between = max(
        abs(joint.ratio * angles[k] - angles[scene.host(k)]) for k, joint in enumerate(scene.joints, start=1)
    )
    yield ("initial", "angles"), between / (2.0 * math.pi)
    for number, joint in enumerate(document.joint):
        yield ("joint", number, "rest"), abs(getattr(joint, "rest", 0.0)) / (2.0 * math.pi)


OF_BEAMS = (
    Hint(
        _young,
        1e6,
        2e12,
        "no solid between rubber and diamond has {value:.3g} Pa",
        "Pa, not MPa or GPa: aluminium has 70e9, steel 210e9.",
    ),
    Hint(
        _density,
        10.0,
        25e3,
        "no solid between foam and osmium has {value:.3g} kg/m^3",
        "kg/m^3, not g/cm^3: aluminium has 2700, steel 7850.",
    ),
    Hint(
        _height,
        0.0,
        1.0,
        "the section is {value:.3g} times as high as the beam is long",
        "Sections are in m, as lengths are: 2 mm are 0.002.",
    ),
)
"""Hints about what beams are made of, in a plane and in space."""

HINTS = (
    Hint(_length, 1e-3, 100.0, "the arm is {value:.3g} m long", "Lengths are in m: 500 mm are 0.5."),
    Hint(_gravity, 0.0, 100.0, "gravity is {value:.3g} m/s^2", "On earth it is 9.81."),
    Hint(
        _slowest,
        1e-2,
        1e5,
        "the slowest vibration has {value:.3g} Hz",
        "Stiffness is in N m/rad, EI in N m^2, mass in kg, length in m, inertia in kg m^2.",
    ),
    *OF_BEAMS,
    Hint(
        _stiff_for_weight,
        1e-3,
        1e6,
        "EI over the squared mass per length is {value:.3g} N m^4/kg^2, that of no material and section",
        "EI is in N m^2, not N mm^2, mass_per_length in kg/m, not g/m; a strip of aluminium has 10 to 1000.",
    ),
    Hint(_heavy, 0.0, 300.0, "the link weighs {value:.3g} kg per m", "Mass is in kg: 200 g are 0.2."),
    Hint(
        _payload,
        0.0,
        100.0,
        "this weighs {value:.3g} times as much as all beams and links",
        "Mass is in kg: 300 g are 0.3.",
    ),
    gyration_hint(_gyration, "link's length"),
    rotor_hint(_rotor),
    turns_hint(_turns),
)
"""All hints. Bounds are wide: a factor of 1000 may stay within them, but nothing ordinary is to leave them."""
