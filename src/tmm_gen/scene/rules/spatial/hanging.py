"""Parts in space hang on each other as a tree, and something in it moves."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tmm_gen.scene.parts.order import BASE
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.spatial.beam import AXIS_OF
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.tables import SpatialBeam
from tmm_gen.scene.spatial.tree import Hung, Tree
from tmm_gen.scene.table import STATION_LIMIT, closest

_IN_BEAM = re.compile(rf"(.+)_([1-9]\d*)_({'|'.join(AXIS_OF)})")


def part_names(document: SpatialDocument) -> Iterator[Finding]:
    """Find parts of the same name, such as are called as a beam's joint, and such as hang on what does not exist."""
    tree = document.tree
    for hung in tree.every:
        first = tree.by_name[hung.name]
        if hung is not first:
            yield Finding(
                (*hung.path, "name"),
                f"is already the name of [[{first.table}]] number {first.index + 1}",
                f"Choose another, for example '{hung.name}_2'.",
                hung.name,
            )
        elif found := _IN_BEAM.fullmatch(hung.name):
            beam = tree.by_name.get(found[1])
            if beam is not None and isinstance(beam.part, SpatialBeam) and int(found[2]) <= beam.part.links:
                yield Finding(
                    (*hung.path, "name"),
                    f"is the name of a joint in [[beam]] '{beam.name}'",
                    f"Choose another, for example '{hung.name}_2'.",
                    hung.name,
                )
    for hung in tree.every:
        if hung.on != BASE and hung.on not in tree.by_name:
            yield Finding(
                (*hung.path, "on"),
                "is not the name of a part",
                closest(hung.on, [BASE, *tree.by_name]),
                hung.on,
            )


def one_tree(document: SpatialDocument) -> Iterator[Finding]:
    """Find loops, parts that do not say what they hang on, and arms without anything that moves."""
    tree = document.tree
    if not any(hung.moves for hung in tree.every):
        yield Finding(
            ("motor",),
            "is missing: nothing in this arm moves",
            'Add [[motor]] with `name = "yaw"`, `on = "base"`, `axis = "z"` and `rotor_inertia = 1e-3`, or a '
            "[[joint]] or [[beam]].",
        )
    for hung in tree.on.get(BASE, ())[1:]:
        if hung.part.on is None:
            first = tree.on[BASE][0]
            yield Finding(
                (*hung.path, "on"),
                f"is missing: the base already carries '{first.name}'",
                f"Write what '{hung.name}' hangs on, for example `on = \"{_place_for(tree, hung)}\"`, or "
                '`on = "base"`.',
            )
    for hung in tree.every:
        way = tree.inward(hung)
        if way[-1] == hung.name:
            yield Finding(
                (*hung.path, "on"),
                f"closes a loop: {' on '.join(map(repr, way))}; arms in space are trees",
                "Let one of them hang on the base or on another part.",
                hung.on,
            )


def _place_for(tree: Tree, hung: Hung) -> str:
    """Return the name of a part that another can hang on: the last one that is not behind it."""
    fit = [other.name for other in tree.outward() if hung.name not in tree.inward(other)]
    return fit[-1] if fit else BASE


def not_too_many(document: SpatialDocument) -> Iterator[Finding]:
    """Find more joints than anyone means."""
    count = len(document.motor) + len(document.joint) + sum(3 * beam.links for beam in document.beam)
    if count > STATION_LIMIT:
        at, most = max(enumerate(beam.links for beam in document.beam), key=lambda pair: pair[1])
        yield Finding(
            ("beam", at, "links"),
            f"leads to {count} joints, three to a cell, more than {STATION_LIMIT}",
            "Write fewer.",
            most,
        )
