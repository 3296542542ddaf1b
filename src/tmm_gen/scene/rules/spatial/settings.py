"""What arms in space stand on and are generated as, and tables that are for other kinds."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.emission import box_of_names
from tmm_gen.scene.signal import ACCELERATION, PRESCRIBED, RATE
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.settings import FLOATING_KEYS


def keys_of_base(document: SpatialDocument) -> Iterator[Finding]:
    """Find keys of bases of other kinds."""
    base = document.base
    for key in ("inertia", "damping"):
        if key in base.model_fields_set:
            floats = "a base that floats is made of the bodies on it, and nothing damps it"
            yield Finding(
                ("base", key),
                f"is that of a hub: {floats}" if base.floats else "is that of a hub, and this base has none",
                'Remove it; mass and inertia are those of a [[body]] with `on = "base"`.'
                if base.floats
                else "Remove it.",
                getattr(base, key),
            )
    for key in FLOATING_KEYS:
        if not base.floats and key in base.model_fields_set:
            other = "a prescribed base moves as its inputs say" if base.moves else "a clamp never moves"
            yield Finding(
                ("base", key),
                f"is of a base that floats, and {other}: its axes are those of the world at first",
                'Remove it, or write `kind = "free"`; parts have `at` and `turn` of their own.',
                getattr(base, key),
            )
    if base.kind != "prescribed" and "axis" in base.model_fields_set:
        yield Finding(("base", "axis"), "is that of a prescribed base", "Remove it.", base.axis)
    moved = base.kind == "prescribed" and any(item.acts in PRESCRIBED for item in document.input)
    if moved and not document.base_turns and "axis" in base.model_fields_set:
        yield Finding(
            ("base", "axis"),
            "is what the base turns about, and no input says by how much",
            'Remove it, or add [[input]] with `name = "base_angle"`, `at = "base"`, `acts = "angle"`.',
            base.axis,
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


def boxed(document: SpatialDocument) -> Iterator[Finding]:
    """Find bounds on what is neither state nor input: of a force or a moment each component has its own."""
    names = [
        tuple(f"{item.name}_{axis}" for axis in "xyz")
        if item.acts in ("force", "moment")
        else (item.name, *((item.name + RATE, item.name + ACCELERATION) if item.acts in PRESCRIBED else ()))
        for item in document.input
    ]
    yield from box_of_names(document.emit, names)
