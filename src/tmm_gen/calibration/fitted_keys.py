"""Numbers of a scene that can be fitted: read and replaced by their keys."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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

_TABLES = ("base", *PARTS, "tip")
"""That say what an arm is."""


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
    if scene.parts or scene.beam is not None:
        return springs + dampers
    return (STIFFNESS, *((DAMPING,) if dampers else ()))


def number_of(scene: Scene, key: str) -> float:
    """Return a number of the scene, 1 for a factor of all springs or dampers.

    Raises
    ------
    UserError
        If there is none, it is not positive, or it is not free in the generated code.
    """
    if key in _WRITTEN:
        return 1.0
    path = path_of(scene.source.data, key)
    where = f"{scene.source.origin}:{nearest_line(scene.source.lines, path)}"
    value = _at(scene, path)
    if value is None:
        raise UserError(f"{where}: has no number '{key}' to fit. {_others(scene, key, path, absent=True)}")
    if path[-1] in _built_in(scene):
        raise UserError(
            f"{where}: '{key}' is {show_value(value)}, a count or a ratio that the generated code has built in. "
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
    if scene.parts:
        places = [f"{part.kind}.{part.name}" for part in scene.parts]
    elif scene.beam is not None:
        places = ["beam"]
    else:
        places = [f"joint.{number}" for number in range(1, len(data.get("joint", ())) + 1)]
    found: list[str] = []
    for place in places:
        for group in _WRITTEN[what]:
            keys = [f"{place}.{key}" for key in group]
            found += [key for key in keys if _positive(_at(scene, path_of(data, key)))][:1]
    return tuple(found)


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
    beside = [each for each in known if path_of(scene.source.data, each)[:-1] == path[:-1]]
    if absent and not beside:
        return closest(key, known)
    start = "Write it there with a number to start from, if it has one, or fit" if absent else "Fit"
    return f"{start} one of {', '.join(beside or known)}."


def _built_in(scene: Scene) -> tuple[str, ...]:
    """Return keys of numbers that stand in the code as they are."""
    return ("links", "repeat", "ratio", *(("gear",) if scene.drivetrain else ()))


def _numbers(place: Any, key: str, without: Sequence[str]) -> list[str]:
    """Return the keys of all positive numbers of the tables that say what the arm is, parts by name."""
    if isinstance(place, dict):
        below = place.items() if key else ((table, place[table]) for table in _TABLES if table in place)
    elif isinstance(place, list):
        below = ((entry.get("name", number), entry) for number, entry in enumerate(place, start=1))
    else:
        return [key] if _positive(place) and key.rpartition(".")[2] not in without else []
    return [k for name, each in below for k in _numbers(each, f"{key}.{name}" if key else name, without)]
