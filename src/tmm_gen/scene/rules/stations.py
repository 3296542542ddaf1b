"""Joints and links: as many of the one as of the other, from one source, within the range of a float."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tmm_gen.scene.beam import BeamEntry
from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.table import STATION_LIMIT


def stations_consistent(document: Document) -> Iterator[Finding]:
    """Find stations given twice, not at all, too many, or not one joint per link."""
    if document.beam:
        yield from _beam_alone(document)
        yield from _beam_in_range(document, document.beam)
        return
    planar = document.model.kind == "planar"
    for name, entries, example in (
        ("joint", document.joint, "stiffness = 20.0"),
        ("link", document.link, "inertia = 1.0"),
    ):
        if not entries:
            alternative = ", or a [beam]" if planar else ""
            yield Finding(
                (name,),
                f"is missing: a scene needs at least one {name}",
                f"Add [[{name}]] with `{example}`{alternative}.",
            )
    if not document.joint or not document.link:
        return
    joints = sum(entry.repeat for entry in document.joint)
    links = document.stations
    if joints != links:
        more, fewer = ("joint", "link") if joints > links else ("link", "joint")
        yield Finding(
            (more, len(getattr(document, more)) - 1),
            f"leaves {joints} joint{'s' * (joints > 1)} for {links} link{'s' * (links > 1)}",
            f"Each [[link]] has one [[joint]] inboard of it: add {abs(joints - links)} [[{fewer}]],"
            f" or remove as many [[{more}]].",
        )
    if links > STATION_LIMIT:
        yield Finding(("link",), f"makes {links} links, more than {STATION_LIMIT}", "Lower repeat.")


def _beam_alone(document: Document) -> Iterator[Finding]:
    for name in ("joint", "link"):
        if getattr(document, name):
            yield Finding(
                (name, 0),
                f"contradicts [beam], which makes its own {name}s",
                "Remove [beam], or remove every [[joint]] and [[link]].",
            )


def _beam_in_range(document: Document, beam: BeamEntry) -> Iterator[Finding]:
    """Products of extreme numbers may leave the range of a float although each factor is in it."""
    joints, links = document.joints(), document.links()
    derived = [
        (beam.key_of("bending_stiffness"), "joint stiffness", min(j.stiffness for j in joints), 0.0),
        (beam.key_of("bending_stiffness"), "joint stiffness", max(j.stiffness for j in joints), 0.0),
        ("damping_time", "joint damping", max(j.damping for j in joints), -1.0),
        (beam.key_of("mass_per_length"), "link mass", min(link.mass for link in links), 0.0),
        (beam.key_of("mass_per_length"), "link inertia", min(link.inertia for link in links), 0.0),
    ]
    reported = set()
    for key, what, value, above in derived:
        if not (math.isfinite(value) and value > above) and what not in reported:
            reported.add(what)
            yield Finding(
                ("beam", key),
                f"gives a {what} of {value:g}, out of the range of numbers",
                "Check the units: SI, N m^2, kg/m, m, s.",
                None if key == "section" else getattr(beam, key),
            )


def initial_lengths(document: Document) -> Iterator[Finding]:
    """Find initial values that are neither one number nor one per link."""
    for key in ("angles", "rates"):
        values = getattr(document.initial, key)
        if isinstance(values, dict):
            yield Finding(
                ("initial", key),
                "goes by names, and the links of this arm have none",
                "Write one number for all links, or one per link.",
                values,
            )
        if isinstance(values, tuple) and len(values) != document.stations:
            yield Finding(
                ("initial", key),
                f"has {len(values)} numbers for {document.stations} links",
                "Write one number for all links, or one per link.",
                values,
            )
