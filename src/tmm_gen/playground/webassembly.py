"""Compiling emitted C to WebAssembly, by the compiler that the package `ziglang` brings."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.extras import extra
from tmm_gen.scratch import scratch_folder

EXPORTS = ("playground_address", "playground_begin", "playground_advance")
"""What a page calls."""

STACK = 1 << 18
"""Bytes; a step of a long arm keeps its sweeps there."""


def require_compiler() -> None:
    """Say early where there is no compiler.

    Raises
    ------
    UserError
        If the package is not installed.
    """
    extra("playground", "the playground")


def compile_module(name: str, sources: Mapping[str, str]) -> bytes:
    """Compile a kernel and what drives it into one module without imports.

    The C brings all it needs but four functions of ``<math.h>``, which are instructions of the machine: no C library is
    linked.

    Parameters
    ----------
    name : str
        The kernel's.
    sources : mapping from str to str
        Texts of its header and source by path, and of ``arm.c``, which includes them.

    Raises
    ------
    UserError
        If there is no compiler, or it refuses the sources.
    """
    require_compiler()
    with scratch_folder() as folder:
        for path, text in sources.items():
            (folder / PurePosixPath(path).name).write_text(text)
        library = folder / "library"
        library.mkdir()
        (library / "math.h").write_text(render("playground/math.h"))
        target = ("-target", "wasm32-freestanding", "-mbulk-memory")
        exact = ("-std=c99", "-O2", "-ffp-contract=off", "-isystem", "library")
        _zig(name, folder, "cc", *target, *exact, "-c", "arm.c", "-o", "arm.o")
        exported = [f"--export={function}" for function in EXPORTS]
        alone = ("--no-entry", "--strip-all", "-z", f"stack-size={STACK}", "--stack-first")
        _zig(name, folder, "wasm-ld", *alone, *exported, "arm.o", "-o", "arm.wasm")
        return (folder / "arm.wasm").read_bytes()


def _zig(name: str, folder: Path, *words: str) -> None:
    # what it would keep between calls takes longer to find than to make again
    cache = str(folder / "cache")
    own = {"ZIG_GLOBAL_CACHE_DIR": cache, "ZIG_LOCAL_CACHE_DIR": cache}
    command = [sys.executable, "-m", "ziglang", *words]
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, **own}, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        said = " ".join(done.stderr.split())[:2000]
        raise UserError(f"scene '{name}': 'zig {' '.join(words)}' failed: {said}")
