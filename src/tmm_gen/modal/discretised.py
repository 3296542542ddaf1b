"""A scene's beam as a straight, weightless arm of links: what the exact beam is compared with."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.beam import BeamArm, beam_arm, frequencies_below
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.scene import Initial, Scene
from tmm_gen.scene.beam import Springs, beam_joints, beam_links

Array = NDArray[np.float64]

MOST_LINKS = 500
"""Links beyond which :func:`links_needed` gives up."""


def with_links(scene: Scene, links: int, springs: Springs | None = None) -> Scene:
    """Return a scene whose beam is cut into some links, at rest along x, without inputs and outputs.

    Parameters
    ----------
    scene : Scene
        With a ``[beam]``.
    links : int
        n, positive.
    springs : {"clamped-segment", "half-clamp", "uniform", "thesis"}, optional
        Rule of the springs; by default the scene's.

    Raises
    ------
    ValueError
        If the scene has no beam.
    """
    if scene.beam is None:
        raise ValueError(f"scene '{scene.name}' has no [beam]")
    beam = scene.beam.model_copy(update={"links": links, "springs": springs or scene.beam.springs})
    still = (0.0,) * links
    return replace(
        scene,
        beam=beam,
        joints=beam_joints(beam),
        links=beam_links(beam),
        inputs=(),
        outputs=(),
        initial=Initial(still, still),
    )


def straight_frequencies(
    scene: Scene, links: int | None = None, springs: Springs | None = None, count: int | None = None
) -> Array:
    """Return the lowest natural frequencies (rad/s) of the straight, weightless arm, by default all."""
    chosen = with_links(scene, links or scene.stations, springs)
    return np.sqrt(undamped_modes(matrices(linear_arm(chosen)), count).squares)


@dataclass(frozen=True, eq=False, repr=False)
class LinksNeeded:
    """How few links a scene requires.

    Parameters
    ----------
    links : int
        The smallest number at which every natural frequency in the band is within the error.
    exact : array, (modes,)
        Natural frequencies of the continuous beam in the band, rad/s.
    discretised : array, (modes,)
        Those of the arm with that number of links.
    errors : array, (modes,)
        Relative; zero for rigid-body motions.
    errors_below : array, (modes,) or None
        The same with one link less; NaN for a mode it does not have. None where one link is enough.
    """

    links: int
    exact: Array
    discretised: Array
    errors: Array
    errors_below: Array | None

    def __repr__(self) -> str:
        """Say how many, and what they keep."""
        count = len(self.exact)
        return f"<{self.links} links: {count} mode{'s' * (count != 1)} within {100.0 * self.worst:.2g} %>"

    @property
    def worst(self) -> float:
        """Largest error."""
        return float(np.max(self.errors, initial=0.0))


def links_for(scene: Scene, error: float, band: float) -> LinksNeeded:
    """Return how few links keep a scene's natural frequencies as the continuous beam has them.

    Parameters
    ----------
    scene : Scene
        With a ``[beam]``.
    error : float
        Largest relative error.
    band : float
        Upper end of the band, Hz.

    Raises
    ------
    UserError
        If the scene has no ``[beam]``, or no number of links is enough.
    """
    if scene.parts or scene.spatial:
        raise UserError(
            f"scene '{scene.name}' is an arm by parts, whose beams --links-for does not cut yet. "
            "Change `links` of a [[beam]] and compare what `tmm-gen modes` says, or use a planar scene with [beam]."
        )
    if scene.beam is None:
        raise UserError(
            f"scene '{scene.name}' has no [beam]: only a beam can be cut into more or fewer links. "
            "Use a planar scene with [beam]."
        )
    try:
        return links_needed(scene, error, 2.0 * math.pi * band)
    except ValueError as reason:
        raise UserError(f"--links-for {error:g} --band {band:g}: {reason}. Ask for less.") from reason


def links_needed(scene: Scene, error: float, band: float) -> LinksNeeded:
    """Return the smallest number of links whose natural frequencies agree with the continuous beam's.

    Parameters
    ----------
    scene : Scene
        With a ``[beam]``; its rule of springs is kept.
    error : float
        Largest relative error of a natural frequency.
    band : float
        Upper end of the band, rad/s.

    Raises
    ------
    ValueError
        If the scene has no beam, or not even `MOST_LINKS` links are enough.
    """
    exact = frequencies_below(beam_arm(scene), band)
    first = max(1, len(exact) - scene.hub)

    def errors(links: int) -> Array:
        return relative_errors(straight_frequencies(scene, links, count=len(exact)), exact)

    def enough(links: int) -> bool:
        return bool(np.max(errors(links), initial=0.0) <= error)

    low, high = first - 1, first
    while not enough(high):
        if high >= MOST_LINKS:
            raise ValueError(f"{MOST_LINKS} links are not enough for {len(exact)} modes within {error:g}")
        low, high = high, min(2 * high, MOST_LINKS)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if enough(middle) else (middle, high)
    while high > first and enough(high - 1):  # errors need not fall at every step
        high -= 1
    found = straight_frequencies(scene, high, count=len(exact))
    below = None
    if high > 1:
        fewer = straight_frequencies(scene, high - 1, count=len(exact))
        below = relative_errors(fewer, exact[: len(fewer)])
        below = np.concatenate([below, np.full(len(exact) - len(below), np.nan)])
    return LinksNeeded(high, exact, found, errors(high), below)


def relative_errors(found: Array, exact: Array) -> Array:
    """Return each frequency's error: infinite where it is missing, zero for rigid-body motions."""
    errors = np.full(len(exact), np.inf)
    shared = min(len(found), len(exact))
    scale = np.where(exact[:shared] > 0.0, exact[:shared], 1.0)
    errors[:shared] = np.where(exact[:shared] > 0.0, np.abs(found[:shared] / scale - 1.0), 0.0)
    return errors


def continuous(scene: Scene) -> BeamArm | None:
    """Return the continuous beam a scene stands for, if it stands for one."""
    return beam_arm(scene) if scene.beam is not None else None
