"""Numbers of a scene that can be fitted: read and replaced by their keys."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.change import changed as with_changes
from tmm_gen.scene.change import path_of
from tmm_gen.scene.check import document_of
from tmm_gen.scene.locate import nearest_line
from tmm_gen.scene.parts.document import PARTS
from tmm_gen.scene.problem import Path, show_path, show_value
from tmm_gen.scene.scene import scene_of
from tmm_gen.scene.table import closest, is_finite_number

STIFFNESS, DAMPING = "stiffness", "damping"
"""Stand for all springs, or all dampers, of a scene: a common factor."""

_WRITTEN = {
    STIFFNESS: (("stiffness", "bending_stiffness", "material.young"),),
    # the dampers of a motor act side by side: no record tells one from the other
    DAMPING: (("damping", "motor_damping"), ("damping_time",)),
}
"""Keys by which a part, a joint or a beam says how it gives way; of each group the first that it has."""

_TWISTED = ("torsional_stiffness", "material.shear")
"""The same of how a beam in space twists, of which motion in a plane takes no notice."""

_PLACES = ("length", "at", "end", "turn", "axis", "limits", "velocity", "rate")
"""Of parts in space: where loads act and places are read follows from them, when the code is written."""

_TABLES = ("base", *PARTS, "tip")
"""That say what an arm is."""

_SOLVED = ("integrator", "emit", "control")
"""Tables that say how an arm is solved, written and controlled: no record tells their numbers."""


def default_keys(scene: Scene) -> tuple[str, ...]:
    """Return what is fitted unless told otherwise: stiffness and damping, of each part or beam by itself.

    Raises
    ------
    UserError
        If there is neither.
    """
    springs, dampers = _laws(scene, STIFFNESS), _laws(scene, DAMPING)
    if not springs + dampers:
        known = _numbers(scene.source.data, "", _built_in(scene))
        raise UserError(
            f"{scene.source.origin}: no spring and no damper has a number above 0 to start from. Write one, or say "
            f"what to fit, by --fit and one of {', '.join(known)}."
        )
    if scene.parts or scene.spatial is not None or scene.beam is not None:
        return springs + dampers
    return (STIFFNESS, *((DAMPING,) if dampers else ()))


def number_of(scene: Scene, key: str) -> float:
    """Return a number of the scene, 1 for a factor of all springs or dampers.

    Raises
    ------
    UserError
        If there is none, it is none of the arm's, it is not positive, or it is not free in the generated code.
    """
    if key in _WRITTEN:
        return 1.0
    path = path_of(scene.source.data, key)
    where = f"{scene.source.origin}:{nearest_line(scene.source.lines, path)}"
    value = _at(scene, path)
    if value is None:
        raise UserError(f"{where}: has no number '{key}' to fit. {_others(scene, key, path, absent=True)}")
    if path[0] in _SOLVED:
        raise UserError(
            f"{where}: '{key}' is {show_value(value)}, a number of [{path[0]}], which is not the arm's own. "
            f"{_others(scene, key, path)}"
        )
    if not set(path[1:]).isdisjoint(_built_in(scene)):
        what = "a count or a ratio" if scene.spatial is None else "a count or a place"
        raise UserError(
            f"{where}: '{key}' is {show_value(value)}, {what} that the generated code has built in. "
            f"{_others(scene, key, path)}"
        )
    if not _positive(value):
        raise UserError(
            f"{where}: '{key}' is {show_value(value)}; only a positive number can be fitted. "
            f"{_others(scene, key, path)}"
        )
    return float(value)


def refuse_overlaps(scene: Scene, keys: Sequence[str]) -> None:
    """Refuse keys that mean the same number.

    Raises
    ------
    UserError
        If two do.
    """
    seen: dict[Path, str] = {}
    for key in keys:
        for path in changes(scene, {key: 1.0}):
            if path in seen:
                raise UserError(
                    f"{scene.source.origin}:{nearest_line(scene.source.lines, path)}: {show_path(path)} would be "
                    f"fitted twice, by --fit {seen[path]} and --fit {key}. Leave one of them out."
                )
            seen[path] = key


def changes(scene: Scene, values: Mapping[str, float]) -> dict[Path, float]:
    """Return new numbers by their places in the file."""
    found: dict[Path, float] = {}
    for key, value in values.items():
        if key not in _WRITTEN:
            found[path_of(scene.source.data, key)] = value
            continue
        for each in _laws(scene, key):
            path = path_of(scene.source.data, each)
            found[path] = value * float(_at(scene, path))
    return found


def replaced(scene: Scene, changed: Mapping[Path, float]) -> Scene:
    """Return the scene with new numbers."""
    return scene.replace(**_by_key(changed))


def tried(scene: Scene, changed: Mapping[Path, float]) -> Scene:
    """Return the same for a trial among many: each table is checked, what holds between tables is not.

    Raises
    ------
    SceneError
        If a table cannot have such a number.
    """
    source = with_changes(scene.source, _by_key(changed))
    return scene_of(document_of(source), source)


def _by_key(changed: Mapping[Path, float]) -> dict[str, object]:
    return {show_path(path): value for path, value in changed.items()}


def _laws(scene: Scene, what: str) -> tuple[str, ...]:
    """Return the keys of all springs, or all dampers, that are written with a positive number."""
    data: Any = scene.source.data
    if scene.spatial is not None:
        places = [f"{table}.{part['name']}" for table in PARTS for part in data.get(table, ())]
    elif scene.parts:
        places = [f"{part.kind}.{part.name}" for part in scene.parts]
    elif scene.beam is not None:
        places = ["beam"]
    else:
        places = [f"joint.{number}" for number in range(1, len(data.get("joint", ())) + 1)]
    found: list[str] = []
    groups = _WRITTEN[what]
    if scene.spatial is not None and what == STIFFNESS:
        groups = (*groups, _TWISTED)
    for place in places:
        for group in groups:
            written = ([*_entries(scene, f"{place}.{key}")] for key in group)
            found += next((keys for keys in written if keys), [])
    return tuple(found)


def _entries(scene: Scene, key: str) -> Iterator[str]:
    """Yield a key that stands for a positive number, or those of the positive numbers of a list."""
    value = _at(scene, path_of(scene.source.data, key))
    if _positive(value):
        yield key
    elif isinstance(value, list):
        yield from (f"{key}.{number}" for number, each in enumerate(value, start=1) if _positive(each))


def _at(scene: Scene, path: Path) -> Any:
    """Return what stands at a path of the file, None if nothing does."""
    place: Any = scene.source.data
    for part in path:
        held = isinstance(place, dict) and part in place
        if not held and not (isinstance(place, list) and isinstance(part, int) and 0 <= part < len(place)):
            return None
        place = place[part]
    return place


def _positive(value: object) -> bool:
    return is_finite_number(value) and value > 0


def _others(scene: Scene, key: str, path: Path, *, absent: bool = False) -> str:
    """Return what can be fitted in place of a key: numbers of the same part, or of the whole arm."""
    known = _numbers(scene.source.data, "", _built_in(scene))
    places = {each: path_of(scene.source.data, each) for each in known}
    beside = [each for each in known if places[each][:-1] in (path[:-1], path)]
    if absent and not beside:
        return closest(key, known)
    start = "Write it there with a number to start from, if it has one, or fit" if absent else "Fit"
    return f"{start} one of {', '.join(beside or known)}."


def _built_in(scene: Scene) -> tuple[str, ...]:
    """Return keys of numbers that stand in the code as they are."""
    if scene.spatial is not None:
        return ("links", *_PLACES)
    return ("links", "repeat", "ratio", *(("gear",) if scene.drivetrain else ()))


def _numbers(place: Any, key: str, without: Sequence[str]) -> list[str]:
    """Return the keys of all positive numbers of the tables that say what the arm is, parts by name."""
    if isinstance(place, dict):
        below = place.items() if key else ((table, place[table]) for table in _TABLES if table in place)
    elif isinstance(place, list):
        below = (
            (entry.get("name", str(number)) if isinstance(entry, dict) else str(number), entry)
            for number, entry in enumerate(place, start=1)
        )
    else:
        return [key] if _positive(place) else []
    return [
        k
        for name, each in below
        if name not in without
        for k in _numbers(each, f"{key}.{name}" if key else name, without)
    ]
