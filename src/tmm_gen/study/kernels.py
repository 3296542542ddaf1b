"""Kernels of families: built and compiled once in a process, used at every step."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

from tmm_gen.scene import Scene

if TYPE_CHECKING:
    from tmm_gen.native.kernel import NativeKernel
    from tmm_gen.program.count import Operations
    from tmm_gen.program.statements import Program


@dataclass(frozen=True, eq=False)
class Built:
    """A kernel that can be run.

    Parameters
    ----------
    scene : Scene
        It is built for; its step is that of some member of the family.
    program : Program
        What was emitted.
    operations : Operations
        Of one step.
    """

    scene: Scene
    program: Program
    operations: Operations

    @cached_property
    def files(self) -> dict[str, str]:
        """The emitted C, texts by path."""
        from tmm_gen.emit.c import emit_kernel, free_scene

        return emit_kernel(self.program, free_scene(self.scene))

    @cached_property
    def native(self) -> NativeKernel:
        """The compiled C; its model and state are shared."""
        from tmm_gen.native.loading import load_kernel

        return load_kernel(self.program, self.scene, self.files)

    @cached_property
    def sizes(self) -> dict[str, int | None]:
        """Bytes of the C: ``code_bytes``, ``state_bytes``, ``model_bytes``; see :func:`code_size`."""
        from tmm_gen.c_language.real import real_of
        from tmm_gen.emit.c.structs import structs_of
        from tmm_gen.study.code_size import code_size

        real = real_of(self.scene.emit)
        structs = {struct.name: struct.size(real) for struct in structs_of(self.program)}
        return {
            "code_bytes": code_size(self.files),
            "state_bytes": structs["state"],
            "model_bytes": structs["model"],
        }

    @cached_property
    def module(self) -> Any:
        """The generated NumPy package."""
        from tmm_gen.native.python_module import numpy_module

        return numpy_module(self.scene, self.program)


@lru_cache(maxsize=256)
def build(scene: Scene) -> Built:
    """Derive and build the program of a scene. Equal scenes share it.

    Raises
    ------
    UserError
        If the scene asks for something that does not exist.
    """
    from tmm_gen.program.build import build_program
    from tmm_gen.program.count import count_routine

    program = build_program(scene)
    return Built(scene, program, count_routine(program.main))
