"""How the rules of the joint springs converge to the continuous beam."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.beam import beam_arm, natural_frequencies
from tmm_gen.modal.discretised import relative_errors, straight_frequencies
from tmm_gen.scene import Scene
from tmm_gen.scene.beam import Springs

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Convergence:
    """Errors of the lowest natural frequencies by number of links.

    Parameters
    ----------
    rule : {"clamped-segment", "half-clamp", "uniform", "thesis"}
        Rule of the springs.
    links : array, (k,)
        Numbers of links.
    errors : array, (k, modes)
        Relative; NaN where there are fewer links than modes.
    """

    rule: Springs
    links: NDArray[np.int64]
    errors: Array

    def slopes(self, links_from: int) -> Array:
        """Return the order of convergence of each mode: minus the slope of log error over log links, fitted.

        Parameters
        ----------
        links_from : int
            Smallest number of links that counts.
        """
        chosen = self.links >= links_from
        found: Array = -np.polyfit(np.log(self.links[chosen]), np.log(self.errors[chosen]), 1)[0]
        return found


def convergence(scene: Scene, rule: Springs, links: tuple[int, ...], modes: int) -> Convergence:
    """Measure how the natural frequencies of a scene's beam converge with the number of links.

    Parameters
    ----------
    scene : Scene
        With a ``[beam]`` on a clamp.
    rule : {"clamped-segment", "half-clamp", "uniform", "thesis"}
        Rule of the springs.
    links : tuple of int
        Numbers of links.
    modes : int
        How many frequencies.
    """
    exact = natural_frequencies(beam_arm(scene), modes)
    errors = np.array([relative_errors(straight_frequencies(scene, n, rule), exact) for n in links])
    return Convergence(rule, np.array(links), np.where(np.isfinite(errors), errors, np.nan))
