"""Initial motion of parts: one number for all, or one for each beam and link, in order or by name."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from itertools import groupby

from tmm_gen.scene.document import Document
from tmm_gen.scene.initial import in_order
from tmm_gen.scene.parts.document import ChainDocument, PartsDocument
from tmm_gen.scene.parts.drivetrain import drivetrain
from tmm_gen.scene.parts.order import hanging
from tmm_gen.scene.parts.placed import PlacedPart
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.table import closest

_SAME = 1e-9
"""Relative difference up to which initial values of parts that turn as one are the same."""


def initial_values(
    document: Document, key: str, solid: Sequence[PlacedPart]
) -> Generator[Finding, None, float | tuple[float, ...] | None]:
    """Find initial values by name that miss a beam or link, or name none; return good ones in order, else None."""
    values, names = getattr(document.initial, key), [part.name for part in solid]
    if not isinstance(values, dict) or values.keys() == set(names):
        return in_order(values, names)
    for name in (name for name in values if name not in names):
        yield Finding(
            ("initial", key, name), "is not the name of a beam or link", closest(name, names), values[name]
        )
    if missing := [name for name in names if name not in values]:
        yield Finding(
            ("initial", key),
            f"leaves out {', '.join(missing)}",
            f"Write a number for each of {', '.join(names)}.",
            values,
        )
    return None


def part_initial(document: PartsDocument) -> Iterator[Finding]:
    """Find initial values that are neither one number nor one per beam and link, or differ in one rigid body."""
    solid = document.expansion.solid
    for key in ("angles", "rates"):
        values = yield from initial_values(document, key, solid)
        names = ", ".join(part.name for part in solid)
        if not isinstance(values, tuple):
            continue
        if len(values) != len(solid):
            yield Finding(
                ("initial", key),
                f"has {len(values)} numbers for {len(solid)} beams and links",
                f"Write one number for all, or one each for {names}, in this order.",
                values,
            )
            continue
        for _, alike in groupby(zip(values, solid, strict=True), key=lambda pair: pair[1].last):
            if len({value for value, _ in alike}) > 1:
                yield Finding(
                    ("initial", key),
                    "differs between parts that are fixed to each other",
                    f"Write the same number for both; the order is {names}.",
                    values,
                )


def chain_initial(document: ChainDocument) -> Iterator[Finding]:
    """Find initial values that are not one per link, or do not fit the gears between links that turn as one."""
    made = drivetrain(hanging(document.parts_by_table()), document.base)
    solid = made.solid
    names = ", ".join(part.name for part in solid)
    for key in ("angles", "rates"):
        values = yield from initial_values(document, key, solid)
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
        for at in dict.fromkeys(part.last for part in solid):
            group = [(value, part) for value, part in zip(values, solid, strict=True) if part.last == at]
            (first, _), *others = group
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
