"""CasADi's functions as C, compiled once for each content."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca

from tmm_gen.native import compile_library

FAST = ("-O2", "-march=native", "-ffp-contract=fast")
LARGE = ("-O1", "-march=native", "-ffp-contract=fast")
LARGE_TEXT = 1_000_000
"""Beyond so many characters -O2 takes minutes, for straight lines that gain nothing from it."""
PACKAGE = Path(ca.__file__).parent
HPIPM = (
    f"-I{PACKAGE / 'include'}",
    f"-L{PACKAGE}",
    f"-Wl,-rpath,{PACKAGE}",
    "-Wl,--no-as-needed",
    "-lhpipm",
    "-lblasfeo",
    "-D_POSIX_C_SOURCE=200112L",
)


def library(write: Callable[[str], None], name: str, more: tuple[str, ...] = ()) -> Path:
    """Compile what is written into a file of a name in the working folder."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory(prefix="tmm-gen-") as folder:
        os.chdir(folder)
        try:
            write(f"{name}.c")
            text = Path(f"{name}.c").read_text()
        finally:
            os.chdir(before)
    flags = LARGE if len(text) > LARGE_TEXT else FAST
    return compile_library({f"{name}.c": text}, flags=(*flags, *more))


def compiled(function: Any, more: tuple[str, ...] = ()) -> Any:
    """Return a function, or solver, as compiled C."""
    return ca.external(function.name(), str(library(function.generate, function.name(), more)))


@dataclass(frozen=True, eq=False)
class External:
    """A function as compiled C, and the options for a compiler of what calls it."""

    function: Any
    options: tuple[str, ...]


def external(function: Any) -> External:
    """Compile a function that others call, from C or by CasADi."""
    path = library(function.generate, function.name())
    options = (f"-L{path.parent}", f"-Wl,-rpath,{path.parent}", "-Wl,--no-as-needed", f"-l:{path.name}")
    return External(ca.external(function.name(), str(path)), options)
