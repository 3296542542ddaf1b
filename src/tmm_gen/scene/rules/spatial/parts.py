"""Parts in space are wholly given, once, and their numbers stay in range."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

from tmm_gen.scene.exact import exact
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.rules.gears import broken_gears
from tmm_gen.scene.spatial.arm import Revolute
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.tables import RigidPart, SpatialBeam
from tmm_gen.scene.spatial.values import Inertia

_ROUNDING = Fraction(1, 10**9)
"""Share of the largest moment of inertia by which rounded numbers may fail to be those of a body."""


def twists(document: SpatialDocument) -> Iterator[Finding]:
    """Find beams whose twist is given by halves, or twice."""
    for index, beam in enumerate(document.beam):
        path: Path = ("beam", index)
        for key in ("torsional_stiffness", "polar_inertia_per_length"):
            if beam.material is not None and getattr(beam, key) is not None:
                yield Finding(
                    (*path, key),
                    "does not go with material: it follows from material, `shear` included, and section",
                    "Remove it.",
                    getattr(beam, key),
                )
        if (
            beam.material is None
            and beam.torsional_stiffness is not None
            and beam.polar_inertia_per_length is None
        ):
            yield Finding(
                (*path, "polar_inertia_per_length"),
                "is missing beside torsional_stiffness: what twists has inertia about the beam's axis",
                "Add for example `polar_inertia_per_length = 1e-4` (kg m), or remove torsional_stiffness for a beam "
                "that does not twist.",
            )


def ends(document: SpatialDocument) -> Iterator[Finding]:
    """Find links whose outer end is given twice or not at all."""
    for index, link in enumerate(document.link):
        if link.length is None and link.end is None:
            yield Finding(
                ("link", index, "length"),
                "is missing: where does the next part hang",
                "Add `length = 0.4` (m, along its x axis), or `end = [0.1, 0.0, 0.3]`.",
            )
        elif link.length is not None and link.end is not None:
            yield Finding(
                ("link", index, "length"),
                "and end say the same thing twice",
                "Remove one of them.",
                link.length,
            )


def elastic_gears(document: SpatialDocument) -> Iterator[Finding]:
    """Find elastic gears whose rotors have no inertia, and what damps a spring that is not there."""
    for index, motor in enumerate(document.motor):
        yield from broken_gears(motor, ("motor", index))


def inertias(document: SpatialDocument) -> Iterator[Finding]:
    """Find inertias that no body has."""
    for table in ("link", "body"):
        parts: tuple[RigidPart, ...] = getattr(document, table)
        for index, part in enumerate(parts):
            if not _of_a_body(part.inertia):
                first = ", ".join(f"{value:g}" for value in part.inertia[:3])
                yield Finding(
                    (table, index, "inertia"),
                    "is that of no body: about some axis it is negative",
                    f"Check the products xy, xz, yz, entries of the inertia matrix, or leave them out: `[{first}]`.",
                    part.inertia,
                )


def _of_a_body(inertia: Inertia) -> bool:
    """Return whether no moment of inertia is negative but by rounding."""
    xx, yy, zz, xy, xz, yz = [*map(exact, inertia), *(Fraction(0),) * (6 - len(inertia))]
    largest = max(xx, yy, zz)
    if largest == 0:
        return xy == xz == yz == 0
    xx, yy, zz = (value + _ROUNDING * largest for value in (xx, yy, zz))
    first = yy * zz - yz**2
    return first > 0 and xx * first + xy * (xz * yz - xy * zz) + xz * (xy * yz - xz * yy) > 0


def in_range(document: SpatialDocument) -> Iterator[Finding]:
    """Products of extreme numbers may leave the range of a float although each factor is in it."""
    made, told = document.expansion, set()
    for joint, name in zip(made.joints, made.inner, strict=True):
        if joint.given:
            continue
        hung = document.tree.by_name[name]
        for what, values in _numbers(joint).items():
            wrong = next((value for value in values if not math.isfinite(value)), None)
            if (
                wrong is None
                and what == "stiffness"
                and isinstance(hung.part, SpatialBeam)
                and joint.stiffness == 0
            ):
                wrong = 0.0
            if wrong is not None and name not in told:
                told.add(name)
                yield Finding(
                    hung.path,
                    f"leads to a {what} of {wrong:g} at '{joint.name}', out of the range of numbers",
                    "Check the units here and of what hangs on it: SI, N m^2, kg/m, m, kg m^2.",
                )
    for frame in made.frames.values():
        if frame.name in document.tree.by_name and not all(map(math.isfinite, frame.at)):
            hung = document.tree.by_name[frame.name]
            yield Finding(hung.path, "ends beyond the range of numbers", "Check the units: SI, m.")


def _numbers(joint: Revolute) -> dict[str, tuple[float, ...]]:
    return {
        "stiffness": (joint.stiffness,),
        "damping": (joint.damping,),
        "rotor inertia": (joint.armature,),
        "place": joint.at,
        "mass": (joint.body.mass,),
        "centre of mass": joint.body.center,
        "moment of inertia": joint.body.inertia,
    }
