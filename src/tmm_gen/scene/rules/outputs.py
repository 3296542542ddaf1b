"""Outputs ask for what the kind of model has, where it is not known beforehand."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.quantity import CHAIN, PLANAR
from tmm_gen.scene.rules.inputs import place_outside
from tmm_gen.scene.signal import FileOutput


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
        elif document.model.kind == "chain" and item.of not in CHAIN:
            yield Finding(
                ("output", index, "of"),
                f"cannot be {item.of} in a chain, whose stations only turn",
                f'Choose one of {", ".join(CHAIN)}, or set model.kind = "planar".',
                item.of,
            )
        elif (item.at == "arm") != PLANAR[item.of].of_arm:
            yield _whole_arm(item, index)
        elif item.at == "base":
            yield from _at_base(document, item, index)
        elif item.at == "tip" and item.of in ("torque", "force") and not document.tip:
            yield Finding(
                ("output", index, "at"),
                f'cannot be "tip" for a {item.of}: nothing is joined to the tip',
                f"Write `at = {document.stations}` for the last joint.",
                item.at,
            )


def _whole_arm(item: FileOutput, index: int) -> Finding:
    if item.at == "arm":
        whole = ", ".join(name for name, quantity in PLANAR.items() if quantity.of_arm)
        return Finding(
            ("output", index, "at"),
            f'cannot be "arm" for {item.of}, which belongs to a place',
            f'Write "base", "tip" or a link number; the arm as a whole has {whole}.',
            item.at,
        )
    return Finding(
        ("output", index, "at"),
        f'must be "arm" for {item.of}, which belongs to the arm as a whole',
        'Write `at = "arm"`.',
        item.at,
    )


def _at_base(document: Document, item: FileOutput, index: int) -> Iterator[Finding]:
    if item.of in ("torque", "force"):
        return
    if document.base.kind == "clamp":
        yield Finding(
            ("output", index, "of"),
            f"cannot be {item.of} at the base: a clamp never moves",
            'Write `of = "torque"`, or measure at a link or the tip.',
            item.of,
        )
    elif document.model.kind == "planar" and item.of not in ("angle", "rate"):
        yield Finding(
            ("output", index, "of"),
            f"cannot be {item.of} at the base: the base point of a planar arm never moves",
            'Write `of = "angle"`, `"rate"`, `"torque"` or `"force"`, or measure at a link or the tip.',
            item.of,
        )
