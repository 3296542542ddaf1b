"""Numbers of many arms: how arrays that users give are shared among them."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.emit.c.structs import Struct
from tmm_gen.program.variables import Variable

Numbers = NDArray[np.floating[Any]]


def numbers(name: str, value: object, real: Any = np.float64) -> Numbers:
    """Return what a user gives under a name as an array.

    Parameters
    ----------
    name : str
        For the message.
    value : array_like
        Numbers, integers too; what is beyond the number type becomes infinite.
    real : type
        Of the kernel's numbers.

    Raises
    ------
    ValueError
        If these are not real numbers, or there is none.
    """
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):  # rows of different lengths
        array = np.asarray(None)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name} must be a real number or an array of them, not {value!r:.60}")
    if array.size == 0:
        raise ValueError(f"{name} has the shape {array.shape}, in which there is no number")
    with np.errstate(over="ignore"):  # the kernel refuses infinities
        return array.astype(real, copy=False)


def whole(name: str, value: object) -> int:
    """Return a whole number that is 1 or more.

    Raises
    ------
    ValueError
        If it is not.
    """
    try:
        number = operator.index(value) if isinstance(value, SupportsIndex) else 0
    except TypeError:  # an array of several
        number = 0
    if number < 1:
        raise ValueError(f"{name} must be a whole number, 1 or more, not {value!r}")
    return number


def require_known(named: Mapping[str, object], known: Sequence[Variable], what: str) -> None:
    """Refuse names that are not there.

    Parameters
    ----------
    named : mapping from str
        What a user gives.
    known : sequence of Variable
        What there is.
    what : str
        In the plural: "inputs".

    Raises
    ------
    ValueError
        If a name is not among them.
    """
    names = [v.name for v in known]
    if unknown := sorted(set(named) - set(names)):
        there = ", ".join(names) or "none"
        raise ValueError(f"there are no {what} named {', '.join(unknown)}; there are: {there}")


def arm_count(
    arms: int | None,
    variables: Sequence[Variable],
    values: Mapping[str, ArrayLike],
    series: Mapping[str, Numbers],
) -> int:
    """Return how many arms there are.

    Parameters
    ----------
    arms : int, optional
        As told.
    variables : sequence of Variable
        Of the values.
    values : mapping from str to array_like
        Parameters and starts, the last index counting arms where there is one more than the variable has.
    series : mapping from str to array
        Inputs, the last index counting arms.

    Raises
    ------
    ValueError
        If they disagree, or there are none.
    """
    found = {name: array.shape[-1] for name, array in series.items() if array.shape[-1] > 1}
    for variable in variables:
        shape = np.shape(values.get(variable.name, 0.0))
        if len(shape) == (1 if variable.length is None else 2) and shape[-1] > 1:
            found[variable.name] = shape[-1]
    counts = set(found.values()) | (set() if arms is None else {whole("arms", arms)})
    if len(counts) > 1:
        told = ", ".join(f"{name} is for {number}" for name, number in found.items())
        rows = (
            "; an input that changes over time has rows, the shape (steps, 1)"
            if found.keys() & series
            else ""
        )
        raise ValueError(f"how many arms? {told}{'' if arms is None else f', arms = {arms}'}{rows}")
    return counts.pop() if counts else 1


def by_arm(variable: Variable, value: ArrayLike, arms: int) -> Numbers:
    """Return a parameter or a start as rows, one for each arm.

    Parameters
    ----------
    variable : Variable
        What is meant.
    value : array_like, shape (), (arms,), and of arrays also (length,) or (length, arms)
        As a user gives it.
    arms : int
        How many there are.

    Returns
    -------
    array, shape (arms, length)
        Rows.

    Raises
    ------
    ValueError
        If the shape fits neither the variable nor the arms.
    """
    array = numbers(variable.name, value)
    if variable.length is not None and array.ndim == 1:
        array = array[:, None]
    length = variable.length or 1
    if array.ndim <= (1 if variable.length is None else 2):
        try:
            return np.broadcast_to(array, (length, arms)).T
        except ValueError:
            pass
    each = f"; values for each arm have the shape ({length}, arms)" if variable.length else ""
    raise ValueError(
        f"{variable.name} has the shape {np.shape(value)}, which fits neither {length} values nor {arms} arms{each}"
    )


def columns(struct: Struct) -> Iterator[tuple[Variable, slice]]:
    """Yield the variables of a struct, and which of its numbers are theirs."""
    start = 0
    for variable in struct.variables:
        stop = start + (variable.length or 1)
        yield variable, slice(start, stop)
        start = stop
