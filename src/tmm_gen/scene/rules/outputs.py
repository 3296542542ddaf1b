"""Outputs ask for what the kind of model has, where it is not known beforehand."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.inputs import place_outside
from tmm_gen.scene.signal import Output

CHAIN_QUANTITIES = ("angle", "velocity", "acceleration", "torque")


def outputs_possible(document: Document) -> Iterator[Finding]:
    """Find a scene without outputs, and outputs of what does not exist or never changes."""
    if not document.output:
        yield Finding(
            ("output",),
            "is missing: a scene without outputs reports nothing",
            'Add [[output]] with `name = "tip"`, `at = "tip"`, `of = "angle"`.',
        )
    for index, item in enumerate(document.output):
        if isinstance(item.at, int) and not 1 <= item.at <= document.stations:
            yield place_outside(("output", index, "at"), item.at, document.stations)
        elif document.model.kind == "chain" and item.of not in CHAIN_QUANTITIES:
            yield Finding(
                ("output", index, "of"),
                f"cannot be {item.of} in a chain, which turns only",
                f'Choose one of {", ".join(CHAIN_QUANTITIES)}, or set model.kind = "planar".',
                item.of,
            )
        elif item.at == "base":
            yield from _at_base(document, item, index)
        elif item.at == "tip" and item.of in ("torque", "force") and not document.tip:
            yield Finding(
                ("output", index, "at"),
                f'cannot be "tip" for a {item.of}: nothing is joined to the tip',
                f"Write `at = {document.stations}` for the last joint.",
                item.at,
            )


def _at_base(document: Document, item: Output, index: int) -> Iterator[Finding]:
    if item.of in ("torque", "force"):
        return
    if document.base.kind == "clamp":
        yield Finding(
            ("output", index, "of"),
            f"cannot be {item.of} at the base: a clamp never moves",
            'Write `of = "torque"`, or measure at a link or the tip.',
            item.of,
        )
    elif document.model.kind == "planar" and item.of != "angle":
        yield Finding(
            ("output", index, "of"),
            f"cannot be {item.of} at the base: the base point of a planar arm never moves",
            'Write `of = "angle"`, `"torque"` or `"force"`, or measure at a link or the tip.',
            item.of,
        )
