"""Many steps of a compiled kernel in one call, with inputs, outputs and states as arrays."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.kernel import NativeKernel
from tmm_gen.native.layout import PairStructure

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Recording:
    """What some steps have left.

    Parameters
    ----------
    outputs, states : dict from str to array, (steps, ...)
        By name, after each step that was taken.
    failed : ArithmeticError or None
        Why the step after them could not be taken; its state is the last one.
    """

    outputs: dict[str, Array]
    states: dict[str, Array]
    failed: ArithmeticError | None


def record(kernel: NativeKernel, inputs: Mapping[str, Array], steps: int) -> Recording:
    """Take steps from the kernel's present state.

    Parameters
    ----------
    kernel : NativeKernel
        Prepared and initialised.
    inputs : mapping from str to array, (steps,) or (steps, stages)
        All inputs of the program.
    steps : int
        How many to take.
    """
    given, found, reached = ((kernel.types[which] * steps)() for which in ("inputs", "outputs", "state"))
    columns = _columns(given)
    for name, values in inputs.items():
        columns[name][...] = values  # what is single precision is rounded here, as everywhere
    done, status = kernel.record(given, found, reached)
    failed = None
    if status:
        try:
            kernel.raise_for(status)
        except ArithmeticError as error:
            failed = error
    kept = done + bool(status)
    read = _numbers(found)
    outputs = {v.name: read[v.name][:done] for v in kernel.program.outputs}
    return Recording(outputs, {name: values[:kept] for name, values in _numbers(reached).items()}, failed)


def _columns(array: Any) -> dict[str, Any]:
    """Return views of the members of an array of structs."""
    whole = np.frombuffer(array, np.dtype(array._type_))
    return {name: whole[name] for name in whole.dtype.names or ()}


def _numbers(array: Any) -> dict[str, Array]:
    """Return the members of an array of structs as doubles; sums of two are summed up."""
    kind: Any = array._type_
    pairs = {name for name, member in kind._fields_ if _is_pair(member)}
    return {
        name: (view["high"].astype(float) + view["low"]) if name in pairs else np.asarray(view, float)
        for name, view in _columns(array).items()
    }


def _is_pair(member: Any) -> bool:
    element = getattr(member, "_type_", member)
    return isinstance(element, type) and issubclass(element, ctypes.Structure) and element is PairStructure
