"""Beams say once, and wholly, how they bend and weigh."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.section import MEASURES, NUMBERS, STUFF, Section, Uniform


def beams_given(document: Document) -> Iterator[Finding]:
    """Find beams given twice, by halves or not at all, and sections that are none."""
    for path, beam in document.beams().items():
        found = [*_ways(path, beam)]
        if not found and beam.section is not None:
            found = [*_measures((*path, "section"), beam.section)] or [*_in_range(path, beam)]
        yield from found


def _ways(path: Path, beam: Uniform) -> Iterator[Finding]:
    numbers, stuff = ([k for k in keys if getattr(beam, k) is not None] for keys in (NUMBERS, STUFF))
    one, other = (" and ".join(f"`{key}`" for key in keys) for keys in (NUMBERS, STUFF))
    if numbers and stuff:
        yield Finding(
            (*path, numbers[0]),
            f"does not go with {stuff[0]}: material and section say how the beam bends and weighs",
            f"Write {one} alone, or {other} alone.",
            getattr(beam, numbers[0]),
        )
    elif not numbers and not stuff:
        remedy = f"{_shown(NUMBERS[0])} and {_shown(NUMBERS[1])}, or {other}"
        yield Finding((*path, NUMBERS[0]), "is missing", f"Add for example {remedy}.")
    else:
        pair, given = (NUMBERS, numbers) if numbers else (STUFF, stuff)
        for key in pair:
            if key not in given:
                yield Finding(
                    (*path, key), f"is missing beside {given[0]}", f"Add for example {_shown(key)}."
                )


def _shown(key: str) -> str:
    return f"`{key} = {(Uniform.model_fields[key].examples or [''])[0]}`"


def _measures(path: Path, section: Section) -> Iterator[Finding]:
    wanted = MEASURES[section.kind]
    has = f"a {section.kind} has {' and '.join(wanted)}"
    for key in ("width", "thickness", "diameter"):
        value = getattr(section, key)
        if key in wanted and value is None:
            example = (Section.model_fields[key].examples or [""])[0]
            yield Finding((*path, key), f"is missing: {has}", f"Add for example `{key} = {example}` (m).")
        elif key not in wanted and value is not None:
            yield Finding((*path, key), f"is no measure here: {has}", "Remove it.", value)
    if section.kind == "tube" and section.thickness and section.diameter:
        radius = section.diameter / 2
        if section.thickness > radius:
            yield Finding(
                (*path, "thickness"),
                f"must be at most {radius:g}, the outer radius: it is that of the tube's wall",
                'Write the wall\'s thickness, or remove the key and write `kind = "circle"` for a solid one.',
                section.thickness,
            )


def _in_range(path: Path, beam: Uniform) -> Iterator[Finding]:
    for what, value in zip(("bending stiffness", "mass per length"), beam.stiffness_and_mass(), strict=True):
        if not (math.isfinite(value) and value > 0.0):
            yield Finding(
                (*path, "section"),
                f"and material give a {what} of {value:g}, out of the range of numbers",
                "Check the units: Pa, kg/m^3, m.",
            )
