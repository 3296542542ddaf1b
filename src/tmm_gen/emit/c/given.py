"""What ``initialise`` starts from: the caller's arrays, or where he gives none, the scene's own numbers."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, WIDTH, comment, statement
from tmm_gen.emit.c.structs import described, dimension
from tmm_gen.emit.expressions import element
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Ref, Variable


def given_element(ref: Ref, real: Real) -> str:
    """Write an element of an array that may be absent."""
    variable = ref.variable
    values = _values(variable)
    own = _literal(values[0], real) if len(set(values)) == 1 else element(_table(variable), ref)
    return f"({variable.name} != NULL ? {element(variable.name, ref)} : {own})"


def given_tables(program: Program, real: Real) -> Iterator[str]:
    """Yield tables of the scene's start where it differs from station to station."""
    for variable in program.given:
        values = _values(variable)
        if len(set(values)) == 1:
            continue
        numbers = ", ".join(_literal(value, real) for value in values)
        yield from comment(f"The scene's {described(variable)}.", 0)
        yield f"static const real {_table(variable)}{dimension(variable, program)} = {{"
        yield from (INDENT + line for line in textwrap.wrap(numbers, WIDTH - len(INDENT)))
        yield "};"
        yield ""


def given_checks(program: Program, failure: str) -> Iterator[str]:
    """Yield lines that leave a function where an array that is there has a number that is not finite."""
    by_length: dict[str, list[str]] = {}
    for variable in program.given:
        by_length.setdefault(dimension(variable, program), []).append(variable.name)
    for length, names in by_length.items():
        bad = " || ".join(f"({name} != NULL && !isfinite({name}[j]))" for name in names)
        yield f"{INDENT}for (int j = 0; j < {length[1:-1]}; ++j) {{"
        yield from statement(f"if ({bad}) {{", 2)
        yield f"{INDENT * 3}return {failure};"
        yield f"{INDENT * 2}}}"
        yield f"{INDENT}}}"


def _values(variable: Variable) -> tuple[float, ...]:
    default = variable.default
    return default if isinstance(default, tuple) else (default or 0.0,)


def _table(variable: Variable) -> str:
    return f"scene_{variable.name}"


def _literal(value: float, real: Real) -> str:
    return real.literal(value) if value >= 0.0 else f"-{real.literal(-value)}"
