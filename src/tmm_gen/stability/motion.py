"""A scene in small motion as its modes, and whether damping couples them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.linear import Linear
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import Mode, find_modes
from tmm_gen.modal.situation import resting_arm
from tmm_gen.modal.space.situation import RestingArm, resting_in_space
from tmm_gen.modal.space.still import Still
from tmm_gen.scene import Scene
from tmm_gen.stability.whole_arm import Rounds

Array = NDArray[np.float64]

MOST_STATIONS = 1000
"""Of what is done with dense matrices."""


@dataclass(frozen=True, eq=False)
class SmallMotion:
    """Modes of a scene.

    Parameters
    ----------
    scene : Scene
        What moves.
    linear : Linear
        About rest.
    modes : tuple of Mode
        Increasing in natural frequency.
    mixed : bool
        Whether damping couples the undamped modes, so that a step does not fall apart into modes.
    rounds : Rounds or None
        How an arm in space solves its stages, where its sweeps leave weight to corrections.
    start : array, optional
        Free angles near which it rests, rad; None for where it comes to rest.
    """

    scene: Scene
    linear: Linear
    modes: tuple[Mode, ...]
    mixed: bool
    rounds: Rounds | None = None
    start: Array | None = None

    @property
    def together(self) -> bool:
        """Whether a step is one of the whole arm, and not of each mode by itself."""
        return self.mixed or self.rounds is not None

    @property
    def afloat(self) -> bool:
        """Whether the arm moves along and turns as a whole, of which its matrices know nothing."""
        return self.scene.spatial is not None and self.scene.spatial.base is not None

    @property
    def stiffness(self) -> Array:
        """``k`` of ``q'' + d q' + k q = 0`` for each mode, 1/s^2: the product of its poles."""
        return np.array([(mode.poles[0] * mode.poles[1]).real for mode in self.modes])

    @property
    def damping(self) -> Array:
        """``d`` of the same, 1/s: minus the sum of its poles."""
        return np.array([-(mode.poles[0] + mode.poles[1]).real for mode in self.modes])

    @property
    def highest(self) -> Mode:
        """The mode of the highest natural frequency."""
        return max(self.modes, key=lambda mode: mode.frequency)

    @property
    def falling(self) -> bool:
        """Whether the arm itself falls over, whatever integrates it."""
        return any(mode.unstable for mode in self.modes)


def small_motion(scene: Scene, start: Array | None = None) -> SmallMotion:
    """Return the modes of a scene: of a chain, or of an arm about its static equilibrium.

    Parameters
    ----------
    scene : Scene
        What moves.
    start : array, optional
        Free angles near which an arm rests, rad, whether it falls over there or not.

    Raises
    ------
    UserError
        If there is no equilibrium, or the scene has more than `MOST_STATIONS` stations.
    """
    if scene.stations > MOST_STATIONS:
        raise UserError(
            f"scene '{scene.name}': the modes of {scene.stations} stations take dense matrices; at most "
            f"{MOST_STATIONS} are possible here. The limits do not change much with more: try fewer links."
        )
    if scene.spatial is not None:
        return motion_in_space(resting_in_space(scene, start=start), start)
    return motion_of(scene, matrices(resting_arm(scene, start=start)), start=start)


def motion_of(scene: Scene, linear: Linear, start: Array | None = None) -> SmallMotion:
    """Return the modes of some matrices."""
    return SmallMotion(scene, linear, find_modes(linear), linear.damping_time is None, start=start)


def motion_in_space(resting: RestingArm, start: Array | None = None) -> SmallMotion:
    """Return the modes of an arm in space, those in which it moves as a whole among them."""
    scene, linear = resting.scene, resting.linear
    mixed = linear.damping_time is None
    return SmallMotion(scene, linear, resting.modes(), mixed, rounds_of(scene, resting.still), start)


def rounds_of(scene: Scene, still: Still) -> Rounds | None:
    """Return how the stages of an arm in space are solved; None where its sweeps leave nothing out about rest."""
    if scene.model.linearisation == "newton" or not np.any(still.geometric):
        return None
    return Rounds(still.geometric, scene.model.sweeps)
