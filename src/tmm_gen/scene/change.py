"""Changing keys of a scene by their dotted names."""

from __future__ import annotations

import copy
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from tmm_gen.scene.integrator import underscored
from tmm_gen.scene.locate import nearest_line
from tmm_gen.scene.problem import Finding, Path, Problem, SceneError, show_path, show_value
from tmm_gen.scene.source import Source


def changed(source: Source, changes: Mapping[str, object]) -> Source:
    """Return a source with keys changed, not checked yet; see :meth:`Scene.replace`.

    Raises
    ------
    SceneError
        If a key leads nowhere.
    """
    data: dict[str, Any] = copy.deepcopy(dict(source.data))
    told = ", ".join(f"{key} = {show_value(value)}" for key, value in changes.items())
    origin = f"{source.origin} (with {told})" if changes else source.origin
    name = changes.get("integrator.name")
    before: dict[str, Any] = data["integrator"]
    if isinstance(name, str) and underscored(name) != underscored(before["name"]):
        kept = {key: before[key] for key in ("step", "tolerance") if key in before}
        data["integrator"] = {"name": name, **kept}
    for key, value in changes.items():
        path = path_of(data, key)
        fault = _assign(data, path, plain(value))
        if fault:
            line = nearest_line(source.lines, path[:1])
            problem = Problem(origin, line, show_path(path), fault.value, fault.message, fault.remedy)
            raise SceneError([problem])
    return replace(source, origin=origin, data=data, written="")


def path_of(data: Any, key: str) -> Path:
    """Return where a key stands in a document, be it there or not: ``link.2.inertia`` is ``("link", 1, "inertia")``.

    Tables are counted from 1, or called by name: ``motor.elbow.gear``. ``link[2].inertia``, as errors have it, will do.
    """
    found: list[str | int] = []
    place = data
    for word in re.sub(r"\[(\d+)\]", r".\1", key).split("."):
        part: str | int = int(word) - 1 if word.isdecimal() else word
        if isinstance(place, list) and isinstance(part, str):
            names = [entry.get("name") for entry in place if isinstance(entry, dict)]
            part = names.index(part) if part in names else part
        found.append(part)
        try:
            place = place[part]
        except (KeyError, IndexError, TypeError):
            place = None
    return tuple(found)


def _assign(data: dict[str, Any], path: Path, value: object) -> Finding | None:
    """Set or, for None, remove the value at a path, making tables on the way."""
    place: Any = data
    for depth, part in enumerate(path[:-1]):
        if isinstance(place, dict) and isinstance(part, str):
            place = place.setdefault(part, {})
        elif isinstance(place, list) and isinstance(part, int) and 0 <= part < len(place):
            place = place[part]
        else:
            return _nowhere(path[: depth + 1], place)
    last = path[-1]
    if isinstance(place, dict) and isinstance(last, str):
        place[last] = value
        if value is None:
            del place[last]
    elif isinstance(place, list) and isinstance(last, int) and 0 <= last < len(place) and value is not None:
        place[last] = value
    else:
        return _nowhere(path, place)
    return None


def _nowhere(path: Path, place: object) -> Finding:
    """Say that nothing is at a path whose last part was looked for in a place, and what is there by name."""
    named = (
        [item["name"] for item in place if isinstance(item, dict) and "name" in item]
        if isinstance(place, list)
        else []
    )
    table = ".".join(str(part) for part in path[:-1])
    return Finding(
        path,
        "is not in this scene",
        f"There {'is' if len(named) == 1 else 'are'} {', '.join(f'{table}.{name}' for name in named)}."
        if named
        else "Name a key of the file, tables by name or counted from 1: link.2.inertia.",
    )


def plain(value: Any) -> Any:
    """Turn tuples and NumPy values to lists and numbers, as a TOML file would have them."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if callable(tolist := getattr(value, "tolist", None)):  # NumPy, without importing it
        return tolist()
    return value


def present(value: Any) -> Any:
    """Leave out keys whose value is None, in tables at any depth."""
    if isinstance(value, dict):
        return {key: present(item) for key, item in value.items() if item is not None}
    return [present(item) for item in value] if isinstance(value, list) else value
