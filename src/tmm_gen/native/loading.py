"""Compiled kernels of programs: emitted as C, compiled for this machine and loaded."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence

from tmm_gen.c_language.real import real_of
from tmm_gen.emit.c import emit_kernel, free_scene
from tmm_gen.emit.templates import render
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.native.kernel import NativeKernel
from tmm_gen.native.library import Library
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene


def compile_kernel(
    program: Program, scene: Scene, cc: str = "gcc", flags: Sequence[str] = FLAGS
) -> NativeKernel:
    """Emit a program as C, compile it and load it; its parameters are free even where the scene binds them.

    A bound kernel gives the same bits.

    Parameters
    ----------
    program : Program
        As built for the scene.
    scene : Scene
        Gives the number type.
    cc : str
        Compiler.
    flags : sequence of str
        Options besides ``-std=c99``.

    Raises
    ------
    UserError
        If there is no such compiler, or it refuses the sources.
    """
    return load_kernel(program, scene, emit_kernel(program, free_scene(scene)), cc, flags)


def load_kernel(
    program: Program,
    scene: Scene,
    files: Mapping[str, str],
    cc: str = "gcc",
    flags: Sequence[str] = FLAGS,
) -> NativeKernel:
    """Compile and load what :func:`emit_kernel` has written; see :func:`compile_kernel`."""
    sources = {**files, "c/kernel-harness.c": render("c/harness.c.jinja", name=program.name)}
    handle = ctypes.CDLL(str(compile_library(sources, cc, flags)))
    return NativeKernel(program, Library(program, real_of(scene.emit), handle))
