"""Numbers of a scene that can be fitted: read and replaced by their keys."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.problem import Path

STIFFNESS, DAMPING = "stiffness", "damping"
"""Stand for all joints of a scene without a beam: a common factor."""


def default_keys(scene: Scene) -> tuple[str, ...]:
    """Return what is fitted unless told otherwise: stiffness and damping."""
    if scene.beam is None:
        return STIFFNESS, DAMPING
    damped = ("beam.damping_time",) if scene.beam.damping_time else ()
    table: Any = scene.source.data["beam"]
    return ("beam.material.young" if "material" in table else "beam.bending_stiffness", *damped)


def number_of(scene: Scene, key: str) -> float:
    """Return a number of the scene, 1 for a factor of all joints.

    Raises
    ------
    UserError
        If there is none, or it is not positive.
    """
    if key in (STIFFNESS, DAMPING):
        return 1.0
    value: Any = scene.source.data
    for part in key.split("."):
        try:
            value = value[int(part) - 1] if part.isdecimal() else value[part]
        except (KeyError, IndexError, TypeError):
            raise UserError(
                f"{scene.source.origin}: has no number '{key}' to fit. "
                "Name a key of the file, tables counted from 1: beam.bending_stiffness, joint.1.stiffness."
            ) from None
    if isinstance(value, bool) or not isinstance(value, int | float) or value <= 0:
        raise UserError(f"{scene.source.origin}: '{key}' is {value!r}; only a positive number can be fitted.")
    return float(value)


def changes(scene: Scene, values: Mapping[str, float]) -> dict[Path, float]:
    """Return new numbers by their places in the file."""
    found: dict[Path, float] = {}
    for key, value in values.items():
        if key not in (STIFFNESS, DAMPING):
            found[tuple(int(part) - 1 if part.isdecimal() else part for part in key.split("."))] = value
            continue
        entries: Any = scene.source.data.get("joint", ())
        for number, entry in enumerate(entries):
            if key in entry:
                found["joint", number, key] = value * float(entry[key])
    return found


def replaced(scene: Scene, changed: Mapping[Path, float]) -> Scene:
    """Return the scene with new numbers."""
    keys = {
        ".".join(str(part + 1) if isinstance(part, int) else part for part in path): value
        for path, value in changed.items()
    }
    return scene.replace(**keys)
