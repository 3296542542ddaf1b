"""An emitted controller on an emulated microcontroller, over a recorded closed loop: bits, instructions, memory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tmm_gen.c_language.real import REALS
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.onboard.folder import library_sources
from tmm_gen.onboard.tables import table
from tmm_gen.onboard.text import macro_prefix
from tmm_gen.scratch import scratch_folder
from tmm_gen.target.boards import BOARDS, Board
from tmm_gen.target.build import CROSS, FLAGS, HOST
from tmm_gen.target.sizes import sizes_of
from tmm_gen.target.tools import attempt, call, need

NOTHING = 2
"""Instructions of the harness's empty function: set the result, return."""


@dataclass(frozen=True)
class BoardRun:
    """What a controller costs on a board.

    Parameters
    ----------
    target, title, real : str
        Board and number type.
    instructions_per_sample : int
        Of the longest sample of the closed loop.
    instructions_median : int
        Of half of its samples at most.
    instructions_feedback : int
        From a measurement to its torque, of the longest sample.
    instructions_reset : int
        Of starting anew, which finds the matrices of controllers that renew them, and so takes what that does.
    code_bytes : int
        Flash: functions and tables of controller and solver, and of the C library what they call.
    ram_bytes : int
        The controller's memory, and static variables.
    stack_bytes : int
        Deepest stack of a sample, as used by the closed loop.
    bits_equal : bool
        Whether every torque has the bits it has on this machine.
    torque_off : float
        By how much a torque is another than on this machine, N m: predictions take the C library's sines, and these
        differ.
    samples : int
        Length of the closed loop.
    fallbacks : int
        Samples whose status was not OK.
    """

    target: str
    title: str
    real: str
    instructions_per_sample: int
    instructions_median: int
    instructions_feedback: int
    instructions_reset: int
    code_bytes: int
    ram_bytes: int
    stack_bytes: int
    bits_equal: bool
    torque_off: float
    samples: int
    fallbacks: int


def run_on_board(
    target: str, name: str, files: Mapping[str, str], measured: NDArray[np.float64], real: str = "float64"
) -> BoardRun:
    """Cross-compile a controller, run it on an emulated board and on this machine, and compare.

    Parameters
    ----------
    target : str
        Key of :data:`tmm_gen.target.boards.BOARDS`.
    name : str
        Prefix of the controller's functions.
    files : mapping of str to str
        As emitted.
    measured : array, (samples, sensors)
        What its sensors showed in a closed loop.
    real : {"float64", "float32"}
        Number type it was emitted in.

    Raises
    ------
    UserError
        If there is no such target, or a program that is needed is missing.
    """
    if target not in BOARDS:
        raise UserError(f"no target is called '{target}'; there are {', '.join(BOARDS)}")
    board = BOARDS[target]
    with scratch_folder() as scratch:
        folder = Path(scratch, "board")
        sources = _lay_out(folder, name, files, measured, real, board.counter)
        program, alone, static = _cross_compiled(board, name, sources, folder)
        emulator = need(board.emulator, board.emulator_package)
        there = _lines([emulator, *board.emulate, "-kernel", program], folder, board.title)
        here = _here(Path(scratch, "host"), name, files, measured, real)
        samples = [words[1:] for words in there if words[0] == "torque"]
        around = np.array([words[1:] for words in there if words[0] == "nothing"][-1], int)
        ticks = np.array([words[-2:] for words in samples], int) - around
        phases = np.rint(ticks / board.ticks_per_instruction).astype(int) + NOTHING
        counts = phases.sum(axis=1)
        return BoardRun(
            target=target,
            title=board.title,
            real=real,
            instructions_per_sample=int(counts.max()),
            instructions_median=int(np.median(counts)),
            instructions_feedback=int(phases[:, 1].max()),
            instructions_reset=int(_number(there, "reset") / board.ticks_per_instruction),
            code_bytes=sizes_of(board, alone).flash,
            ram_bytes=_number(there, "ram") + static,
            stack_bytes=_number(there, "stack"),
            bits_equal=[row[:3] for row in samples] == [row[1:4] for row in here if row[0] == "torque"],
            torque_off=float(np.max(np.abs(_torques(there, real) - _torques(here, real)))),
            samples=len(samples),
            fallbacks=sum(row[1] != "0" for row in samples),
        )


def _here(
    folder: Path, name: str, files: Mapping[str, str], measured: NDArray[np.float64], real: str
) -> list[list[str]]:
    sources = _lay_out(folder, name, files, measured, real, "none")
    cc = need(HOST, "gcc libc6-dev")
    call([cc, *FLAGS, "-O2", "-I.", *sources, "harness.c", "-lm", "-o", "run"], folder)
    return _lines([folder / "run"], folder, "this machine")


def _lay_out(
    folder: Path,
    name: str,
    files: Mapping[str, str],
    measured: NDArray[np.float64],
    real: str,
    counter: str,
) -> list[str]:
    """Write all sources into a folder and return those of the controller."""
    prefix = macro_prefix(name)
    seen = table("measured", measured, f"[SAMPLES][{prefix}_SENSORS]", REALS[real])
    harness = render(
        "control/board.c.jinja",
        name=name,
        NAME=prefix,
        samples=len(measured),
        torques=f"{prefix}_MOTORS" if f"define {prefix}_MOTORS" in files[f"{name}.h"] else "1",
        counter=counter,
        table=seen,
    )
    for path, text in {**files, "harness.c": harness}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return library_sources(files)


def _cross_compiled(board: Board, name: str, sources: list[str], folder: Path) -> tuple[Path, Path, int]:
    """Return the program, the controller linked alone, and its bytes of static variables."""
    cc = need(f"{board.prefix}gcc", board.package)
    common = (*FLAGS, *CROSS, board.optimisation, *board.machine, "-I.")
    objects = []
    static = 0
    for source in (*sources, "harness.c"):
        compiled = source.replace("/", "_").replace(".c", ".o")
        call([cc, *common, "--specs=picolibc.specs", "-c", source, "-o", compiled], folder)
        if source != "harness.c":
            objects.append(compiled)
            static += sizes_of(board, folder / compiled).memory
    link = (*common, *board.link, "-Wl,--gc-sections")
    call([cc, *link, "harness.o", *objects, "-lm", "-o", "run.elf"], folder)
    kept = [f"-Wl,-u,{name}_{function}" for function in ("reset", "command")]
    alone = ("-nostartfiles", f"-Wl,-e,{name}_command_valid", *kept)
    call([cc, *link, *alone, *objects, "-lm", "-o", "alone.elf"], folder)
    return folder / "run.elf", folder / "alone.elf", static


def _lines(command: list[str | Path], folder: Path, where: str) -> list[list[str]]:
    done = attempt(command, folder)
    lines = [line.split() for line in done.stdout.splitlines() if line.strip()]
    if done.returncode != 0 or not any(words[0] == "ram" for words in lines):
        said = (done.stderr or done.stdout).strip()[-500:]
        raise UserError(f"on {where} the controller ended too early ({done.returncode}): {said}")
    return lines


def _number(lines: list[list[str]], what: str) -> int:
    return next(int(words[1]) for words in lines if words[0] == what)


def _torques(lines: list[list[str]], real: str) -> NDArray[np.float64]:
    """Return the torques of all samples, from their bits."""
    bits = b"".join(bytes.fromhex(words[1]) for words in lines if words[0] == "torque")
    return np.frombuffer(bits, np.dtype(real)).astype(float)
