"""What a step of a scene costs on a microcontroller, and whether it gives the bits it gives here."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.errors import UserError
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.scratch import scratch_folder
from tmm_gen.target.bits import Difference, compare_bits
from tmm_gen.target.boards import BOARDS, Board
from tmm_gen.target.build import build_for, build_here
from tmm_gen.target.harness import STEPS
from tmm_gen.target.run import HarnessRun, run_here, run_on
from tmm_gen.target.sizes import sizes_of
from tmm_gen.target.stack import worst_stack

NOTHING = 2
"""Instructions of the harness's empty function: set the result, return."""


@dataclass(frozen=True)
class Measurement:
    """The cost of a scene's kernel on a target.

    Parameters
    ----------
    target, title : str
        The board.
    real : str
        Number type.
    instructions_per_step : int
        Of the longest step in the run, from its first instruction to its return.
    instructions_least : int
        Of the shortest: the same where a step takes constant time.
    step_bytes : int
        Code of the step.
    code_bytes : int
        Flash: all functions and constants of the kernel, and of the C library what they call.
    ram_bytes : int
        Model, state, inputs and outputs, and static variables, of which there are none.
    stack_bytes : int
        Deepest stack of a step.
    stack_proved : bool
        Whether that follows from the call graph; else functions of the C library are among those called, and it is
        what a run used.
    bits_equal : bool
        Whether every step gives the bits it gives on this machine.
    difference : Difference
        Where not: how far apart.
    library_functions : tuple of str
        Functions of the C library that a step calls.
    steps : int
        Length of the run.
    hardware_reals : tuple of str
        Number types the target's floating-point unit has.
    """

    target: str
    title: str
    real: str
    instructions_per_step: int
    instructions_least: int
    step_bytes: int
    code_bytes: int
    ram_bytes: int
    stack_bytes: int
    stack_proved: bool
    bits_equal: bool
    difference: Difference
    library_functions: tuple[str, ...]
    steps: int
    hardware_reals: tuple[str, ...]


def measure(scene: Scene, target: str) -> Measurement:
    """Compile a scene's kernel for a target, run it in an emulator and on this machine, and compare.

    Parameters
    ----------
    scene : Scene
        Of any kind; ``scene.emit`` says how its C is written.
    target : str
        Key of :data:`BOARDS`.

    Raises
    ------
    UserError
        If there is no such target, a program that is needed is missing, or the kernel fails on its own scene.
    """
    if target not in BOARDS:
        raise UserError(f"no target is called '{target}'; there are {', '.join(BOARDS)}")
    board = BOARDS[target]
    program = build_program(scene)
    kernel, sources = Kernel.of(program, scene), emit_kernel(program, scene)
    with scratch_folder() as scratch:
        built = build_for(board, kernel, sources, Path(scratch, "board"))
        there = run_on(board, built.program)
        here = run_here(build_here(kernel, sources, Path(scratch, "host")))
        sizes = sizes_of(board, built.kernel)
        depth = worst_stack(built.callgraph.read_text(), f"{scene.name}_step")
        measured = there.counts["stack_taken"][0]
        difference = compare_bits(here, there, kernel.real)
        return Measurement(
            target=target,
            title=board.title,
            real=scene.emit.real,
            instructions_per_step=_instructions(board, there, "ticks_most"),
            instructions_least=_instructions(board, there, "ticks_least"),
            step_bytes=sizes.functions[f"{scene.name}_step"],
            code_bytes=sizes_of(board, built.alone).flash,
            ram_bytes=there.counts["ram"][0] + sizes.memory,
            stack_bytes=max(measured, depth.bytes) if depth.unknown else depth.bytes,
            stack_proved=not depth.unknown,
            bits_equal=difference.equal,
            difference=difference,
            library_functions=depth.unknown,
            steps=STEPS,
            hardware_reals=board.hardware_reals,
        )


def _instructions(board: Board, run: HarnessRun, which: str) -> int:
    around = run.counts["ticks_of_nothing"][-1]
    return round((run.counts[which][0] - around) / board.ticks_per_instruction) + NOTHING
