"""Inputs act where something moves, outputs ask for what there is, names and columns are distinct."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from tmm_gen.scene.parts.order import BASE
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.rules.inputs import prescribed_motion
from tmm_gen.scene.signal import PRESCRIBED, said
from tmm_gen.scene.spatial.arm import ArmInput, ArmOutput
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.signals import OF_ARM, OF_BASE, OF_FRAMES, OF_JOINTS
from tmm_gen.scene.spatial.tree import Hung
from tmm_gen.scene.table import closest

ARM = "arm"


def inputs_possible(document: SpatialDocument) -> Iterator[Finding]:
    """Find inputs that act nowhere, or where nothing yields to them."""
    for index, item in enumerate(document.input):
        path: Path = ("input", index)
        hung = document.tree.by_name.get(item.at)
        if item.acts == "torque" and "axes" in item.model_fields_set:
            yield Finding(
                (*path, "in"),
                "is for forces and moments: a torque is about its joint's axis",
                "Remove it.",
                item.axes,
            )
        if item.at == ARM:
            yield Finding(
                (*path, "at"), "cannot be all of the arm: an input acts at one place", "Name a part.", item.at
            )
        elif item.acts in PRESCRIBED:
            if item.at != BASE or document.base.kind != "prescribed":
                given = f"an {said(item.acts)}" if item.acts == "angle" else f"a {said(item.acts)}"
                other = (
                    '`acts = "torque"` at a motor or a joint' if item.acts == "angle" else '`acts = "force"`'
                )
                yield Finding(
                    (*path, "acts"),
                    f'cannot be "{item.acts}" here: only a base of kind = "prescribed" has {given} that is '
                    "given",
                    f'Write {other}, or `at = "base"` and base.kind = "prescribed".',
                    item.acts,
                )
        elif item.at == BASE and not document.base.floats:
            why = "which moves as its inputs say" if document.base.moves else "which never moves"
            yield Finding((*path, "at"), f"cannot be the base, {why}", "Name a part.", item.at)
        elif hung is None and item.at != BASE:
            yield _unknown(document, (*path, "at"), item.at)
        elif item.acts == "torque" and not (hung and hung.turns):
            yield Finding(
                (*path, "acts"),
                f"cannot be a torque at {hung.words if hung else 'the base'}: a torque acts in a motor or a joint",
                'Write `acts = "moment"` for three components on it, or name a motor or a joint.',
                item.acts,
            )
        elif hung and not (document.base.floats or document.base_turns) and document.tree.mover(hung) is None:
            yield _fixed(document, (*path, "at"), hung)
    yield from prescribed_motion(document)


def outputs_possible(document: SpatialDocument) -> Iterator[Finding]:
    """Find a scene without outputs, and outputs of what does not exist or never changes."""
    if not document.output:
        last = document.tree.outward()[-1].name
        yield Finding(
            ("output",),
            "is missing: a scene without outputs reports nothing",
            f'Add [[output]] with `name = "tip"`, `at = "{last}"`, `of = "position"`.',
        )
    for index, item in enumerate(document.output):
        path: Path = ("output", index)
        hung = document.tree.by_name.get(item.at)
        if (item.at == ARM) != (item.of in OF_ARM):
            word = "must" if item.at != ARM else "cannot"
            yield Finding(
                (*path, "at"),
                f'{word} be "arm" for {item.of}',
                f"The arm as a whole has {', '.join(OF_ARM)}; all else belongs to a part.",
                item.at,
            )
        elif item.at == ARM:
            continue
        elif item.of in OF_BASE:
            yield from _held(document, path, item.at)
        elif item.at == BASE and not document.base.moves:
            yield Finding((*path, "at"), "cannot be the base, which never moves", "Name a part.", item.at)
        elif hung is None and item.at != BASE:
            yield _unknown(document, (*path, "at"), item.at)
        elif item.at == BASE and item.of in OF_JOINTS and document.base_turns:
            continue
        elif item.of in OF_JOINTS and not (hung and hung.turns):
            words = hung.words if hung else "the base"
            yield Finding(
                (*path, "of"),
                f"cannot be {item.of} at {words}: motors and joints have {', '.join(OF_JOINTS)}",
                f"Choose one of {', '.join(OF_FRAMES)}, or name a motor or a joint.",
                item.of,
            )
        elif hung and not document.base.moves and document.tree.mover(hung) is None:
            yield _fixed(document, (*path, "at"), hung)


def _held(document: SpatialDocument, path: Path, at: str) -> Iterator[Finding]:
    """Find a force that is asked for elsewhere than at a base that something holds."""
    if at == BASE and not document.base.floats:
        return
    where = "a base that floats, which nothing holds" if at == BASE else f"'{at}'"
    yield Finding(
        (*path, "of"),
        f'cannot be force at {where}: it is what a base of kind = "clamp" or "prescribed" exerts on the arm',
        'Write `at = "base"` on such a base, or choose one of '
        f"{', '.join(OF_FRAMES)} here, of motors and joints {', '.join(OF_JOINTS)} too.",
        "force",
    )


def _unknown(document: SpatialDocument, path: Path, at: str) -> Finding:
    return Finding(path, "is not the name of a part", closest(at, list(document.tree.by_name)), at)


def _fixed(document: SpatialDocument, path: Path, hung: Hung) -> Finding:
    moves = next(other.name for other in document.tree.outward() if document.tree.mover(other))
    never = "moves as the base does, whatever acts on it" if document.base.moves else "never moves"
    return Finding(
        path,
        f"{never}: {hung.words} is fixed to the base",
        f'Name a part that moves, for example `at = "{moves}"`.',
        hung.name,
    )


def distinct_names(document: SpatialDocument) -> Iterator[Finding]:
    """Find inputs and outputs that share a name, or a column with another."""
    first: dict[str, str] = {}
    for table, columns in (("input", _input_columns), ("output", _output_columns)):
        items = getattr(document, table)
        for index, names in enumerate(columns(document)):
            name = items[index].name
            place = f"[[{table}]] number {index + 1}"
            clash = next((column for column in (name, *names) if column in first), None)
            if clash is not None:
                what = "is already the name" if clash == name else f"has a column '{clash}', which is one"
                yield Finding(
                    (table, index, "name"),
                    f"{what} of {first[clash]}",
                    f"Choose another, for example '{name}_{index + 1}'.",
                    name,
                )
            for column in (name, *names):
                first.setdefault(column, place)


def _input_columns(document: SpatialDocument) -> Iterator[tuple[str, ...]]:
    return (ArmInput(item.name, item.acts).columns for item in document.input)


def _output_columns(document: SpatialDocument) -> Iterator[tuple[str, ...]]:
    return (ArmOutput(item.name, item.of).columns for item in document.output)


def initial_by_name(document: SpatialDocument) -> Iterator[Finding]:
    """Find initial values that go by order, or by the name of what does not turn."""
    names = [hung.name for hung in document.tree.outward() if hung.turns]
    for key in _INITIAL:
        values = getattr(document.initial, key)
        shown = f"`{key} = {{ {names[0]} = 0.1 }}`" if names else "nothing: beams start straight"
        if isinstance(values, tuple):
            yield Finding(
                ("initial", key),
                "is a list, and parts in space go by name",
                f"Write for example {shown}; motors and joints without a value start at 0.",
                values,
            )
        elif isinstance(values, dict):
            for name in (name for name in values if name not in names):
                yield Finding(
                    ("initial", key, name),
                    "is not the name of a motor or a joint",
                    closest(name, names) if names else "Remove it: beams start straight and at rest.",
                    values[name],
                )


_INITIAL: tuple[Literal["angles", "rates"], ...] = ("angles", "rates")
