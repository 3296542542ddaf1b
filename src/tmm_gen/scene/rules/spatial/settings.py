"""What arms in space stand on and are generated as, and tables that are for other kinds."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.emission import box_of_names
from tmm_gen.scene.spatial.document import SpatialDocument

_BASES = {
    "motor": 'Write `kind = "clamp"`, and hang a [[motor]] on it.',
    "prescribed": 'Write `kind = "clamp"`, and let a [[motor]] on it move the arm.',
    "free": 'Write `kind = "clamp"`, or describe the arm in a plane.',
    "floating": 'Write `kind = "clamp"`, or describe the arm in a plane.',
}


def clamped(document: SpatialDocument) -> Iterator[Finding]:
    """Find a base that is no clamp, and a clamp with a hub."""
    base = document.base
    if base.kind != "clamp":
        what = (
            "is a short form for arms in a plane"
            if base.kind == "motor"
            else "is not there yet for arms in space"
        )
        yield Finding(("base", "kind"), f"{what}: these stand on a clamp", _BASES[base.kind], base.kind)
    for key in ("inertia", "damping"):
        if key in base.model_fields_set:
            yield Finding(
                ("base", key), "is that of a hub, and a clamp has none", "Remove it.", getattr(base, key)
            )


def own_tables(document: SpatialDocument) -> Iterator[Finding]:
    """Find tables of other kinds."""
    for index in range(len(document.gear)):
        yield Finding(
            ("gear", index),
            "is for chains: gears of an arm are in its motors",
            "Write `gear = ...` in a [[motor]].",
        )
    if document.tip is not None:
        yield Finding(
            ("tip",), "does not go with parts by name", "Write a [[body]] on the last part instead."
        )
    if document.control is not None:
        yield Finding(
            ("control",),
            "does not control arms in space yet",
            "Remove it and its tables, [control.weights] and so on.",
        )


def emitted(document: SpatialDocument) -> Iterator[Finding]:
    """Find what is not generated of arms in space yet."""
    emit = document.emit
    if emit.sensitivities:
        yield Finding(
            ("emit", "sensitivities"),
            "are not generated of arms in space yet",
            "Remove it; models in CasADi can be differentiated as they are.",
            True,
        )


def boxed(document: SpatialDocument) -> Iterator[Finding]:
    """Find bounds on what is neither state nor input: of a force or a moment each component has its own."""
    names = [
        (item.name,) if item.acts == "torque" else tuple(f"{item.name}_{axis}" for axis in "xyz")
        for item in document.input
    ]
    yield from box_of_names(document.emit, names)
