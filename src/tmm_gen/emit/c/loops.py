"""Loops over stations in C, and what stands between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from tmm_gen.c_language.names import macros
from tmm_gen.program.statements import Assign, Loop, Order, Program, Require, Statement


def loop_head(loop: Loop, program: Program) -> str:
    """Return the head of a loop; all stations are a macro of the kernel."""
    stop = f"{macros(program.name)}_STATIONS" if loop.stop == program.stations else str(loop.stop)
    by = f" += {loop.stride}" if loop.stride > 1 else ""
    if loop.order is Order.OUTWARD:
        return f"for (int j = {loop.start}; j < {stop}; {f'j{by}' if by else '++j'})"
    last = str(int(stop) - loop.stride) if stop.isdecimal() else f"{stop} - {loop.stride}"
    return f"for (int j = {last}; j >= {loop.start}; {f'j -= {loop.stride}' if by else '--j'})"


def station_index(entry: int, program: Program) -> str:
    """Return an index of a station, in terms of the kernel's macro where it is the last."""
    return f"{macros(program.name)}_STATIONS - 1" if entry == program.stations - 1 else str(entry)


def ends_of_straight(statements: Sequence[Statement]) -> Iterator[tuple[Statement, bool, bool]]:
    """Yield statements, and whether each is the first and the last of some that stand in no loop."""
    for straight, run in groupby(statements, lambda s: isinstance(s, Assign | Require)):
        block = tuple(run)
        for place, top in enumerate(block):
            yield top, straight and place == 0, straight and place == len(block) - 1
