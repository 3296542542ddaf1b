"""Parts of a chain: what gives way stands between what has inertia, and gears have something to turn."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tmm_gen.scene.parts.document import ChainDocument
from tmm_gen.scene.parts.drivetrain import drivetrain
from tmm_gen.scene.parts.order import BASE, Entry, Hanging, hanging
from tmm_gen.scene.parts.tables import ChainLinkPart, GearPart, MotorPart
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.rules.kinds import kind_keys
from tmm_gen.scene.table import STATION_LIMIT


def chain_suits(document: ChainDocument) -> Iterator[Finding]:
    """Find what is for planar arms."""
    yield from kind_keys(document)
    for index in range(len(document.body)):
        yield Finding(
            ("body", index),
            "is for planar scenes; a chain knows inertias about its axis alone",
            "Write a [[link]] with its `inertia` instead, on the same part.",
        )
    for index, motor in enumerate(document.motor):
        for key in ("stiffness", "damping_time"):
            if getattr(motor, key):
                yield Finding(
                    ("motor", index, key),
                    "is of an elastic gear, which is a part of its own in a chain",
                    f"Remove it, and put a [[gear]] with `ratio` and `stiffness` on '{motor.name}'.",
                    getattr(motor, key),
                )
        if motor.encoder != "rotor":
            yield Finding(
                ("motor", index, "encoder"),
                "is for control, which is of planar arms and of arms in space",
                "Remove the key.",
                motor.encoder,
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


def _hung(document: ChainDocument) -> Hanging:
    return hanging(document.parts_by_table())


def gives_way(entry: Entry) -> bool:
    """Return whether what hangs on a part turns against what that hangs on."""
    return entry.table == "joint" or (isinstance(entry.part, GearPart) and entry.part.stiffness is not None)


def _spring_before(hung: Hanging, entry: Entry) -> Entry | None:
    """Return what gives way between a part and the next inertia inward, if anything does."""
    host = hung.by_name.get(hung.host(entry))
    while host is not None and host.table in ("joint", "gear"):
        if gives_way(host):
            return host
        host = hung.by_name.get(hung.host(host))
    return None


def shafts(document: ChainDocument) -> Iterator[Finding]:
    """Find motors off the base, springs without an inertia between them, and what turns nothing or cannot turn."""
    hung = _hung(document)
    every = hung.outward()
    yield from _on_base(document, hung)
    for entry in every:
        yield from _shaft(hung, entry)
    if not any(map(gives_way, every)):
        yield Finding(
            every[-1].path,
            "makes a chain that turns as one: nothing in it gives way",
            "Put a [[joint]] with `stiffness` before it, or give a [[gear]] `stiffness`.",
        )


def _shaft(hung: Hanging, entry: Entry) -> Iterator[Finding]:
    on = (*entry.path, "on")
    carried = sorted(hung.carried(entry.name), key=lambda e: not isinstance(e.part, ChainLinkPart))
    before = _spring_before(hung, entry)
    if isinstance(entry.part, MotorPart) and hung.host(entry) != BASE:
        yield Finding(
            on,
            f"puts motor '{entry.name}' on a part that turns: motors of a chain stand on the base",
            "Write a [[link]] with gear^2 times its rotor's inertia, and let an [[input]] act there.",
            entry.part.on,
        )
    if isinstance(entry.part, GearPart) and entry.part.stiffness is None and entry.part.damping:
        yield Finding(
            (*entry.path, "damping"),
            "is of teeth that give way, and without stiffness they do not",
            "Add `stiffness` of the teeth, for example `stiffness = 2e4`, or remove it.",
            entry.part.damping,
        )
    if before is not None and gives_way(entry):
        yield Finding(
            on,
            f"gives way straight behind {before.words}, with no inertia between the two",
            f"Put a [[link]] between '{before.name}' and '{entry.name}', or write both as one, in series: "
            "1/(1/k + 1/K), seen from the same shaft.",
            entry.part.on,
        )
    if not isinstance(entry.part, ChainLinkPart) and not carried:
        yield Finding(
            entry.path,
            f"carries nothing: '{entry.name}' has no [[link]] on it",
            f'Add one with `on = "{entry.name}"`, or remove it.',
        )
    if len(carried) > 1 and (gives_way(entry) or (entry.table == "gear" and before is not None)):
        yield Finding(
            (*carried[1].path, "on"),
            f"puts a second part on {entry.words}, which carries '{carried[0].name}' and has no inertia",
            f"Hang it on '{carried[0].name}', or put a [[link]] on '{entry.name}' and hang both on that.",
            carried[1].part.on,
        )


def _on_base(document: ChainDocument, hung: Hanging) -> Iterator[Finding]:
    kind = document.base.kind
    first, *others = sorted(hung.carried(BASE), key=lambda e: not isinstance(e.part, MotorPart))
    if others and (kind == "free" or isinstance(first.part, MotorPart)):
        yield Finding(
            (*others[0].path, "on"),
            f"puts '{others[0].name}' on the base, where '{first.name}' is: what that turns is the first coordinate",
            f"Hang it on '{first.name}': write `on = \"{first.name}\"`.",
            others[0].part.on,
        )
    if isinstance(first.part, MotorPart):
        yield from _motor(document, hung, first)
    elif kind == "free" and not isinstance(first.part, ChainLinkPart):
        yield Finding(
            (*first.path, "on"),
            f"starts a chain that nothing holds with {first.words}, which has no inertia",
            "Let a [[link]] be the first part.",
            first.part.on,
        )
    elif kind in ("clamp", "prescribed"):
        for fixed in _fixed_to_base(hung):
            yield Finding(
                (*fixed.path, "on"),
                f"fixes '{fixed.name}' to the base, where it could not turn by itself",
                "Put a [[joint]] with `stiffness` before it, or remove it.",
                fixed.part.on,
            )


def _motor(document: ChainDocument, hung: Hanging, motor: Entry) -> Iterator[Finding]:
    kind = document.base.kind
    assert isinstance(motor.part, MotorPart)
    if kind != "clamp":
        instead = {"motor": "that is a motor already", "free": "that nothing holds"}
        yield Finding(
            (*motor.path, "on"),
            f"puts motor '{motor.name}' on a base {instead.get(kind, 'whose angle an input prescribes')}",
            'Set base.kind = "clamp", or write a [[link]] with its inertia instead.',
            motor.part.on,
        )
    elif not motor.part.rotor_inertia and not _fixed_to_base(hung):
        yield Finding(
            (*motor.path, "rotor_inertia"),
            "is missing: a motor of a chain turns a hub, and nothing with inertia is fixed to this one",
            "Write for example `rotor_inertia = 2e-5` (kg m^2), or put a [[link]] on the motor.",
        )


def _fixed_to_base(hung: Hanging) -> list[Entry]:
    """Return the links that turn as one with the base, or with the motor on it."""
    found: list[Entry] = []
    names = {BASE}
    for entry in hung.outward():
        if hung.host(entry) in names and not gives_way(entry):
            names.add(entry.name)
            found += [entry] if isinstance(entry.part, ChainLinkPart) else []
    return found


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
    made = drivetrain(_hung(document), document.base)
    turning = made.base is not None and made.base.turns
    numbers = [
        *(link.inertia for link in made.links),
        *(value for joint in made.joints for value in (joint.stiffness, abs(joint.ratio))),
        *([made.base.inertia] if made.base is not None and turning else []),
    ]
    wrong = [n for n in numbers if not (math.isfinite(n) and n > 0.0)]
    if wrong or not all(math.isfinite(joint.damping) for joint in made.joints):
        table = "gear" if document.gear else made.parts[0].kind
        yield Finding(
            (table,),
            f"refers an inertia or a stiffness to {wrong[0] if wrong else math.inf:g}, out of the range of numbers",
            "Check ratios and units: turns per turn, N m/rad, kg m^2.",
        )
    if len(made.links) > STATION_LIMIT:
        yield Finding(
            ("link",), f"makes {len(made.links)} links, more than {STATION_LIMIT}", "Write fewer links."
        )
