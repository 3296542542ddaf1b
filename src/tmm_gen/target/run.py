"""Running a harness and reading what it prints."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.target.boards import Board
from tmm_gen.target.tools import attempt, need


@dataclass(frozen=True)
class HarnessRun:
    """What a harness printed.

    Parameters
    ----------
    bits : dict from str to str
        Hashes after steps, and the state and outputs at some, in hexadecimal.
    counts : dict from str to list of int
        Ticks, stack, memory: lines with one number.
    """

    bits: dict[str, str]
    counts: dict[str, list[int]]


def run_on(board: Board, program: Path) -> HarnessRun:
    """Run a program on an emulated board.

    Raises
    ------
    UserError
        If the emulator is missing, or the program does not run to its end.
    """
    emulator = need(board.emulator, board.emulator_package)
    return _run([emulator, *board.emulate, "-kernel", program], program.parent, board.title)


def run_here(program: Path) -> HarnessRun:
    """Run a program on this machine.

    Raises
    ------
    UserError
        If it does not run to its end.
    """
    return _run([program], program.parent, "this machine")


def _run(command: list[str | Path], folder: Path, where: str) -> HarnessRun:
    done = attempt(command, folder)
    lines = [line.split(maxsplit=1) for line in done.stdout.splitlines()]
    failed = next((line for line in lines if line[:1] == ["status"]), None)
    if failed is not None:
        function, status = failed[1].split()
        raise UserError(f"on {where} {function} of the kernel fails with status {status}")
    if done.returncode != 0 or not any(line[0] == "ram" for line in lines):
        said = (done.stderr or done.stdout).strip()[-500:]
        raise UserError(f"on {where} the program ended too early ({done.returncode}): {said}")
    bits: dict[str, str] = {}
    counts: dict[str, list[int]] = {}
    for what, rest in lines:
        if what.startswith("hash") or what in ("start", "first", "last", "outputs"):
            bits[what] = rest
        else:
            counts.setdefault(what, []).append(int(rest))
    return HarnessRun(bits, counts)
