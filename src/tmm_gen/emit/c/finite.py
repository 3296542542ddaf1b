"""Checks that numbers are finite."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.emit.c.structs import dimension
from tmm_gen.emit.c.wrap import INDENT, statement
from tmm_gen.emit.c_names import member
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable


def finite_checks(
    pointer: str, variables: tuple[Variable, ...], program: Program, failure: str, pairs: bool = False
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
    pairs : bool
        Whether they are sums of two numbers, of which both are looked at.
    """
    sums = "{0}.high + {0}.low" if pairs else "{0}"
    by_length: dict[str, list[str]] = {}
    for variable in variables:
        by_length.setdefault(dimension(variable, program), []).append(pointer + member(variable, program.name))
    for length, names in by_length.items():
        if not length:
            yield from check([sums.format(name) for name in names], failure, 1)
            continue
        yield f"{INDENT}for (int j = 0; j < {length[1:-1]}; ++j) {{"
        yield from check([sums.format(f"{name}[j]") for name in names], failure, 2)
        yield f"{INDENT}}}"


def check(names: list[str], failure: str, depth: int) -> Iterator[str]:
    """Yield lines that return ``failure`` unless all names are finite."""
    condition = " || ".join(f"!isfinite({name})" for name in names)
    yield from statement(f"if ({condition}) {{", depth)
    yield f"{INDENT * (depth + 1)}return {failure};"
    yield f"{INDENT * depth}}}"
