"""Parts hang on each other without loops, each on something that can carry it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.parts.order import BASE, Entry, Hanging, entries, hanging
from tmm_gen.scene.parts.tables import BeamPart, BodyPart, MotorPart
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.rules.gears import broken_gears
from tmm_gen.scene.table import STATION_LIMIT, closest


def part_names(document: PartsDocument) -> Iterator[Finding]:
    """Find parts of the same name, and such as hang on what does not exist."""
    every = list(entries(document.parts_by_table()))
    first: dict[str, Entry] = {}
    for entry in every:
        if entry.name in first:
            yield Finding(
                (*entry.path, "name"),
                f"is already the name of [[{first[entry.name].table}]] number {first[entry.name].index + 1}",
                f"Choose another, for example '{entry.name}_2'.",
                entry.name,
            )
        first.setdefault(entry.name, entry)
    for entry in every:
        on = entry.part.on
        if on is not None and on != BASE and on not in first:
            yield Finding((*entry.path, "on"), "is not the name of a part", closest(on, [BASE, *first]), on)


def one_tree(document: PartsDocument) -> Iterator[Finding]:
    """Find loops, branches where none can be, and what is missing for an arm."""
    hung = hanging(document.parts_by_table())
    if not any(e.table in ("beam", "link") for e in hung.entries):
        yield Finding(
            ("link",),
            "is missing: an arm needs at least one [[link]] or [[beam]]",
            'Add [[link]] with `name = "arm"`, `on = ...` and '
            + ("`inertia`." if document.model.linear else "`length`, `mass` and `inertia`."),
        )
        return
    for name in (BASE, *(e.name for e in hung.entries if not isinstance(e.part, BodyPart))):
        carried = [entry for entry in hung.carried(name) if entry.name != name]  # on itself: told below
        if name != BASE and hung.by_name[name].turns:
            carried.sort(
                key=lambda entry: entry.turns
            )  # what it drives comes first: the other is to hang on that
        for entry in carried[1:]:
            if not document.model.linear or entry.part.on is None:  # of a chain, shafts tell the rest
                yield from _branch(hung, name, carried, entry)
    for entry in hung.entries:
        if hung.on(entry) != BASE and _in_a_loop(hung, entry):
            yield Finding(
                (*entry.path, "on"),
                f"closes a loop: {_around(hung, entry)}",
                "Let one of them hang on the base or on another part.",
                entry.part.on,
            )


def _branch(hung: Hanging, name: str, carried: list[Entry], entry: Entry) -> Iterator[Finding]:
    """Find what is wrong with another part on the same one."""
    first, path, host = carried[0], (*entry.path, "on"), hung.by_name.get(name)
    if entry.part.on is None:
        where = "the base" if host is None else f"'{name}'"
        place = _place_for(hung, entry)
        yield Finding(
            path,
            f"is missing: {where} already carries '{first.name}'",
            f'Write what \'{entry.name}\' hangs on, for example `on = "{place}"`, or `on = "base"` for a branch.',
        )
    elif host is not None and host.turns:
        yield Finding(
            path,
            f"puts a second part on {host.words}, which carries '{first.name}' already",
            f"Hang it on '{first.name}', or put a [[link]] on '{name}' and hang both on that.",
            entry.part.on,
        )
    elif host is not None and (fixed := next((e for e in carried if e.table == "link"), None)) is not None:
        other = entry if entry is not fixed else first
        yield Finding(
            (*other.path, "on"),
            f"hangs inside of a rigid body: '{fixed.name}' is fixed to '{name}', and both are one",
            f"Write `on = \"{fixed.name}\"`, or put a [[joint]] between '{name}' and '{fixed.name}'.",
            other.part.on,
        )


def _place_for(hung: Hanging, entry: Entry) -> str:
    """Return the name of a part that a part can hang on: one that carries nothing yet, rather than another."""
    others = [
        e for e in hung.entries if not isinstance(e.part, BodyPart) and entry.name not in _chain_of(hung, e)
    ]
    fit = [e for e in others if not e.turns or not (entry.turns or hung.carried(e.name))]
    return min(fit, key=lambda e: (bool(hung.carried(e.name)), not e.turns)).name if fit else BASE


def _chain_of(hung: Hanging, entry: Entry) -> tuple[str, ...]:
    """Return the names from a part inward, as far as none comes twice."""
    names, found = hung.by_name, [entry.name]
    while (on := hung.on(names[found[-1]])) in names and on not in found:
        found.append(on)
    return (*found, on)


def _in_a_loop(hung: Hanging, entry: Entry) -> bool:
    return _chain_of(hung, entry)[-1] == entry.name


def _around(hung: Hanging, entry: Entry) -> str:
    return " on ".join(f"'{name}'" for name in _chain_of(hung, entry))


def carriers(document: PartsDocument) -> Iterator[Finding]:
    """Find parts that hang on what cannot carry them, or carry nothing."""
    hung = hanging(document.parts_by_table())
    for entry in hung.entries:
        host = hung.by_name.get(hung.host(entry))
        yield from _carried(document, entry, host)
    for entry in hung.outward():
        if entry.turns and not hung.carried(entry.name):
            yield Finding(
                entry.path,
                f"carries nothing: '{entry.name}' has no [[beam]] or [[link]] on it",
                f'Add one with `on = "{entry.name}"`, or remove it.',
            )


def _carried(document: PartsDocument, entry: Entry, host: Entry | None) -> Iterator[Finding]:
    path = (*entry.path, "on")
    if entry.turns and host is not None and host.turns:
        yield Finding(
            path,
            f"hangs on {host.words}: two that turn need a part between them",
            f"Put a [[link]] between '{host.name}' and '{entry.name}', or make one of the two.",
            entry.part.on,
        )
    if isinstance(entry.part, MotorPart):
        yield from broken_gears(entry.part, entry.path)
    free = document.base.kind == "free"
    if isinstance(entry.part, BodyPart) and (host.turns if host else not free):
        yield Finding(
            path,
            f"hangs on {host.words if host else 'the base'}: a body sits on a beam's or a link's outer end",
            "Name a [[beam]] or a [[link]]"
            + (
                "."
                if host
                else ', or write `kind = "free"` alone in [base], so that bodies are a base that floats.'
            ),
            entry.part.on,
        )
    if entry.table == "link" and host is None:
        yield Finding(
            path,
            f"fixes '{entry.name}' to the base, "
            + ("which is one with no [[link]] yet" if free else "where it could not move"),
            'Put a [[motor]] or a [[joint]] between, and write its name: `on = "..."`.',
            entry.part.on,
        )
    if isinstance(entry.part, BeamPart):
        springs, turned = entry.part.springs, host is not None and host.turns
        at = (*entry.path, "springs")
        if springs == "finite-segment" and not turned:
            yield Finding(
                at,
                f"needs a motor or a joint at the beam's inner end, and '{entry.name}' is clamped there",
                'Write `springs = "clamped-segment"`, or remove the key.',
                springs,
            )
        elif springs is not None and springs != "finite-segment" and turned:
            assert host is not None
            yield Finding(
                at,
                f"has a spring at the beam's inner end, where {host.words} turns it",
                'Write `springs = "finite-segment"`, or remove the key.',
                springs,
            )


def parts_suit(document: PartsDocument) -> Iterator[Finding]:
    """Find what arms by parts do not go with."""
    for index in range(len(document.gear)):
        yield Finding(
            ("gear", index),
            "is for chains: gears of a planar arm are in its motors",
            'Write `gear = ...` in a [[motor]], or set model.kind = "chain".',
        )
    if document.model.linearisation != "newton":
        yield Finding(
            ("model", "linearisation"),
            "knows no parts by name: it is the thesis's own, for links behind springs",
            'Write `linearisation = "newton"`, or remove the key.',
            document.model.linearisation,
        )
    if document.tip is not None:
        yield Finding(
            ("tip",),
            "does not go with parts by name",
            "Write a [[body]] on the last part instead.",
        )


def beams_in_range(document: PartsDocument) -> Iterator[Finding]:
    """Products of extreme numbers may leave the range of a float although each factor is in it."""
    made = document.expansion
    hung = hanging(document.parts_by_table())
    for placed in made.parts:
        entry = hung.by_name[placed.name]
        if placed.joint:
            rotor = made.joints[placed.joint - 1].armature
            if isinstance(entry.part, MotorPart) and not math.isfinite(rotor):
                yield _out_of_range(
                    (*entry.path, "gear"), "rotor inertia at the joint", rotor, entry.part.gear
                )
            continue
        if placed.name in made.on_base:
            continue
        part = entry.part
        key = part.key_of("mass_per_length") if isinstance(part, BeamPart) else "mass"
        for link in made.links[placed.first - 1 : placed.last]:
            values = {"mass": link.mass, "moment of inertia": link.inertia}
            wrong = [k for k, v in values.items() if not (math.isfinite(v) and v > 0.0)]
            if wrong:
                value = None if key == "section" else getattr(part, key)
                yield _out_of_range((*entry.path, key), f"link {wrong[0]}", values[wrong[0]], value)
                break
        if not isinstance(part, BeamPart):
            continue
        for joint in made.joints[placed.first - 1 : placed.last]:
            if not (math.isfinite(joint.stiffness) and math.isfinite(joint.damping)):
                path = (*entry.path, part.key_of("bending_stiffness"))
                yield _out_of_range(path, "spring's stiffness", joint.stiffness, part.bending_stiffness)
                break
    if len(made.links) > STATION_LIMIT:
        yield Finding(
            ("beam",), f"makes {len(made.links)} links, more than {STATION_LIMIT}", "Write fewer links."
        )


def _out_of_range(path: Path, what: str, value: float, given: object) -> Finding:
    return Finding(
        path,
        f"gives a {what} of {value:g}, out of the range of numbers",
        "Check the units: SI, N m^2, kg/m, m, kg m^2.",
        given,
    )
