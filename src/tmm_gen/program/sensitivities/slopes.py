"""Slopes of a step's assignments, as they stand in its tangent: numbers, factors, and what the step keeps."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Any

import sympy as sp

from tmm_gen.program.statements import Assign, Loop
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable, refs_in

Key = tuple[object, ...]


class Slopes:
    """Keeps slopes, each of them once.

    What is kept at each station is an array; slopes at other stations that are called alike share it.

    Parameters
    ----------
    stations : int
        Of the arm.
    """

    def __init__(self, stations: int) -> None:
        self._stations = stations
        self._versions: dict[Variable, list[int]] = {}
        self._loops = 0
        self._known: dict[Key, Ref] = {}
        self._taken: dict[str, set[int]] = {}
        self._written: dict[Variable, set[int]] = {}
        self._variables: dict[str, Variable] = {}
        self._leaders: dict[Variable, list[tuple[Ref, sp.Expr, Key] | None]] = {}

    @property
    def kept(self) -> tuple[Variable, ...]:
        """All that is kept, in order of discovery."""
        return tuple(self._variables.values())

    def enter(self, loop: Loop | None) -> None:
        """Go into a loop, or out of it."""
        self._loops += 1
        self._written = defaultdict(set)
        for inner in loop.body if loop else ():
            if isinstance(inner, Assign) and inner.target.offset is not None:
                self._written[inner.target.variable].add(inner.target.offset)

    def assigned(self, target: Ref, loop: Loop | None) -> None:
        """Note that something has another value from here on."""
        versions = self._of(target.variable)
        for place in _places(target, loop) if target.variable.length is not None else (0,):
            versions[place] += 1

    def follows(self, target: Ref, leader: Ref, slope: sp.Expr, loop: Loop | None) -> None:
        """Note that a station's value now follows one other thing of that station alone, by a slope that is kept."""
        if loop is None or target.offset is None or leader.offset != target.offset:
            return
        if any(
            not ref.variable.role.bound_at_prepare and ref.variable.role is not Role.POINT
            for ref in refs_in(slope)
        ):
            return
        found = self._leaders.setdefault(target.variable, [None] * self._stations)
        own, its = _moved(leader, -target.offset), _moved(slope, -target.offset)
        for place in _places(target, loop):
            found[place] = (own, its, self._standing(target.variable, leader.variable, place))

    def led(self, ref: Ref, loop: Loop | None) -> tuple[Ref, sp.Expr]:
        """Return what something follows alone, as it stands, and by which slope; itself, and one, where nothing."""
        found = self._leaders.get(ref.variable)
        if found is None or loop is None or ref.offset is None:
            return ref, sp.Integer(1)
        places = _places(ref, loop)
        here = [found[place] for place in places]
        first = here[0]
        if first is None or any(
            each is None
            or each[:2] != first[:2]
            or each[2] != self._standing(ref.variable, each[0].variable, place)
            for each, place in zip(here, places, strict=True)
        ):
            return ref, sp.Integer(1)
        return _moved(first[0], ref.offset), _moved(first[1], ref.offset)

    def _standing(self, follower: Variable, leader: Variable, place: int) -> Key:
        return self._of(follower)[place], self._of(leader)[place]

    def of(self, target: Ref, ref: Ref, slope: sp.Expr, loop: Loop | None) -> tuple[sp.Expr, list[Assign]]:
        """Return a slope as it stands in a tangent, and what keeps it, to stand before the assignment.

        Parameters
        ----------
        target, ref : Ref
            What is assigned, and what it changes with.
        slope : expression
            Of one by the other.
        loop : Loop or None
            That the assignment stands in.
        """
        early, late = slope.as_independent(
            *(r for r in refs_in(slope) if not r.variable.role.bound_at_prepare), as_Add=False
        )
        if late == 1:
            return early, []
        if late.could_extract_minus_sign():
            early, late = -early, -late
        key = self._key(late, loop)
        if key in self._known:
            return early * self._known[key], []
        kept = self._place(target, ref, late, loop)
        self._known[key] = kept
        return early * kept, [Assign(kept, late)]

    def _key(self, value: sp.Expr, loop: Loop | None) -> Key:
        """Return what is alike of values that are equal at each station of a loop."""
        stations: object = (loop.start, loop.stop, loop.stride) if loop else None
        found: list[object] = [value, stations]
        for ref in sorted(refs_in(value), key=lambda r: r.name):
            versions = self._of(ref.variable)
            if ref.variable.length is None:
                found.append((versions[0], self._loops))
                continue
            found.append(tuple(versions[place] for place in _places(ref, loop)))
            if loop and any(
                w != ref.offset and not (w - (ref.offset or 0)) % loop.stride
                for w in self._written[ref.variable]
            ):
                found.append(self._loops)  # another station of this loop has set it
        return tuple(found)

    def _of(self, variable: Variable) -> list[int]:
        return self._versions.setdefault(variable, [0] * (variable.length or 1))

    def _place(self, target: Ref, ref: Ref, value: sp.Expr, loop: Loop | None) -> Ref:
        """Return what keeps a slope of something by something else."""
        if isinstance(value, Ref) and value.variable.role in SCRATCH:
            (name, offset), doc, unit = _called(value, loop), value.variable.doc, value.variable.unit
        else:
            (name, offset), (by, _) = _called(target, loop), _called(ref, loop)
            name, doc, unit = f"{name}_by_{by}", f"{name} per {by}".replace("_", " "), "1"
        if loop is None:
            chosen = next(n for n in _numbered(f"{name}_once") if n not in self._variables)
            self._variables[chosen] = Variable(chosen, Role.POINT, None, doc, unit)
            return self._variables[chosen].ref
        wanted = {j + offset for j in loop.visits}
        chosen = next(n for n in _numbered(name) if not wanted & self._taken.get(n, set()))
        self._taken.setdefault(chosen, set()).update(wanted)
        variable = Variable(chosen, Role.POINT, self._stations, doc, unit)
        return self._variables.setdefault(chosen, variable).at(offset)


def _called(ref: Ref, loop: Loop | None) -> tuple[str, int]:
    """Return how something is called at any station, and which station of a loop's visit it belongs to."""
    name = ref.variable.name
    if loop is None or loop.stride == 1:
        return name, ref.offset or 0
    if ref.offset is not None:
        return name, ref.offset
    # scalars of a visit's stations are numbered
    plain, _, number = name.rpartition("_")
    if plain and number.isdigit() and 1 <= int(number) <= loop.stride:
        return plain, int(number) - 1
    return name, 0


def _moved(value: Any, by: int) -> Any:
    """Return an expression of a station's as it is of another, so many behind."""
    moved = {
        r: Ref(r.variable, r.offset + by, r.entry) for r in refs_in(value) if r.offset is not None and by
    }
    return value.xreplace(moved)


def _numbered(name: str) -> Iterator[str]:
    """Yield a name, then the name with a number."""
    yield name
    number = 2
    while True:
        yield f"{name}_{number}"
        number += 1


def _places(ref: Ref, loop: Loop | None) -> tuple[int, ...]:
    """Return the places of an array that a reference stands for."""
    if ref.entry is not None:
        return (ref.entry,)
    assert loop is not None
    assert ref.offset is not None
    return tuple(j + ref.offset for j in loop.visits)
