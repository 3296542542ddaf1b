"""Changing keys of a scene from the command line: ``--set KEY=VALUE``."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

set_option = click.option(
    "--set", "changes", metavar="KEY=VALUE", multiple=True, help="Change a key of the scene. Repeatable."
)
"""The option; gives a command the argument ``changes``."""


def changed_scene(path: Path, changes: Sequence[str] = (), step: float | None = None) -> Scene:
    """Read a scene and change what is asked for.

    Raises
    ------
    UserError
        If a text is not ``KEY=VALUE``.
    SceneError
        If the scene, as it is or changed, is not valid.
    """
    from tmm_gen.scene import load_scene

    wanted: dict[str, object] = {}
    for text in changes:
        key, equals, value = text.partition("=")
        if not equals or not key.strip():
            raise UserError(f"--set {text}: is not KEY=VALUE. Write for example --set integrator.step=0.01.")
        wanted[key.strip()] = _value(value.strip())
    if step is not None:
        wanted["integrator.step"] = step
    loaded = load_scene(path)
    return loaded.replace(**wanted) if wanted else loaded


def _value(text: str) -> object:
    """Read a value as TOML has it; what is none is a string without its quotes."""
    try:
        read: dict[str, Any] = tomllib.loads(f"value = {text}")
    except ValueError:
        return text
    return read["value"] if set(read) == {"value"} else text
