"""Checks that numbers are finite."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.c_language.names import macros, member
from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, comment, statement
from tmm_gen.emit.c.structs import dimension
from tmm_gen.program.passes.accesses import written_elements
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable

TOTAL = "total"
"""What sums are called of which only it counts whether they are finite."""


def finite_checks(
    pointer: str,
    variables: tuple[Variable, ...],
    program: Program,
    failure: str,
    zero: str,
    pairs: bool = False,
) -> Iterator[str]:
    """Yield lines that leave a function unless all of some variables are finite.

    Parameters
    ----------
    pointer : str
        What stands before their names, "inputs->" for example.
    variables : tuple of Variable
        Scalars and arrays.
    program : Program
        Whose macros give the lengths of arrays.
    failure : str
        What to return.
    zero : str
        Literal.
    pairs : bool
        Whether they are sums of two numbers, of which both are looked at.
    """
    by_length: dict[str, list[str]] = {}
    for variable in variables:
        name = pointer + member(variable, program.name)
        by_length.setdefault(dimension(variable, program), []).append(name)
    numbers = ("{0}.high", "{0}.low") if pairs else ("{0}",)
    single = [number.format(name) for name in by_length.pop("", []) for number in numbers]
    if len(single) <= 2 and not by_length:
        yield from check(single, failure, 1)
        return
    lost = " + ".join(f"({name} - {name})" for name in single) or zero
    yield from comment("Infinities and NaN less themselves are NaN, all other numbers 0.", 1)
    yield from statement(f"{'' if by_length else 'const '}real lost = {lost};", 1)
    for length, names in by_length.items():
        each = [number.format(f"{name}[j]") for name in names for number in numbers]
        yield f"{INDENT}for (int j = 0; j < {length[1:-1]}; ++j) {{"
        yield from statement(f"lost += {' + '.join(f'({name} - {name})' for name in each)};", 2)
        yield f"{INDENT}}}"
    yield f"{INDENT}if (!(lost >= {zero})) {{"
    yield f"{INDENT * 2}return {failure};"
    yield f"{INDENT}}}"


def model_checks(program: Program, real: Real) -> Iterator[str]:
    """Yield lines that leave prepare unless the sum of what it adds to the model is finite."""
    sums = "(model->{0}.high + model->{0}.low)" if real.pair else "model->{0}"
    single: list[str] = []
    by_stations: dict[tuple[int, str], list[str]] = {}
    checked = (program.step, *program.parameters)
    for variable in (v for v in program.model if v not in checked):
        if variable.length is None:
            single.append(sums.format(variable.name))
        for start, stop in written_elements(program.prepare, variable):
            whole = dimension(variable, program)[1:-1]
            stations = (start, whole if stop == variable.length else str(stop))
            by_stations.setdefault(stations, []).append(variable.name)
    if by_stations:
        yield f"{INDENT}real {TOTAL} = {real.literal(0)}; /* of the model: is all of it finite? */"
        single.append(TOTAL)
    for (start, end), names in by_stations.items():
        yield f"{INDENT}for (int j = {start}; j < {end}; ++j) {{"
        yield from statement(f"{TOTAL} += {' + '.join(sums.format(f'{name}[j]') for name in names)};", 2)
        yield f"{INDENT}}}"
    if single:
        yield from check([" + ".join(single)], f"{macros(program.name)}_NON_FINITE_MODEL", 1)


def check(names: list[str], failure: str, depth: int) -> Iterator[str]:
    """Yield lines that return ``failure`` unless all names are finite."""
    condition = " || ".join(f"!isfinite({name})" for name in names)
    yield from statement(f"if ({condition}) {{", depth)
    yield f"{INDENT * (depth + 1)}return {failure};"
    yield f"{INDENT * depth}}}"
