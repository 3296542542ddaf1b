"""A grid of changes, and what comes of each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.arm import Arm
from tmm_gen.api.changes import keys_of
from tmm_gen.api.frames import pandas
from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.errors import UserError

__all__ = ["Sweep", "sweep"]


@dataclass(frozen=True, eq=False, repr=False)
class Sweep:
    """Results over a grid, the last key varying fastest.

    Parameters
    ----------
    name : str
        Of the scene.
    grid : dict from str to tuple
        Values by dotted key.
    results : tuple
        One for each point; None where it was refused.
    refusals : dict from int to UserError
        By number of the point.
    """

    name: str
    grid: dict[str, tuple[object, ...]]
    results: tuple[Any, ...]
    refusals: dict[int, UserError]

    @property
    def points(self) -> list[dict[str, object]]:
        """What was changed at each point, by dotted key."""
        return [dict(zip(self.grid, values, strict=True)) for values in product(*self.grid.values())]

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each key."""
        return tuple(len(values) for values in self.grid.values())

    @property
    def array(self) -> NDArray[Any]:
        """Results in the shape of the grid: numbers with NaN where refused, or objects."""
        numbers = all(isinstance(each, int | float | np.number | None) for each in self.results)
        if numbers:
            filled = [np.nan if each is None else each for each in self.results]
            return np.array(filled, float).reshape(self.shape)
        found = np.empty(len(self.results), object)
        found[:] = self.results
        return found.reshape(self.shape)

    @guarded
    def to_pandas(self) -> Any:
        """Return a data frame of pandas, which must be installed: a column for each key, and ``result``."""
        return pandas().DataFrame(self._rows())

    def _rows(self) -> list[dict[str, object]]:
        return [point | {"result": each} for point, each in zip(self.points, self.results, strict=True)]

    def __repr__(self) -> str:
        """Say how large it is."""
        by = " by ".join(f"{len(values)} {key}" for key, values in self.grid.items())
        refused = f", {len(self.refusals)} refused" if self.refusals else ""
        return f"<Sweep of {self.name}: {by}{refused}>"

    def _repr_html_(self) -> str:
        columns = {key: key for key in self.grid} | {"result": "result"}
        notes = [f"{number + 1}: {error}" for number, error in self.refusals.items()]
        return html_table(f"Sweep of {self.name}", columns, self._rows(), notes)


def sweep(
    arm: Arm,
    measure: Callable[[Arm], Any],
    changes: Mapping[str, Iterable[object]] | None = None,
    *,
    keep_refused: bool = False,
    **more: Iterable[object],
) -> Sweep:
    """Return what comes of an arm over a grid of changes.

    Parameters
    ----------
    arm : Arm
        What is changed.
    measure : callable
        From a changed arm to anything: a number, a run, modes.
    changes : mapping from str to iterable, optional
        Values by key, as of :meth:`Arm.with_`.
    keep_refused : bool
        Whether to go on where a change or what is measured is refused; the result is None there.
    **more : iterable
        The same: ``beam__links=[5, 10, 20]``.

    Raises
    ------
    UserError
        If a key is unknown or has no values, or a point is refused.
    """
    if not isinstance(arm, Arm):
        raise UserError(f"sweep: takes an arm, as load() returns it, not {type(arm).__name__}.")
    if not callable(measure):
        raise UserError("sweep: takes a function of an arm, such as lambda arm: arm.modes().frequencies[0].")
    grid = {key: _values(key, values) for key, values in keys_of(changes, more).items()}
    if not grid:
        raise UserError("sweep: has nothing to change. Give values by key, such as beam__links=[5, 10, 20].")
    results: list[Any] = []
    refusals: dict[int, UserError] = {}
    for number, values in enumerate(product(*grid.values())):
        try:
            results.append(measure(arm.with_(dict(zip(grid, values, strict=True)))))
        except UserError as error:
            if not keep_refused:
                raise
            refusals[number] = error
            results.append(None)
    return Sweep(arm.name, grid, tuple(results), refusals)


def _values(key: str, values: object) -> tuple[object, ...]:
    if isinstance(values, str | Mapping) or not isinstance(values, Iterable):
        raise UserError(f"sweep: {key} must be given several values, such as [1.0, 2.0], not {values!r}.")
    found = tuple(values)
    if not found:
        raise UserError(f"sweep: {key} has no values. Give at least one.")
    return found
