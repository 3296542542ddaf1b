"""What makes sources a folder that a stranger can compile: how to build it, and programs to begin with."""

from __future__ import annotations

from collections.abc import Mapping

from tmm_gen.emit.templates import render
from tmm_gen.onboard.example_arm import ExampleArm
from tmm_gen.onboard.loop_arm import LoopArm
from tmm_gen.onboard.loop_text import LOOP, PLANT, loop_files
from tmm_gen.onboard.text import ControllerText

EXAMPLE = "example/example.c"
"""It has a ``main`` of its own, as all in its folder have."""

CMAKE = "CMakeLists.txt"
"""How to build it."""


def library_sources(files: Mapping[str, str]) -> list[str]:
    """Return the sources of a controller, without its examples."""
    beside = (EXAMPLE, LOOP, f"{PLANT}/")
    return sorted(path for path in files if path.endswith(".c") and not path.startswith(beside))


def complete(
    mpc: ControllerText, files: Mapping[str, str], arm: ExampleArm, real_time: LoopArm | None = None
) -> dict[str, str]:
    """Return the files with how to build them and examples.

    Parameters
    ----------
    mpc : ControllerText
        Of the controller.
    files : mapping of str to str
        Its sources by path.
    arm : ExampleArm
        What the example controls.
    real_time : LoopArm, optional
        What a loop in real time controls; by default there is none.
    """
    more = {} if real_time is None else loop_files(mpc, real_time)
    context = {
        "mpc": mpc,
        "name": mpc.name,
        "NAME": mpc.NAME,
        "sources": library_sources(files),
        "arm": arm,
        "plant_sources": sorted(path for path in more if path.endswith(".c")),
    }
    return {
        **files,
        EXAMPLE: render("control/example.c.jinja", **context),
        **more,
        CMAKE: render("control/CMakeLists.txt.jinja", **context),
    }
