"""What a kernel occupies: flash and memory."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from tmm_gen.target.boards import Board
from tmm_gen.target.tools import call, need

_FLASH = (".text", ".rodata", ".srodata", ".ARM.ex", ".data", ".sdata")
_MEMORY = (".data", ".sdata", ".bss", ".sbss")


@dataclass(frozen=True)
class Sizes:
    """Bytes of an object file.

    Parameters
    ----------
    flash : int
        Code, constants and initial values of variables.
    memory : int
        Variables.
    functions : dict from str to int
        Code of each function that has a section of its own.
    """

    flash: int
    memory: int
    functions: dict[str, int]


def sizes_of(board: Board, compiled: Path) -> Sizes:
    """Read the sizes of a compiled file.

    Raises
    ------
    UserError
        If binutils are missing.
    """
    size = need(f"{board.prefix}size", board.package.replace("gcc", "binutils"))
    rows = re.findall(r"^(\.\S+)\s+(\d+)\s+\d+$", call([size, "-A", compiled], compiled.parent), re.MULTILINE)
    sections = [(name, int(count)) for name, count in rows]
    return Sizes(
        flash=sum(count for name, count in sections if name.startswith(_FLASH)),
        memory=sum(count for name, count in sections if name.startswith(_MEMORY)),
        functions={
            name.removeprefix(".text."): count for name, count in sections if name.startswith(".text.")
        },
    )
