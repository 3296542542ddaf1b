"""Emitted C for GPUs, as it is: one arm in each thread, which takes all its steps without coming back.

What NVRTC compiles (the compiler that CuPy and others bring along) is header and source of the kernel, unchanged, and
the function below, by which threads read and write: numbers of many arms stand side by side, so that neighbouring
threads touch neighbouring memory.
"""

from __future__ import annotations

import ctypes
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from tmm_gen.c_language.real import real_of
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.structs import structs_of
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.extras import extra
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene

OPTIONS = ("-default-device", "--std=c++17", "--fmad=false")
"""Of NVRTC: functions of the C code are the device's, and multiplications and additions stay apart, as on the host."""
_INCLUDE = re.compile(r"^#include <(\w+\.h)>\n", re.MULTILINE)
_DEFINED = """\
#define FLT_MAX 3.40282346638528859812e+38F
#define DBL_MAX 1.7976931348623157e+308
typedef unsigned int uint32_t;
typedef unsigned long long uint64_t;
typedef int int32_t;
typedef long long int64_t;
"""
"""What a kernel needs of the C library's headers, of which NVRTC has none; its functions it knows without them."""


@dataclass(frozen=True)
class Compiled:
    """A kernel for a kind of GPU.

    Parameters
    ----------
    cubin : bytes
        Machine code.
    registers : int
        Of a thread.
    stack, spilled : int
        Bytes of a thread in memory: arrays and all; registers that did not suffice, stored and loaded.
    """

    cubin: bytes
    registers: int
    stack: int
    spilled: int


def cuda_source(program: Program, scene: Scene) -> str:
    """Write a scene's kernel for many arms on a GPU.

    Parameters
    ----------
    program : Program
        As built for the scene.
    scene : Scene
        Gives the number type.

    Returns
    -------
    str
        In one file, for NVRTC with :data:`OPTIONS`; the function is called ``<name>_run``.

    Raises
    ------
    UserError
        If the scene's C has parameters bound, or keeps numbers as sums of two: threads have arms of their own, and
        one number each.
    """
    if scene.emit.parameters == "bound" or scene.emit.compensated:
        raise UserError(
            f"scene '{scene.name}': on a GPU arms may differ, and their numbers are single ones. "
            'Write parameters = "free", and leave compensated out.'
        )
    name = program.name
    # threads are lanes already
    texts = emit_kernel(program, scene.replace(**{"emit.favour": "size"}) if program.vectors else scene)
    structs = {struct.name: struct for struct in structs_of(program)}
    numbers = {which: sum(field.numbers for field in struct.fields) for which, struct in structs.items()}
    kernel = render(
        "cuda/run.cu.jinja",
        name=name,
        numbers=numbers,
        words=real_of(scene.emit).size // 4,
        counter=structs["state"].counter,
        inputs=program.inputs,
    )
    source = texts[f"c/{name}.c"].replace(f'#include "{name}.h"\n', texts[f"c/{name}.h"])
    others = "".join(dict.fromkeys(found[0] for found in _INCLUDE.finditer(source)))
    head = f"#ifdef __CUDACC_RTC__\n{_DEFINED}#else\n{others}#endif\n"
    return f"{head}{_INCLUDE.sub('', source)}\n{kernel}"


def compile_cuda(source: str, architecture: str = "sm_90") -> Compiled:
    """Compile what :func:`cuda_source` wrote; no GPU is needed.

    Parameters
    ----------
    source : str
        In CUDA's C++.
    architecture : str
        Kind of GPU: "sm_80" is an A100, "sm_90" an H100 or H200.

    Raises
    ------
    UserError
        If NVRTC is not installed, or refuses the source.
    """
    library = _nvrtc()
    with _Programme(library, source) as held:
        options = [*OPTIONS, f"--gpu-architecture={architecture}", "--ptxas-options=-v"]
        failed = library.nvrtcCompileProgram(held, len(options), _texts(options))
        log = _filled(library.nvrtcGetProgramLogSize, library.nvrtcGetProgramLog, held).decode()
        if failed:
            raise UserError(f"NVRTC refuses the source for {architecture}: {' '.join(log.split())[:400]}")
        cubin = _filled(library.nvrtcGetCUBINSize, library.nvrtcGetCUBIN, held)
    found = re.search(
        r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads\s*ptxas info\s*: Used (\d+)",
        log,
    )
    if found is None:
        raise RuntimeError(f"NVRTC's log says nothing of registers: {log[:400]}")
    stack, stored, loaded, registers = map(int, found.groups())
    return Compiled(cubin, registers, stack, stored + loaded)


class _Programme:
    """A program of NVRTC, as long as it is needed."""

    def __init__(self, library: Any, source: str) -> None:
        self._library, self._held = library, ctypes.c_void_p()
        if library.nvrtcCreateProgram(ctypes.byref(self._held), source.encode(), b"arms.cu", 0, None, None):
            raise RuntimeError("NVRTC cannot make a program")

    def __enter__(self) -> ctypes.c_void_p:
        return self._held

    def __exit__(self, *_error: object) -> None:
        self._library.nvrtcDestroyProgram(ctypes.byref(self._held))


def _texts(texts: list[str]) -> Any:
    return (ctypes.c_char_p * len(texts))(*(text.encode() for text in texts))


def _filled(size_of: Any, fill: Any, held: ctypes.c_void_p) -> bytes:
    size = ctypes.c_size_t()
    size_of(held, ctypes.byref(size))
    room = ctypes.create_string_buffer(size.value)
    fill(held, room)
    return room.raw


@cache
def _nvrtc() -> Any:
    module = extra("cuda", "a kernel for GPUs")
    found = sorted(path for folder in module.__path__ for path in Path(folder).glob("lib/libnvrtc.so.*"))
    if not found:
        raise UserError(
            f"{module.__name__} has no libnvrtc.so: it is for another system. Install that of Linux."
        )
    return ctypes.CDLL(str(found[0]))
