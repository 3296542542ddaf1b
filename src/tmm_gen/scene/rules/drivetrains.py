"""Parts of a chain: what gives way stands between what has inertia, and gears have something to turn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import groupby, pairwise

from tmm_gen.scene.parts.document import ChainDocument
from tmm_gen.scene.parts.drivetrain import OF_LINKS, drivetrain
from tmm_gen.scene.parts.order import BASE, Entry, entries, hanging
from tmm_gen.scene.parts.tables import ChainLinkPart, GearPart, MotorPart
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.rules.kinds import kind_keys
from tmm_gen.scene.rules.parts import unknown_place
from tmm_gen.scene.table import STATION_LIMIT

_SAME = 1e-9
"""Relative difference up to which initial values of parts that turn as one are the same."""


def chain_suits(document: ChainDocument) -> Iterator[Finding]:
    """Find what is for planar arms."""
    yield from kind_keys(document)
    for index in range(len(document.body)):
        yield Finding(
            ("body", index),
            "is for planar scenes; a chain knows inertias about its axis alone",
            "Write a [[link]] with its `inertia` instead, on the same part.",
        )
    if document.control is not None:
        yield Finding(("control",), "is for planar arms", "Remove the table.")
    if document.gear and document.model.sweep == "product":
        yield Finding(
            ("model", "sweep"),
            "multiplies transfer matrices, which is not derived over gears",
            'Write `sweep = "riccati"`, or remove the key.',
            document.model.sweep,
        )


def _row(document: ChainDocument) -> tuple[Entry, ...]:
    return hanging(document.parts_by_table()).row()


def _gives_way(entry: Entry) -> bool:
    return entry.table == "joint" or (isinstance(entry.part, GearPart) and entry.part.stiffness is not None)


def shafts(document: ChainDocument) -> Iterator[Finding]:
    """Find motors off the base, springs without an inertia between them, and what turns nothing or cannot turn."""
    row = _row(document)
    yield from _on_base(document, row[0])
    for entry in row[1:]:
        if isinstance(entry.part, MotorPart):
            yield Finding(
                (*entry.path, "on"),
                f"puts motor '{entry.name}' on a part that turns: motors of a chain stand on the base",
                "Write a [[link]] with gear^2 times its rotor's inertia, and let an [[input]] act there.",
                entry.part.on,
            )
    for entry in row:
        if isinstance(entry.part, GearPart) and entry.part.stiffness is None and entry.part.damping:
            yield Finding(
                (*entry.path, "damping"),
                "is of teeth that give way, and without stiffness they do not",
                "Add `stiffness` of the teeth, for example `stiffness = 2e4`, or remove it.",
                entry.part.damping,
            )
    springs = [e for e in row if _gives_way(e) or isinstance(e.part, ChainLinkPart)]
    for before, entry in pairwise(springs):
        if _gives_way(before) and _gives_way(entry):
            yield Finding(
                (*entry.path, "on"),
                f"gives way straight behind {before.words}, with no inertia between the two",
                f"Put a [[link]] between '{before.name}' and '{entry.name}', or write both as one, in series: "
                "1/(1/k + 1/K), seen from the same shaft.",
                entry.part.on,
            )
    if not isinstance(row[-1].part, ChainLinkPart):
        yield Finding(
            row[-1].path,
            f"carries nothing: '{row[-1].name}' has no [[link]] on it",
            f'Add one with `on = "{row[-1].name}"`, or remove it.',
        )
    if not any(map(_gives_way, row)):
        yield Finding(
            row[-1].path,
            "makes a chain that turns as one: nothing in it gives way",
            "Put a [[joint]] with `stiffness` before it, or give a [[gear]] `stiffness`.",
        )


def _on_base(document: ChainDocument, first: Entry) -> Iterator[Finding]:
    kind, path = document.base.kind, (*first.path, "on")
    if isinstance(first.part, MotorPart):
        if kind != "clamp":
            instead = {"motor": "that is a motor already", "free": "that nothing holds"}
            yield Finding(
                path,
                f"puts motor '{first.name}' on a base {instead.get(kind, 'whose angle an input prescribes')}",
                'Set base.kind = "clamp", or write a [[link]] with its inertia instead.',
                first.part.on,
            )
        elif not first.part.rotor_inertia and not _fixed_to_base(document):
            yield Finding(
                (*first.path, "rotor_inertia"),
                "is missing: a motor of a chain turns a hub, and nothing with inertia is fixed to this one",
                "Write for example `rotor_inertia = 2e-5` (kg m^2), or put a [[link]] on the motor.",
            )
    elif kind == "free" and not isinstance(first.part, ChainLinkPart):
        yield Finding(
            path,
            f"starts a chain that nothing holds with {first.words}, which has no inertia",
            "Let a [[link]] be the first part.",
            first.part.on,
        )
    elif kind in ("clamp", "prescribed") and (fixed := _fixed_to_base(document)):
        yield Finding(
            (*fixed.path, "on"),
            f"fixes '{fixed.name}' to the base, where it could not turn by itself",
            "Put a [[joint]] with `stiffness` before it, or remove it.",
            fixed.part.on,
        )


def _fixed_to_base(document: ChainDocument) -> Entry | None:
    """Return the first link that turns with the base, motor or rigid gears in between."""
    for entry in _row(document):
        if _gives_way(entry):
            return None
        if isinstance(entry.part, ChainLinkPart):
            return entry
    return None


def free_base(document: ChainDocument) -> Iterator[Finding]:
    """Find a hub in the file where nothing holds the arm."""
    for key in ("inertia", "damping") if document.base.kind == "free" else ():
        if key in document.base.model_fields_set:
            yield Finding(
                ("base", key),
                'contradicts kind = "free", where nothing is but the parts',
                "Remove it, and give the first [[link]] this inertia.",
                getattr(document.base, key),
            )


def chain_in_range(document: ChainDocument) -> Iterator[Finding]:
    """Products of extreme numbers may leave the range of a float although each factor is in it."""
    made = drivetrain(_row(document), document.base)
    turning = made.base is not None and made.base.turns
    numbers = [
        *(link.inertia for link in made.links),
        *(value for joint in made.joints for value in (joint.stiffness, abs(joint.ratio))),
        *([made.base.inertia] if made.base is not None and turning else []),
    ]
    wrong = [n for n in numbers if not (math.isfinite(n) and n > 0.0)]
    if wrong or not all(math.isfinite(joint.damping) for joint in made.joints):
        table = "gear" if document.gear else _row(document)[0].table
        yield Finding(
            (table,),
            f"refers an inertia or a stiffness to {wrong[0] if wrong else math.inf:g}, out of the range of numbers",
            "Check ratios and units: turns per turn, N m/rad, kg m^2.",
        )
    if len(made.links) > STATION_LIMIT:
        yield Finding(
            ("link",), f"makes {len(made.links)} links, more than {STATION_LIMIT}", "Write fewer links."
        )


def chain_initial(document: ChainDocument) -> Iterator[Finding]:
    """Find initial values that are not one per link, or do not fit the gears between links that turn as one."""
    made = drivetrain(_row(document), document.base)
    solid = made.solid
    names = ", ".join(part.name for part in solid)
    for key in ("angles", "rates"):
        values = getattr(document.initial, key)
        if not isinstance(values, tuple):  # of the first link behind each joint: what gears join follows
            continue
        if len(values) != len(solid):
            yield Finding(
                ("initial", key),
                f"has {len(values)} numbers for {len(solid)} links",
                f"Write one number for all, or one each for {names}.",
                values,
            )
            continue
        for at, alike in groupby(zip(values, solid, strict=True), key=lambda pair: pair[1].last):
            (first, _), *others = group = list(alike)
            if at == 0 and any(value for value, _ in group):
                yield Finding(
                    ("initial", key),
                    f"moves '{group[0][1].name}', which turns with the base: that starts at 0, at rest",
                    f"Write one number each for {names}, 0 for those on the base.",
                    values,
                )
            elif any(abs(v - made.turns[p.name] * first) > _SAME * abs(v) for v, p in others):
                turns = ", ".join(f"{made.turns[p.name]:g} of '{p.name}'" for _, p in group)
                yield Finding(
                    ("initial", key),
                    f"does not fit rigid gears: per turn it is {turns}",
                    f"Write one number each for {names}, in this ratio.",
                    values,
                )


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
        yield Finding(
            ("output",),
            "is missing: a scene without outputs reports nothing",
            f'Add [[output]] with `name = "tip"`, `at = "{_row(document)[-1].name}"`, `of = "angle"`.',
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
        elif not _gives_way(entry):
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
