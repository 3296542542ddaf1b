"""Growth over step and stiffness: derived from the amplification matrix beside measured by running the kernel."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.errors import UserError
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.rest import Rest
from tmm_gen.modal.situation import rest_of
from tmm_gen.modal.space.situation import RestingArm, rest_in_space
from tmm_gen.modal.space.still import Still
from tmm_gen.scene import Scene
from tmm_gen.stability.growth import Growth
from tmm_gen.stability.measured import MeasuredStep
from tmm_gen.stability.motion import SmallMotion, motion_in_space, motion_of
from tmm_gen.stability.variants import with_integrator, with_stiffness
from tmm_gen.stability.whole_arm import WholeStep

Array = NDArray[np.float64]

TOLERANCE, TOLERANCE_FAR = 1e-5, 1e-4
"""Spectral radii that differ by less, relatively, agree: eigenvalues that meet move by the root of rounding; those of
an arm that turns far are differences of two motions."""

GROWS, GROWS_FAR = 1e-6, 1e-5
"""Growth by less in a step is none, in either map."""

_WILD = 1e3
"""Growth in a step by more takes an arm that turns far out of small motion: by how much is not asked."""

_REACH = (0.02, 50.0)
"""Steps of a map: Omega of the highest frequency from here to there; and those of the scene."""

_STIFFER = 1e4
_MOST = 600
"""Numbers of the state of the largest arm whose maps are worth waiting for."""


@dataclass(frozen=True, eq=False)
class GrowthMap:
    """Spectral radii over step and stiffness.

    Parameters
    ----------
    scene : Scene
        With the integrator of the map.
    steps : array, (columns,)
        s, increasing.
    factors : array, (rows,)
        Of the joints' stiffness, increasing.
    derived, measured : array, (rows, columns)
        Spectral radii; infinite where numbers overflow.
    """

    scene: Scene
    steps: Array
    factors: Array
    derived: Array
    measured: Array

    @property
    def difference(self) -> Array:
        """Measured less derived, relative to the larger of derived and 1, (rows, columns).

        Zero where both overflow, or leave small motion in one step.
        """
        with np.errstate(invalid="ignore"):
            found = (self.measured - self.derived) / np.maximum(self.derived, 1.0)
        wild = self._bounds[2]
        both = (self.measured >= wild) & (self.derived >= wild)
        difference: Array = np.where(both, 0.0, found)
        return difference

    @property
    def differs(self) -> NDArray[np.bool_]:
        """Where they differ: by more than `TOLERANCE`, or one is no number, (rows, columns)."""
        return ~(np.abs(self.difference) <= self._bounds[0])

    @property
    def worst_cell(self) -> tuple[int, int]:
        """Row and column of the largest difference."""
        sizes = np.nan_to_num(np.abs(self.difference), nan=np.inf)
        row, column = np.unravel_index(np.argmax(sizes), sizes.shape)
        return int(row), int(column)

    @property
    def worst(self) -> tuple[float, float, float, float]:
        """Step, factor, measured and derived radius where they differ most."""
        row, column = cell = self.worst_cell
        return (
            float(self.steps[column]),
            float(self.factors[row]),
            float(self.measured[cell]),
            float(self.derived[cell]),
        )

    @property
    def grows(self) -> NDArray[np.bool_]:
        """Where motion grows as derived, (rows, columns)."""
        return self.derived > 1.0 + self._bounds[1]

    @property
    def _bounds(self) -> tuple[float, float, float]:
        """Least difference, and least growth, that count; and growth beyond all that is asked for."""
        return (TOLERANCE, GROWS, np.inf) if self.scene.model.linear else (TOLERANCE_FAR, GROWS_FAR, _WILD)


def growth_map(
    motion: SmallMotion, method: Integrator, columns: int, advance: Callable[[int], None] = lambda cells: None
) -> GrowthMap:
    """Derive and measure a map.

    Parameters
    ----------
    motion : SmallMotion
        Of the scene.
    method : Integrator
        With its parameters bound.
    columns : int
        Steps; for two thirds as many stiffnesses.
    advance : callable, optional
        Called with the number of cells that are done, each counted once derived and once measured.

    Raises
    ------
    UserError
        If the scene is too large for it.
    """
    scene = with_integrator(motion.scene, method)
    kernel = MeasuredStep(scene)
    if kernel.size > _MOST:
        raise UserError(
            f"scene '{scene.name}': a map of growth for {kernel.size} numbers of state would take too long; "
            f"at most {_MOST} are possible. Take fewer links, or leave the maps out by --cells 0."
        )
    h, highest = scene.integrator.step, motion.highest.frequency
    low, high = (edge / highest for edge in _REACH)
    steps = np.geomspace(min(low, h / 2.0), max(high, 2.0 * h), columns)
    factors = np.geomspace(1.0 / _STIFFER, _STIFFER, _rows(columns))
    rests = Rests(scene, motion.start)
    derived = np.empty((len(factors), len(steps)))
    growth = Growth(method)
    for row, factor in enumerate(factors.tolist()):
        derived[row] = derived_radii(rests.motion(factor), growth, steps)
        advance(len(steps))
    every = np.meshgrid(factors, steps, indexing="ij")
    measured = kernel.radii(every[0].ravel(), every[1].ravel(), rests.angles, advance)
    return GrowthMap(scene, steps, factors, derived, measured.reshape(derived.shape))


class Rests:
    """Where a scene rests, by factor of its stiffness; each found once.

    Parameters
    ----------
    scene : Scene
        At factor 1.
    start : array, optional
        Free angles near which it rests, rad.
    """

    def __init__(self, scene: Scene, start: Array | None = None) -> None:
        self._scene, self._start = scene, start
        self.motion = cache(self._motion)
        self._rest = cache(self._found)

    def angles(self, factor: float) -> Array:
        """Return the free angles at rest, rad."""
        found = self._rest(factor)
        if isinstance(found, Still):
            assert self._scene.spatial is not None
            angles = np.zeros(self._scene.stations)  # a prescribed base is at 0
            angles[[not joint.given for joint in self._scene.spatial.joints]] = found.angles
            return angles
        return found.free_angles if found else np.zeros(self._scene.stations + self._scene.hub)

    def _motion(self, factor: float) -> SmallMotion:
        changed, found = with_stiffness(self._scene, factor), self._rest(factor)
        if isinstance(found, Still):
            return motion_in_space(RestingArm(changed, found))
        return motion_of(changed, matrices(linear_arm(changed, found)))

    def _found(self, factor: float) -> Rest | Still | None:
        scene = with_stiffness(self._scene, factor)
        if scene.spatial is not None:
            return rest_in_space(scene, start=self._start)
        return rest_of(scene, start=self._start)


def derived_radii(motion: SmallMotion, growth: Growth, steps: Array) -> Array:
    """Return the spectral radius of a scene at some steps, the worst over modes, (k,)."""
    if motion.together:
        whole = WholeStep(growth.integrator, motion.linear, motion.rounds)
        least = 1.0 if motion.afloat else 0.0
        return np.array([max(least, whole.radius(step)) for step in steps.tolist()])
    h = steps[:, None]
    radii: Array = np.max(growth.radius(motion.stiffness * h * h, motion.damping * h), axis=1)
    return radii


def map_cells(columns: int) -> int:
    """Return how many cells a map of some columns has."""
    return columns * _rows(columns)


def sensible_columns(scene: Scene) -> int:
    """Return how many columns a map of an arm can have: seconds, not minutes."""
    size = 3 * (scene.stations + scene.hub)
    return int(max(6, min(36, math.floor(36.0 * (30.0 / size) ** 1.2))))


def _rows(columns: int) -> int:
    return max(2, 2 * columns // 3)
