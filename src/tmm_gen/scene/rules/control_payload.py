"""The body that ``control.payload_body`` says is the payload is one that motors carry, and weighs something."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set

from tmm_gen.scene.control import Control
from tmm_gen.scene.document import Document
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.parts.tables import BodyPart
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.tables import SpatialBody
from tmm_gen.scene.table import closest

_PATH: Path = ("control", "payload_body")


def payload_by_parts(document: Document) -> Iterator[Finding]:
    """Find a body that is the payload of an arm that is not by parts."""
    if document.control is not None and document.control.payload_body is not None:
        yield Finding(
            _PATH,
            "is for arms by parts: the mass at the tip of this one is that of [tip]",
            "Remove the key.",
            document.control.payload_body,
        )


def payload_in_plane(document: PartsDocument, control: Control) -> Iterator[Finding]:
    """Find a payload that is no body at the tip of an arm without branches, or has no mass."""
    made = document.expansion
    last = max(part.last for part in made.parts)
    at_tip = {part.name for part in made.parts if part.kind == "body" and part.last == last}
    yield from _weighs(
        control, _with_mass(document.body), at_tip, "is not at the tip of the arm, where its payload is"
    )


def payload_in_space(document: SpatialDocument, control: Control, turned: Set[int]) -> Iterator[Finding]:
    """Find a payload that is no body, that no motor moves, or that has no mass.

    Parameters
    ----------
    turned : set of int
        Numbers of the joints that motors turn.
    """
    made = document.expansion
    carried = set[int]()
    for number, joint in enumerate(made.joints, start=1):
        if number in turned or joint.host in carried:
            carried.add(number)
    bodies = _with_mass(document.body)
    moved = {name for name in bodies if made.frames[name].joint in carried}
    yield from _weighs(control, bodies, moved, "is moved by no motor")


def _with_mass(bodies: Sequence[BodyPart | SpatialBody]) -> dict[str, bool]:
    """Return of each body whether its mass is written, if only as zero."""
    return {body.name: "mass" in body.model_fields_set for body in bodies}


def _weighs(control: Control, bodies: Mapping[str, bool], good: Set[str], fault: str) -> Iterator[Finding]:
    """Find a payload that is none of the bodies of an arm, not a good one, or a frame.

    Parameters
    ----------
    bodies : mapping from str to bool
        Of all of them, by their names, whether a mass is written.
    good : set of str
        Names of those that can be the payload, with a mass.
    fault : str
        What is wrong with the others.
    """
    name = control.payload_body
    if name is None:
        return
    able = [each for each, weighs in bodies.items() if each in good and weighs]
    others = closest(name, able) if able else "Remove the key."
    if name not in bodies:
        yield Finding(_PATH, "is not the name of a [[body]]", others, name)
    elif name not in good:
        yield Finding(_PATH, fault, others, name)
    elif not bodies[name]:
        yield Finding(
            _PATH,
            "is a body without a mass",
            f"Write `mass` under [[body]] '{name}', in kg: what the arm mostly carries there. `_carry()` tells of any "
            "other, none included.",
            name,
        )
