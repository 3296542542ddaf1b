"""C99: caller-owned structs, no heap, no globals, error codes, ``<math.h>`` only."""

from __future__ import annotations

from tmm_gen.c_language.names import macros
from tmm_gen.emit.c.batch import emit_batch
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.sensitivities import emit_sensitivities
from tmm_gen.emit.c.vectors import vectors
from tmm_gen.emit.seal import WITHOUT_MOTION, sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene

__all__ = ["emit_c", "emit_c_batch", "emit_kernel", "free_scene"]


def emit_kernel(program: Program, scene: Scene) -> dict[str, str]:
    """Write a program's header and source only: its test takes a simulation in 30 digits to write.

    Raises
    ------
    UserError
        As :func:`emit_c` does.
    """
    return _kernel_files(Kernel.of(program, scene))


def emit_c_batch(program: Program, scene: Scene) -> dict[str, str]:
    """Write header and source of the kernel, and of the one for many arms.

    Raises
    ------
    ValueError
        If the scene asks for no batch.
    UserError
        As :func:`emit_c` does.
    """
    if scene.emit.batch is None:
        raise ValueError(f"{scene.name}: emit.batch is not set")
    kernel = Kernel.of(program, scene)
    return {**_kernel_files(kernel), **emit_batch(kernel)}


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
        ``c/CMakeLists.txt``; ``c/<name>_batch.h`` and ``.c`` where the scene asks for arms side by side.

    Raises
    ------
    UserError
        If a number of the scene is out of the range of its number type.
    """
    kernel = Kernel.of(program, scene)
    return {
        **_kernel_files(kernel),
        **emit_batch(kernel),
        f"c/test_{program.name}.c": _filled(
            "test.c", kernel, vectors=vectors(kernel), without=WITHOUT_MOTION
        ),
        "c/CMakeLists.txt": _filled("CMakeLists.txt", kernel),
    }


def free_scene(scene: Scene) -> Scene:
    """Return a scene whose C takes parameters and step when it runs, whatever it asks for itself."""
    return scene if scene.emit.parameters == "free" else scene.replace(**{"emit.parameters": "free"})


def _kernel_files(kernel: Kernel) -> dict[str, str]:
    name = kernel.program.name
    return {
        f"c/{name}.h": _filled("kernel.h", kernel),
        f"c/{name}.c": _filled("kernel.c", kernel),
        **emit_sensitivities(kernel),
    }


def _filled(template: str, kernel: Kernel, **more: object) -> str:
    name = kernel.program.name
    return sealed(render(f"c/{template}.jinja", kernel=kernel, name=name, NAME=macros(name), **more))
