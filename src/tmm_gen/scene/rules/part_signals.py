"""Where the inputs of an arm by parts act, and what is measured where."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.parts.order import BASE
from tmm_gen.scene.parts.placed import OF_JOINTS, PlacedPart
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.quantity import PLANAR
from tmm_gen.scene.table import closest

BASE_OUTPUTS = {
    "clamp": ("torque", "force"),
    "prescribed": ("angle", "rate", "torque", "force"),
    "motor": ("angle", "rate"),
    "free": ("position", "velocity", "acceleration", "angle", "rate"),
}
"""What is measured at a base; torque and force are those it exerts on all that stands on it."""


def part_inputs(document: PartsDocument) -> Iterator[Finding]:
    """Find inputs that act nowhere, or not so."""
    parts, on_base = document.expansion.by_name, document.expansion.on_base
    for index, item in enumerate(document.input):
        at, path = str(item.at), ("input", index)
        part = parts.get(at)
        if part is None and at not in (BASE, "tip"):
            yield unknown_place((*path, "at"), at, [BASE, *parts])
        elif at in on_base:
            yield from _on_base(document, index)
        elif item.acts == "angle":
            yield Finding(
                (*path, "acts"),
                'cannot be "angle" here: only the base can be prescribed',
                'Write `acts = "torque"`, or prescribe the base: `at = "base"`.',
                item.acts,
            )
        elif part is not None and part.joint and item.acts != "torque":
            yield Finding(
                (*path, "acts"),
                f"cannot be a force at {part.kind} '{part.name}': what acts there is a torque between both sides",
                'Write `acts = "torque"`, or let the force act at a beam, link or body.',
                item.acts,
            )
        elif part is not None and part.fixed:
            yield _no_frame((*path, "at"), part)


def _on_base(document: PartsDocument, index: int) -> Iterator[Finding]:
    item, kind = document.input[index], document.base.kind
    if item.acts == "angle" and kind != "prescribed":
        yield Finding(
            ("input", index, "acts"),
            f'cannot be "angle" with base.kind = "{kind}"',
            'Write `acts = "torque"`, or remove the input.'
            if kind == "free"
            else 'Set base.kind = "prescribed", or remove the input.',
            item.acts,
        )
    elif item.acts == "torque" and kind not in ("motor", "free"):
        yield Finding(
            ("input", index, "at"),
            f'cannot be "base" for a torque: base.kind = "{kind}" does not yield to it',
            "Let it act at a motor: write the motor's name.",
            item.at,
        )
    elif item.acts.startswith("force") and kind != "free":
        yield Finding(
            ("input", index, "at"),
            'cannot be "base" for a force: the base point never moves',
            "Let it act at a beam, a link or a body.",
            item.at,
        )


def part_outputs(document: PartsDocument) -> Iterator[Finding]:
    """Find a scene without outputs, and outputs of what does not exist or never changes."""
    parts, on_base = document.expansion.by_name, document.expansion.on_base
    if not document.output:
        last = document.expansion.parts[-1].name
        yield Finding(
            ("output",),
            "is missing: a scene without outputs reports nothing",
            f'Add [[output]] with `name = "tip"`, `at = "{last}"`, `of = "position"`.',
        )
    for index, item in enumerate(document.output):
        at, path = str(item.at), ("output", index)
        part = parts.get(at)
        if part is None and at not in (BASE, "tip", "arm"):
            yield unknown_place((*path, "at"), at, [BASE, "arm", *parts])
        elif (at == "arm") != PLANAR[item.of].of_arm:
            whole = ", ".join(name for name, quantity in PLANAR.items() if quantity.of_arm)
            yield Finding(
                (*path, "at"),
                f'must be "arm" for {item.of}' if at != "arm" else f'cannot be "arm" for {item.of}',
                f"The arm as a whole has {whole}; all else belongs to a part.",
                item.at,
            )
        elif part is not None and part.joint and item.of not in OF_JOINTS:
            yield Finding(
                (*path, "of"),
                f"cannot be {item.of} at {part.kind} '{part.name}', which has {', '.join(OF_JOINTS)}",
                "Choose one of them, or measure at a beam, a link or a body.",
                item.of,
            )
        elif (
            at not in on_base | {"arm"}
            and (part is None or not part.joint)
            and item.of in ("torque", "force")
        ):
            yield Finding(
                (*path, "of"),
                f"cannot be {item.of} here: it is joints that pass on a {item.of}",
                "Write the name of a motor or a joint.",
                item.of,
            )
        elif at in on_base and item.of not in BASE_OUTPUTS[document.base.kind]:
            yield Finding(
                (*path, "of"),
                f'cannot be {item.of} at the base with base.kind = "{document.base.kind}"',
                f"Choose {' or '.join(BASE_OUTPUTS[document.base.kind])}, or measure at a part: write its name.",
                item.of,
            )
        elif part is not None and part.fixed:
            yield _no_frame((*path, "at"), part)


def unknown_place(path: Path, at: str, known: list[str]) -> Finding:
    """Return the finding for a place that no part has."""
    return Finding(path, "is not the name of a part", closest(at, known), at)


def _no_frame(path: Path, part: PlacedPart) -> Finding:
    return Finding(
        path,
        f"has no frame of its own: '{part.fixed}' is fixed to it, and both are one rigid body",
        f'Write `at = "{part.fixed}"`, or put a [[joint]] between the two.',
        part.name,
    )
