"""Passes before emission: few loops, little scratch, no state left undefined."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import sympy as sp

from tmm_gen.emit.c.early_first import early_first
from tmm_gen.emit.c.interleave import interleave
from tmm_gen.emit.c.one_ahead import one_ahead
from tmm_gen.emit.c.reached import where_reached
from tmm_gen.emit.c.split_at_runs import split_at_runs
from tmm_gen.program.passes.contract import contract
from tmm_gen.program.passes.fuse import fuse
from tmm_gen.program.passes.join import join
from tmm_gen.program.passes.lifetimes import read_before_written
from tmm_gen.program.statements import (
    Assign,
    Loop,
    Order,
    Program,
    Routine,
    Section,
    Sensitivities,
    Statement,
    Vectors,
)
from tmm_gen.program.variables import Variable


@lru_cache(maxsize=8)
def lower(program: Program, *, apart: bool = False, together: bool = False) -> Program:
    """Return the program in the form in which C is written, the last few as before.

    Values stay the same bit for bit where a step is not to be fast.

    Parameters
    ----------
    program : Program
        As built.
    apart : bool
        Whether the steps' loops over independent stations stay apart from recursions.
    together : bool
        Whether they go into the steps' recursions instead, run by run, so that walks in one direction become one.
        Either way recursions add first what is known first, which changes last digits.

    Raises
    ------
    ValueError
        If a routine reads a variable before it is written: an array language may forgive that, C does not.
    """
    return replace(
        program,
        prepare=_lowered(program.prepare),
        initialise=_lowered(_defining_all_state(program)),
        startup=tuple(_step(routine, apart, together) for routine in program.startup),
        main=_step(program.main, apart, together),
        output=_lowered(program.output),
        sensitivities=_lowered_sensitivities(program.sensitivities, program.stations),
        vectors=_lowered_vectors(program.vectors),
    )


def _lowered_sensitivities(found: Sensitivities | None, stations: int) -> Sensitivities | None:
    if found is None:
        return None
    tangent = _lowered(found.tangent)
    if found.reduced is not None:
        tangent = where_reached(tangent, stations)  # slopes are gathered joint by joint
    return replace(found, linearise=interleave(_lowered(found.linearise)), tangent=tangent)


def _lowered_vectors(found: Vectors | None) -> Vectors | None:
    return None if found is None else replace(found, step=_step(found.step))


def _step(routine: Routine, apart: bool = False, together: bool = False) -> Routine:
    if apart:
        return early_first(one_ahead(_lowered(routine, apart=True)))
    if together:
        return early_first(interleave(_lowered(split_at_runs(routine))))
    return interleave(_lowered(routine))


def _lowered(routine: Routine, *, apart: bool = False) -> Routine:
    if (variable := read_before_written(routine)) is not None:
        raise ValueError(f"{routine.name} reads {variable.name} before it is written")
    return contract(join(fuse(routine, apart=apart)))


def _defining_all_state(program: Program) -> Routine:
    """Let initialise clear the history that start-up steps shift but do not use."""
    missing = [v for v in program.state if v not in program.initialise.written()]
    if not missing:
        return program.initialise
    older = Section("older history: not known yet, not used before it is", tuple(_cleared(missing, program)))
    return replace(program.initialise, sections=(*program.initialise.sections, older))


def _cleared(variables: list[Variable], program: Program) -> Iterator[Statement]:
    zero = sp.Integer(0)
    yield from (Assign(v.ref, zero) for v in variables if v.length is None)
    arrays = tuple(Assign(v.at(), zero) for v in variables if v.length is not None)
    if arrays:
        yield Loop(Order.OUTWARD, 0, program.stations, arrays)
