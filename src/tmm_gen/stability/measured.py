"""How much a motion grows in one step of a generated kernel: measured by running it.

Each number of the state in turn is moved a little from rest and taken through one step of the generated NumPy kernel,
for all parameters and steps of a map in one batch. What comes out is the kernel's own amplification matrix; by its
largest eigenvalue any motion grows in the long run. Nothing here knows an integrator's formulas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_PUSH = 1e-5
"""By how much a planar arm is moved from rest: rad, or as much in one step. A chain is linear: by 1."""

_NUMBERS = 200_000
"""Stations times arms that one batch holds."""

_ORDER = {"angle": 0, "rate": 1, "acceleration": 2}


class MeasuredStep:
    """One step of a scene's generated NumPy kernel, as a map of small motions about rest.

    Parameters
    ----------
    scene : Scene
        With the integrator to be measured.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._module = numpy_module(scene)
        self._linear = scene.model.linear
        self._names = [item.name for item in fields(self._module.State) if item.name != "steps_taken"]
        self._counts = any(item.name == "steps_taken" for item in fields(self._module.State))
        zero = self._module.initialise(self._module.Params(), self._module.Input())
        self._lengths = {name: np.asarray(getattr(zero, name)).shape for name in self._names}
        self._orders = {name: _order(name) for name in self._names}

    @property
    def size(self) -> int:
        """Numbers of the state: rows of the matrix."""
        return sum(length[0] if length else 1 for length in self._lengths.values())

    def radii(
        self,
        factors: Array,
        steps: Array,
        rest: Callable[[float], Array],
        advance: Callable[[int], None] = lambda cells: None,
    ) -> Array:
        """Return spectral radii.

        Parameters
        ----------
        factors, steps : array, (k,)
            Of the joints' stiffness; of time, s.
        rest : callable
            From a factor to the free angles of the arm at rest, rad.
        advance : callable, optional
            Called with the number of values that are done.

        Returns
        -------
        array, (k,)
            Infinite where numbers overflow.
        """
        sides = 1 if self._linear else 2
        chunk = max(1, _NUMBERS // (self.scene.stations * self.size * sides))
        found = np.empty(len(steps))
        for start in range(0, len(steps), chunk):
            here = slice(start, start + chunk)
            angles = np.array([rest(float(factor)) for factor in factors[here]])
            matrices = self.matrices(factors[here], steps[here], angles)
            good = np.all(np.isfinite(matrices), axis=(-1, -2))
            sizes = np.abs(np.linalg.eigvals(np.where(good[:, None, None], matrices, 0.0))).max(axis=-1)
            found[here] = np.where(good, sizes, np.inf)
            advance(len(sizes))
        return found

    def matrices(self, factors: Array, steps: Array, angles: Array) -> Array:
        """Return amplification matrices of the kernel, in units of steps, (k, size, size).

        Parameters
        ----------
        factors, steps : array, (k,)
            Of the joints' stiffness; of time, s.
        angles : array, (k, free)
            Rest.
        """
        size, cells = self.size, len(steps)
        signs = (1.0,) if self._linear else (1.0, -1.0)
        push = 1.0 if self._linear else _PUSH
        # arms of the batch: cell by cell, number by number of the state, side by side
        arms = (cells, size, len(signs))
        step, factor = (np.broadcast_to(each[:, None, None], arms).reshape(-1) for each in (steps, factors))
        with np.errstate(all="ignore"):
            model = self._module.prepare(self._params(factor), step)
            at_rest = self._at_rest(factors, angles)
            moved: dict[str, Any] = {}
            column = 0
            units = {name: push / steps ** self._orders[name] for name in self._names}
            for name, count in self._each():
                values = np.repeat(at_rest[name][..., None], size * len(signs), axis=-1)
                values = values.reshape(count, *arms).copy()
                for j in range(count):
                    for side, sign in enumerate(signs):
                        values[j, :, column + j, side] += sign * units[name]
                moved[name] = values.reshape(count, -1) if self._lengths[name] else values.reshape(-1)
                column += count
            if self._counts:
                moved["steps_taken"] = len(self._module.STAGE_INSTANTS) - 1
            after = self._module.step(model, self._module.State(**moved), self._module.Input())
            rows = []
            for name, count in self._each():
                values = np.asarray(getattr(after, name)).reshape(count, *arms) / units[name][:, None, None]
                change = values[..., 0] if self._linear else 0.5 * (values[..., 0] - values[..., 1])
                rows.append(change)
        made: Array = np.moveaxis(np.concatenate(rows), 0, 1)
        return made

    def _each(self) -> Iterator[tuple[str, int]]:
        for name in self._names:
            length = self._lengths[name]
            yield name, length[0] if length else 1

    def _params(self, factor: Array) -> Any:
        default = self._module.Params()
        if not hasattr(default, "stiffness"):  # joints that all turn freely
            return default
        stiffness = np.asarray(default.stiffness, float)
        return replace(
            default, stiffness=stiffness[..., None] * factor if stiffness.ndim else stiffness * factor
        )

    def _at_rest(self, factors: Array, angles: Array) -> dict[str, Array]:
        """Return the state at rest, each variable (count, cells)."""
        cells = len(factors)
        turning = self.scene.hub
        links = angles[:, turning:].T
        start = self._module.initialise(self._params(factors), self._module.Input(), initial_angle=links)
        found = {}
        for name, count in self._each():
            if name.startswith("hub_angle"):
                hub = angles[:, 0] if turning else np.zeros(cells)
                found[name] = hub[None, :]
            elif self._orders[name]:
                found[name] = np.zeros((count, cells))
            elif name.startswith("angle"):
                found[name] = links
            else:  # places of nodes: at rest the older ones are where the newest is
                newest = name.partition("_1_ago")[0].partition("_2_ago")[0]
                found[name] = np.broadcast_to(np.asarray(getattr(start, newest)), (count, cells))
        return found


def _order(name: str) -> int:
    """Return how often a variable of the state is differentiated by time."""
    words: Sequence[str] = name.split("_")
    return max((_ORDER.get(word, 0) for word in words), default=0)
