"""Which commands serve which kind of scene; the others say so on one line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

SERVED: Mapping[str, tuple[str, ...]] = {
    "spatial": (
        "build",
        "run",
        "check",
        "explain",
        "rest",
        "modes",
        "mpc",
        "frequency",
        "stability",
        "trade",
        "tune",
        "playground",
        "export --to fmu",
        "export --to mjcf",
        "export --to urdf",
    )
}
"""Commands by the kinds that not all serve yet; where an option decides, it is part of the name: "export --to fmu"."""

NOT_TO_START_WITH: Mapping[tuple[str, str], str] = {
    ("--control", "chain"): "a chain has no motor to be controlled. Add --kind planar.",
    (
        "--control",
        "spatial",
    ): "a new arm in space has no [control] yet. Add --kind planar, or write the table yourself.",
    ("--motors", "chain"): "a chain has no motors at its joints. Add --kind planar.",
    ("--motors", "spatial"): "an arm in space starts with two. Leave it out, or add --kind planar.",
}
"""Why a new scene of a kind does not begin with what an option of `new` asks for."""


def require_served(command: str, scene: Scene) -> Scene:
    """Return a scene that a command serves.

    Raises
    ------
    UserError
        If it does not serve the scene's kind.
    """
    served = SERVED.get(scene.model.kind)
    if served is None or command in served:
        return scene
    raise UserError(f'tmm-gen {command} does not serve kind = "{scene.model.kind}" yet; {_listed(served)} do')


def served_scene(command: str, path: Path) -> Scene:
    """Read a scene for a command that serves it.

    Raises
    ------
    UserError
        If the command does not serve the scene's kind.
    SceneError
        If the scene is not valid.
    """
    from tmm_gen.scene import load_scene

    return require_served(command, load_scene(path))


def _listed(words: tuple[str, ...]) -> str:
    *most, last = words
    return f"{', '.join(most)} and {last}" if most else last
