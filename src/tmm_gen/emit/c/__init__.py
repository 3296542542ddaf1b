"""C99: caller-owned structs, no heap, no globals, error codes, ``<math.h>`` only."""

from __future__ import annotations

from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.vectors import vectors
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene

__all__ = ["emit_c"]


def emit_c(program: Program, scene: Scene) -> dict[str, str]:
    """Write a program as C.

    Parameters
    ----------
    program : Program
        As built: it is lowered here.
    scene : Scene
        Gives the number type, and the digest for the headers.

    Returns
    -------
    dict of str to str
        Texts by path inside the scene's package: ``c/<name>.h``, ``c/<name>.c``, ``c/test_<name>.c``,
        ``c/CMakeLists.txt``.

    Raises
    ------
    UserError
        If a number of the scene is out of the range of its number type.
    """
    kernel = Kernel.of(program, scene)
    name = program.name
    context = {"kernel": kernel, "name": name, "NAME": name.upper()}
    return {
        f"c/{name}.h": sealed(render("c/kernel.h.jinja", **context)),
        f"c/{name}.c": sealed(render("c/kernel.c.jinja", **context)),
        f"c/test_{name}.c": sealed(render("c/test.c.jinja", **context, vectors=vectors(kernel))),
        "c/CMakeLists.txt": sealed(render("c/CMakeLists.txt.jinja", **context)),
    }
