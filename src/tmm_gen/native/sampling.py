"""What inputs that are functions of time are in a step: their values at the instants of its stages."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from tmm_gen.native.layout import Value
from tmm_gen.program.statements import Program

Signal = float | Callable[[float], float]
"""An input: constant, or a function of time in s."""


def value_at(signal: Signal, time: float) -> float:
    """Return an input's value at an instant in s."""
    return float(signal(time)) if callable(signal) else float(signal)


def stage_inputs(
    program: Program, signals: Mapping[str, Signal], step: float, index: int
) -> dict[str, Value]:
    """Return the inputs of a step at the instants of its stages.

    Parameters
    ----------
    program : Program
        Whose inputs are meant; those without a signal are left out.
    signals : mapping from str
        Constants or functions of time.
    step : float
        s.
    index : int
        Steps taken before, from time zero.
    """
    instants = program.stage_instants[min(index, len(program.startup))]
    values: dict[str, Value] = {}
    for variable in program.inputs:
        if (signal := signals.get(variable.name)) is not None:
            found = [value_at(signal, step * (index + instant)) for instant in instants]
            missing = (variable.length or 1) - len(found)  # a start-up step may have fewer stages
            values[variable.name] = [*found, *found[-1:] * missing] if variable.length else found[0]
    return values
