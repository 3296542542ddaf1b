"""All files of a scene's generated package."""

from __future__ import annotations

from collections.abc import Callable

from tmm_gen.backends import backend_named
from tmm_gen.emit.seal import is_intact
from tmm_gen.program.build import build_program
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene

Emitter = Callable[[Program, Scene], dict[str, str]]
"""What a backend is: it prints a program as texts by path inside the package, each with its seal."""


def emit_package(scene: Scene) -> dict[str, str]:
    """Derive, build and print a scene for its backends.

    Parameters
    ----------
    scene : Scene
        What to generate; ``scene.emit.backends`` says for which languages.

    Returns
    -------
    dict from str to str
        Text by path inside the package, sorted by path.

    Raises
    ------
    UserError
        If the scene asks for something that cannot be generated.
    """
    program = build_program(scene)
    files: dict[str, str] = {}
    for backend in scene.emit.backends:
        place = backend_named(backend)
        assert place is not None  # scenes name none else
        emitter: Emitter = place.load()
        for path, text in emitter(program, scene).items():
            if path in files or not is_intact(text):
                raise ValueError(f"backend {backend}: {path} is written twice or not sealed")
            files[path] = text
    return dict(sorted(files.items()))
