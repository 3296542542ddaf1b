"""Numbers of a scene as C has them: constants of a kernel whose parameters are bound, defaults of any other."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, WIDTH, comment
from tmm_gen.emit.c.bind import bind
from tmm_gen.emit.c.pair import pair_literal
from tmm_gen.emit.c.structs import described, dimension
from tmm_gen.emit.runs import Run, runs
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable


def constants(program: Program, real: Real) -> Iterator[str]:
    """Yield declarations of what is bound at generation and read when the kernel runs."""
    routines = (program.initialise, *program.steps, program.output)
    read = frozenset().union(*(routine.read() for routine in routines))
    for variable, values in bind(program, real).items():
        if variable in read:
            yield from _constant(variable, values, program, real)


def _constant(variable: Variable, values: tuple[float, ...], program: Program, real: Real) -> list[str]:
    remark = comment(described(variable), 0)
    literal = pair_literal if real.pair else real.shortest
    head = f"static const {'pair' if real.pair else 'real'} {variable.name}{dimension(variable, program)} ="
    if variable.length is None:
        line = f"{head} {literal(values[0])};"
        beside = f"{line} {remark[0]}"
        return [beside] if len(remark) == 1 and len(beside) <= WIDTH else [*remark, line]
    numbers = textwrap.wrap(", ".join(map(literal, values)), WIDTH - len(INDENT))
    return [*remark, f"{head} {{", *(INDENT + line for line in numbers), "};"]


def defaults(program: Program, real: Real) -> Iterator[tuple[Variable, list[str], tuple[Run, ...] | None]]:
    """Yield parameters with their numbers as literals, those of arrays in lines that fit, and their long runs."""
    for variable in program.parameters:
        values = variable.default if isinstance(variable.default, tuple) else (variable.default,)
        literal = pair_literal if real.pair else real.literal
        numbers = ", ".join(literal(value) for value in values if value is not None)
        found = runs(variable.default) if isinstance(variable.default, tuple) else None
        yield variable, textwrap.wrap(numbers, WIDTH - 2 * len(INDENT)), found


def default_step(program: Program, real: Real) -> str:
    """Return the scene's time step as a literal."""
    step = program.step.default
    assert isinstance(step, float)
    return f"(({program.name}_pair){pair_literal(step)})" if real.pair else real.literal(step)
