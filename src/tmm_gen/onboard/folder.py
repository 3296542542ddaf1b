"""What makes sources a folder that a stranger can compile: how to build it, and a program to begin with."""

from __future__ import annotations

from collections.abc import Mapping

from tmm_gen.emit.templates import render
from tmm_gen.onboard.example_arm import ExampleArm
from tmm_gen.onboard.text import ControllerText

EXAMPLE = "example/example.c"
"""The only source with a ``main``, in a folder of its own, so that the others can be taken all together."""

CMAKE = "CMakeLists.txt"
"""How to build it."""


def library_sources(files: Mapping[str, str]) -> list[str]:
    """Return the sources of a controller, without its example."""
    return sorted(path for path in files if path.endswith(".c") and path != EXAMPLE)


def complete(mpc: ControllerText, files: Mapping[str, str], arm: ExampleArm) -> dict[str, str]:
    """Return the files with how to build them and an example.

    Parameters
    ----------
    mpc : ControllerText
        Of the controller.
    files : mapping of str to str
        Its sources by path.
    arm : ExampleArm
        What the example controls.
    """
    context = {"mpc": mpc, "name": mpc.name, "NAME": mpc.NAME, "sources": library_sources(files), "arm": arm}
    return {
        **files,
        EXAMPLE: render("control/example.c.jinja", **context),
        CMAKE: render("control/CMakeLists.txt.jinja", **context),
    }
