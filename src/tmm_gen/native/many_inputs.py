"""Inputs of many arms over time, as compiled C reads them: one array each, and how far apart its numbers are."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tmm_gen.native.many import Numbers, numbers
from tmm_gen.program.statements import Program

Signal = ArrayLike | Callable[[float], ArrayLike]
"""An input: a number, one for each arm, rows of either for the steps, or a function of time that gives one of the
first two."""


class SignalStruct(ctypes.Structure):
    """``<name>_signal_batch`` as ctypes sees it."""

    _fields_ = (
        ("values", ctypes.c_void_p),
        ("per_step", ctypes.c_ssize_t),
        ("per_stage", ctypes.c_ssize_t),
        ("per_arm", ctypes.c_ssize_t),
    )


def sampled(program: Program, name: str, signal: Signal, steps: int, step: float, real: Any) -> Numbers:
    """Return an input at the instants of steps and stages.

    Parameters
    ----------
    program : Program
        Whose steps are meant.
    name : str
        Of the input.
    signal : array_like or callable
        What a user gives.
    steps : int
        How many.
    step : float
        s.
    real : type
        Of the kernel's numbers.

    Returns
    -------
    array, shape (steps or 1, stages or 1, arms or 1)
        With 1 where nothing changes.

    Raises
    ------
    ValueError
        If rows are not as many as steps, an array has more than two dimensions, a function gives another number of
        arms now than before, or something is not a number.
    """
    if callable(signal):
        return _of_function(program, name, signal, steps, step, real)
    if steps == 0 and np.ndim(signal) == 2:
        raise ValueError(f"{name} has rows, and there is no step to take: give a number or one for each arm")
    values = numbers(name, signal, real)
    if values.ndim > 2:
        raise ValueError(f"{name} has {values.ndim} dimensions; it may have two: steps and arms")
    if values.ndim == 2 and values.shape[0] != steps:
        raise ValueError(f"{name} has {values.shape[0]} rows for {steps} steps")
    # a field of records: C counts whole numbers
    if any(stride % values.itemsize for stride in values.strides):
        values = values.copy()
    return values.reshape((1,) * (2 - values.ndim) + values.shape)[:, None, :]


def _of_function(
    program: Program, name: str, signal: Callable[[float], ArrayLike], steps: int, step: float, real: Any
) -> Numbers:
    stages = max(len(instants) for instants in program.stage_instants)
    rows: list[list[Numbers]] = []
    for index in range(steps):
        instants = program.stage_instants[min(index, len(program.startup))]
        found = [_at(name, signal, step * (index + instant), real) for instant in instants]
        rows.append([*found, *found[-1:] * (stages - len(found))])  # a start-up step may have fewer
    rows = rows or [[_at(name, signal, 0.0, real)]]
    counts = {found.size for row in rows for found in row} - {1}
    if len(counts) > 1:
        raise ValueError(
            f"{name} is for {' and for '.join(map(str, sorted(counts)))} arms, at different times"
        )
    made = np.empty((len(rows), len(rows[0]), counts.pop() if counts else 1), dtype=real)
    for index, row in enumerate(rows):
        for stage, now in enumerate(row):
            made[index, stage] = now
    return made


def _at(name: str, signal: Callable[[float], ArrayLike], time: float, real: Any) -> Numbers:
    """Return what a function of time gives, shape (arms or 1,)."""
    found = numbers(f"{name} at {time:.6g} s", signal(time), real)
    if found.ndim > 1:
        raise ValueError(f"{name} gives the shape {found.shape}; it may give a number, or one for each arm")
    return np.atleast_1d(found)


def at_start(name: str, signal: Signal, series: Numbers, arms: int) -> Numbers:
    """Return an input at time zero for each arm.

    Raises
    ------
    ValueError
        If a function gives another number of arms there.
    """
    now = _at(name, signal, 0.0, series.dtype) if callable(signal) else series[0, 0]
    if now.size not in (1, arms):
        raise ValueError(f"{name} is for {now.size} arms at its start, and for {arms} later")
    return np.broadcast_to(now, (arms,))


def signal_structs(program: Program, series: Mapping[str, Numbers]) -> tuple[Any, ...]:
    """Return all inputs as one argument; nothing where the scene has none. They point into the arrays."""
    if not program.inputs:
        return ()
    structs = (SignalStruct * len(program.inputs))()
    for struct, variable in zip(structs, program.inputs, strict=True):
        values = series.get(variable.name)
        if values is None:
            continue  # NULL: zeros
        struct.values = values.ctypes.data
        struct.per_step, struct.per_stage, struct.per_arm = (
            stride // values.itemsize if length > 1 else 0
            for stride, length in zip(values.strides, values.shape, strict=True)
        )
    return (structs,)
