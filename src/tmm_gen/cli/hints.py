"""Hints at what is probably mistaken in a scene: on standard error, or for the JSON object of a command."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from tmm_gen.scene import Scene


def hinted(scene: Scene, json_mode: bool) -> list[str]:
    """Return the hints at a scene; without JSON they are also shown, on standard error."""
    from tmm_gen.explain.hints import hints

    found = hints(scene)
    if not json_mode:
        for hint in found:
            click.echo(f"hint: {hint}", err=True)
    return found
