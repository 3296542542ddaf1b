"""Inputs act where something can move, in a way the kind of model and the base allow."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.signal import PRESCRIBED, FileInput, said


def inputs_possible(document: Document) -> Iterator[Finding]:
    """Find inputs that act nowhere, or where the model or the base does not allow it."""
    for index, item in enumerate(document.input):
        path = ("input", index)
        if isinstance(item.at, int) and not 1 <= item.at <= document.stations:
            yield place_outside((*path, "at"), item.at, document.stations)
        elif item.at == "arm":
            yield Finding(
                (*path, "at"),
                'cannot be "arm": an input acts at one place',
                'Write "base", "tip" or a link number.',
                item.at,
            )
        elif item.acts == "angle":
            yield from _angle(document, item, index)
        elif item.acts.startswith("force"):
            yield from _force(document, item, index)
        elif item.at == "base" and document.base.kind != "motor":
            yield Finding(
                (*path, "at"),
                f'cannot be "base" for a torque: base.kind = "{document.base.kind}" does not yield to it',
                'Set base.kind = "motor", or let it act at a link or the tip.',
                item.at,
            )


def place_outside(path: tuple[str | int, ...], at: int, stations: int) -> Finding:
    """Return the finding for a link number beyond the links there are."""
    numbers = "must be 1, the only link" if stations == 1 else f"must be a link from 1 to {stations}"
    return Finding(path, numbers, 'Links are counted from the base; "base" and "tip" are the ends.', at)


def _angle(document: Document, item: FileInput, index: int) -> Iterator[Finding]:
    if item.at != "base":
        yield Finding(
            ("input", index, "at"),
            'must be "base" for an angle: only the base can be prescribed',
            'Write `at = "base"`, or let a torque act here.',
            item.at,
        )
    elif document.base.kind != "prescribed":
        remedy = 'Write `acts = "torque"`, or set base.kind = "prescribed".'
        if document.base.kind == "clamp":
            remedy = 'Set base.kind = "prescribed", or remove the input.'
        yield Finding(
            ("input", index, "acts"),
            f'cannot be "angle" with base.kind = "{document.base.kind}"',
            remedy,
            item.acts,
        )


def _force(document: Document, item: FileInput, index: int) -> Iterator[Finding]:
    if document.model.kind == "chain":
        yield Finding(
            ("input", index, "acts"),
            "cannot be a force in a chain, which turns only",
            'Write `acts = "torque"`, or set model.kind = "planar".',
            item.acts,
        )
    elif item.at == "base":
        yield Finding(
            ("input", index, "at"),
            'cannot be "base" for a force: the base point never moves',
            "Let it act at a link or the tip.",
            item.at,
        )


def prescribed_motion(document: Document) -> Iterator[Finding]:
    """Find a prescribed base that nothing moves, or that two inputs move in the same way."""
    if document.base.kind != "prescribed":
        return
    moving: dict[str, int] = {}
    again: list[tuple[int, str, int]] = []
    for index, item in enumerate(document.input):
        if item.acts in PRESCRIBED and item.at == "base":
            first = moving.setdefault(item.acts, index)
            again += [(index, item.acts, first)] if first != index else []
    if not moving:
        yield Finding(
            ("base", "kind"),
            "needs an input that prescribes the angle",
            'Add [[input]] with `name = "base_angle"`, `at = "base"`, `acts = "angle"`.',
            document.base.kind,
        )
    for index, acts, first in again:
        yield Finding(
            ("input", index, "acts"),
            f"prescribes the {said(acts)} of the base a second time, after '{document.input[first].name}'",
            "Remove one of them.",
            acts,
        )
