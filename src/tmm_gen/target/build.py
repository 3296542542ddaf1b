"""Compiling a kernel with its harness, for a board or for this machine."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.target.boards import Board
from tmm_gen.target.harness import harness
from tmm_gen.target.tools import call, need

HOST = "gcc"
FLAGS = ("-std=c99", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections")
"""The same everywhere: without fused multiply-add, which rounds once where two operations round twice."""
CROSS = (
    "-fno-math-errno",  # sqrt is one instruction
    "-fno-tree-loop-distribute-patterns",  # no calls of memcpy for short loops
)
PAIRS = "-O2"
"""Optimisation of kernels whose numbers are sums of two: it puts their arithmetic where it is called."""
KERNEL = ("-fstack-usage", "-fcallgraph-info=su")


@dataclass(frozen=True)
class Built:
    """What a build leaves in its folder.

    Parameters
    ----------
    folder : Path
        All files.
    program : Path
        Kernel and harness, linked.
    kernel : Path
        The kernel's object file.
    alone : Path
        The kernel linked with what it calls of the C library, and nothing else.
    callgraph : Path
        Functions of the kernel, their frames and calls.
    """

    folder: Path
    program: Path
    kernel: Path
    alone: Path
    callgraph: Path


def build_for(board: Board, kernel: Kernel, sources: dict[str, str], folder: Path) -> Built:
    """Cross-compile a kernel and its harness.

    Parameters
    ----------
    board : Board
        Where it is to run.
    kernel : Kernel
        Prepared for C.
    sources : dict from str to str
        Its header and source by path.
    folder : Path
        Scratch.

    Raises
    ------
    UserError
        If the compiler or its C library is missing, or refuses the sources.
    """
    cc = need(f"{board.prefix}gcc", board.package)
    _need_library(cc, board)
    name = _lay_out(kernel, sources, board.counter, folder)
    optimisation = PAIRS if kernel.real.pair else board.optimisation
    common = (*FLAGS, *CROSS, optimisation, *board.machine, "--specs=picolibc.specs")
    call([cc, *common, *KERNEL, "-c", f"{name}.c", "-o", "kernel.o"], folder)
    call([cc, *common, "-c", "harness.c", "-o", "harness.o"], folder)
    link = (*common[:-1], *board.link, "-Wl,--gc-sections")
    call([cc, *link, "harness.o", "kernel.o", "-lm", "-o", "run.elf"], folder)
    kept = [f"-Wl,-u,{name}_{function}" for function in kernel.functions]
    call(
        [cc, *link, "-nostartfiles", f"-Wl,-e,{name}_step", *kept, "kernel.o", "-lm", "-o", "alone.elf"],
        folder,
    )
    return Built(folder, folder / "run.elf", folder / "kernel.o", folder / "alone.elf", folder / "kernel.ci")


def build_here(kernel: Kernel, sources: dict[str, str], folder: Path) -> Path:
    """Compile a kernel and its harness for this machine.

    Raises
    ------
    UserError
        If the compiler is missing or refuses the sources.
    """
    cc = need(HOST, "gcc libc6-dev")
    name = _lay_out(kernel, sources, "none", folder)
    call([cc, *FLAGS, "-O2", f"{name}.c", "harness.c", "-lm", "-o", "run"], folder)
    return folder / "run"


def _lay_out(kernel: Kernel, sources: dict[str, str], counter: str, folder: Path) -> str:
    folder.mkdir(parents=True, exist_ok=True)
    for path, text in sources.items():
        (folder / PurePosixPath(path).name).write_text(text, encoding="utf-8")
    (folder / "harness.c").write_text(harness(kernel, counter), encoding="utf-8")
    return kernel.program.name


def _need_library(cc: str, board: Board) -> None:
    from tmm_gen.errors import UserError

    found = call([cc, "-print-file-name=picolibc.specs"], Path.cwd()).strip()
    if not Path(found).is_absolute():
        raise UserError(
            f"picolibc for {board.title} was not found; install it (Debian, Ubuntu: apt-get install {board.library})"
        )
