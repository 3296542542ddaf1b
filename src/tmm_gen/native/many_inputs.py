"""Inputs of many arms over time, as compiled C reads them: one array each, and how far apart its numbers are."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from tmm_gen.native.many import Numbers
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


def sampled(program: Program, signal: Signal, steps: int, step: float, real: Any) -> Numbers:
    """Return an input at the instants of steps and stages.

    Parameters
    ----------
    program : Program
        Whose steps are meant.
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
        If rows are not as many as steps, or an array has more than two dimensions.
    """
    if callable(signal):
        return _of_function(program, signal, steps, step, real)
    values = np.asarray(signal, dtype=real)
    if values.ndim > 2:
        raise ValueError(f"an input has {values.ndim} dimensions; it may have two: steps and arms")
    if values.ndim == 2 and values.shape[0] != steps:
        raise ValueError(f"an input has {values.shape[0]} rows for {steps} steps")
    return values.reshape((1,) * (2 - values.ndim) + values.shape)[:, None, :]


def _of_function(
    program: Program, signal: Callable[[float], ArrayLike], steps: int, step: float, real: Any
) -> Numbers:
    stages = max(len(instants) for instants in program.stage_instants)
    rows: list[list[Any]] = []
    for index in range(steps):
        instants = program.stage_instants[min(index, len(program.startup))]
        found = [np.atleast_1d(signal(step * (index + instant))) for instant in instants]
        rows.append([*found, *found[-1:] * (stages - len(found))])  # a start-up step may have fewer
    return np.asarray(rows or [[np.atleast_1d(signal(0.0))]], dtype=real)


def at_start(signal: Signal, series: Numbers, arms: int) -> Numbers:
    """Return an input at time zero for each arm."""
    now = np.asarray(signal(0.0), dtype=series.dtype) if callable(signal) else series[0, 0]
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
