"""Inputs and outputs of a chain by parts: where torques act, and what is known there."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.parts.document import ChainDocument
from tmm_gen.scene.parts.drivetrain import OF_LINKS, drivetrain
from tmm_gen.scene.parts.order import BASE, Entry, entries, hanging
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.rules.drivetrains import gives_way
from tmm_gen.scene.rules.part_signals import unknown_place


def chain_inputs(document: ChainDocument) -> Iterator[Finding]:
    """Find inputs that act nowhere, or not so."""
    parts = {e.name: e for e in entries(document.parts_by_table())}
    for index, item in enumerate(document.input):
        at, path = str(item.at), ("input", index)
        entry = parts.get(at)
        if entry is None and at not in (BASE, "tip"):
            yield unknown_place((*path, "at"), at, [BASE, *parts])
        elif item.acts.startswith("force"):
            yield Finding(
                (*path, "acts"),
                "cannot be a force in a chain, which turns only",
                'Write `acts = "torque"`.',
                item.acts,
            )
        elif item.acts == "angle" and (at != BASE or document.base.kind != "prescribed"):
            yield Finding(
                (*path, "acts"),
                'cannot be "angle" here: only a base of kind = "prescribed" has an angle that is given',
                'Write `acts = "torque"`, or set base.kind = "prescribed" and `at = "base"`.',
                item.acts,
            )
        elif item.acts == "torque" and at == BASE and document.base.kind != "motor":
            yield Finding(
                (*path, "at"),
                f'cannot be "base" for a torque: base.kind = "{document.base.kind}" does not yield to it',
                "Let it act at a motor or a link: write its name.",
                item.at,
            )
        elif entry is not None and entry.table in ("joint", "gear"):
            yield Finding(
                (*path, "at"),
                f"cannot be {entry.words}, on which no torque acts from outside",
                "Write the name of a [[motor]] or a [[link]].",
                item.at,
            )


def chain_outputs(document: ChainDocument) -> Iterator[Finding]:
    """Find a chain without outputs, and outputs of what does not exist, never changes or is not known."""
    parts = {e.name: e for e in entries(document.parts_by_table())}
    if not document.output:
        last = drivetrain(hanging(document.parts_by_table()), document.base).solid[-1].name
        yield Finding(
            ("output",),
            "is missing: a scene without outputs reports nothing",
            f'Add [[output]] with `name = "tip"`, `at = "{last}"`, `of = "angle"`.',
        )
    for index, item in enumerate(document.output):
        yield from _measured(document, item.of, str(item.at), parts, ("output", index))


def _measured(
    document: ChainDocument, of: str, at: str, parts: dict[str, Entry], path: Path
) -> Iterator[Finding]:
    entry = parts.get(at)
    if entry is None and at not in (BASE, "tip"):
        yield unknown_place((*path, "at"), at, [BASE, *parts])
    elif entry is not None and entry.table in ("joint", "gear"):
        if of != "torque":
            yield Finding(
                (*path, "of"),
                f"cannot be {of} at {entry.words}, whose sides turn each for itself: it has a torque",
                'Write `of = "torque"`, or measure at a [[link]] beside it.',
                of,
            )
        elif not gives_way(entry):
            yield Finding(
                (*path, "at"),
                f"cannot be {entry.words} for a torque: what a rigid gear passes on has no law of its own",
                "Give it `stiffness`, or measure the torque in a [[joint]] beside it.",
                at,
            )
    elif of not in OF_LINKS:
        yield Finding(
            (*path, "of"),
            f"cannot be {of} here: what has inertia in a chain has {', '.join(OF_LINKS)}",
            "Choose one of them; a [[joint]] or a [[gear]] with stiffness has a torque.",
            of,
        )
    elif at == BASE and document.base.kind == "clamp":
        yield Finding((*path, "at"), 'never moves with base.kind = "clamp"', "Write the name of a part.", at)
