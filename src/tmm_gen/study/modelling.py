"""What it costs in accuracy to cut a beam into few links, apart from how time is stepped.

The motion of a beam in pieces of length ``l`` goes to that of the beam like ``l**p``. Reference motions with three
numbers of links, each twice the one before, give ``p`` and by Richardson's extrapolation the limit. Pieces need not be
half as long then, as the last link may be half a piece. Nothing here knows a kernel.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene, SceneError
from tmm_gen.scene.beam import piece_length
from tmm_gen.study.cells import cut_into, cuts
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.truth import Truth

Array = NDArray[np.float64]

_COARSEST = 10
"""Links of the coarsest of the three, or a quarter of those asked for if that is more: references take long."""

_HIGHEST = 64.0
"""Order beyond which none is told from another: what is left is rounding."""

_COARSEST_IN_SPACE = 3
"""Cells of each beam in space: one is two or three joints."""

_INSTANTS = 401
_CONVERGING = 1.5
"""Least factor between successive differences for an extrapolation to mean something."""


@dataclass(frozen=True)
class Modelling:
    """The modelling error of a number of links.

    Parameters
    ----------
    links : int
        How many.
    error : float
        Largest distance of the output from that of the beam, relative to its travel.
    order : float
        With which power of the pieces' length errors fall, as observed.
    """

    links: int
    error: float
    order: float


def depends_on_links(scene: Scene, excitation: Excitation) -> bool:
    """Return whether motions with different numbers of links can be compared at all.

    There must be a beam, and neither loads nor the output may be at a numbered link, which would move.
    """
    links = cut_into(scene)
    if links is None:
        return False
    places = [item.at for item in scene.inputs if item.name in excitation.signals]
    places += [item.at for item in scene.outputs if item.name == excitation.output]
    if any(isinstance(place, int) for place in places):
        return False
    try:
        scene.replace(**{key: new for key, (_, new) in cuts(scene, 2 * links).items()})
    except SceneError:  # motion or load given link by link
        return False
    return True


def modelling_errors(links: Iterable[int], truth: Callable[[int], Truth]) -> dict[int, Modelling]:
    """Return the modelling error of some numbers of links, and of those extrapolated from.

    Empty if motions do not converge visibly.

    Parameters
    ----------
    links : iterable of int
        Numbers of links; at least one. For what scenes, see :func:`depends_on_links`.
    truth : callable
        Returns the reference motion with a number of links.
    """
    wanted = sorted(set(links))
    in_space = truth(wanted[0]).scene.spatial is not None
    start = max(_COARSEST_IN_SPACE if in_space else _COARSEST, math.ceil(wanted[-1] / 4))
    numbers = [start * factor for factor in (1, 2, 4)]
    levels = [truth(number) for number in numbers]
    times = np.linspace(0.0, levels[0].excitation.until, _INSTANTS)
    coarse, middle, fine = (level.at(times) for level in levels)
    ratio = float(np.linalg.norm(middle - coarse)) / max(float(np.linalg.norm(fine - middle)), 1e-300)
    if ratio < _CONVERGING:
        return {}
    order, more = _extrapolated(ratio, [_piece(level.scene) for level in levels])
    limit = fine + (fine - middle) * more
    return {
        n: Modelling(n, _distance(truth(n).at(times), limit, levels[-1].travel), order)
        for n in sorted({*wanted, *numbers})
    }


def _piece(scene: Scene) -> float:
    """Return a length that falls as that of the pieces does."""
    if (cells := cut_into(scene)) is not None and scene.spatial is not None:
        return 1.0 / cells
    assert scene.beam is not None  # else there is no number of links to choose
    return float(piece_length(scene.beam))


def _extrapolated(ratio: float, lengths: Sequence[float]) -> tuple[float, float]:
    """Return the order, and what is still missing beyond the third motion, as a share of the last difference.

    Parameters
    ----------
    ratio : float
        First difference of the motions over the last one, above 1.
    lengths : sequence of float
        Of the pieces in the three motions, falling.
    """
    from scipy.optimize import brentq

    coarse, middle = (length / lengths[2] for length in lengths[:2])

    def off(order: float) -> float:
        return float((coarse**order - middle**order) / (middle**order - 1.0) - ratio)

    order = float(brentq(off, 1e-3, _HIGHEST)) if off(_HIGHEST) > 0.0 else _HIGHEST
    return order, 1.0 / (middle**order - 1.0)


def _distance(found: Array, limit: Array, travel: float) -> float:
    return float(np.max(np.linalg.norm(found - limit, axis=0)) / travel)
