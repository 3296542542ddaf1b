"""The polynomial of a step whose stages are solved at once: its accelerations at the stages, anywhere in the step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.scene import Scene

Array = NDArray[np.float64]

HUB = "hub_"
"""What the names of a hub's own state begin with."""

_FIRST = "_stage1"
"""What the name of an acceleration at a step's first stage ends with."""


@dataclass(frozen=True)
class StagePolynomial:
    """Accelerations at the stages of a step, and the polynomial through them.

    Parameters
    ----------
    nodes : tuple of float
        Instants of the stages, in steps from the start of the step.
    moving : tuple of str
        Names of the accelerations at the step's end: of joints, of a hub, of a base that floats.
    """

    nodes: tuple[float, ...]
    moving: tuple[str, ...]

    def names(self, newest: str) -> list[str]:
        """Return the names of accelerations at the stages, in order, by that of the one at the end."""
        found = [f"{newest}_stage{k + 1}" for k in range(len(self.nodes))]
        if self.nodes[-1] == 1.0:
            found[-1] = newest
        return found

    @cached_property
    def _powers(self) -> Array:
        """Coefficients in powers of the share of the step, lowest first, by values at the stages, (s, s)."""
        powers: Array = np.linalg.inv(np.vander(np.array(self.nodes), increasing=True))
        return powers

    def weights(self, shares: ArrayLike, integrals: int = 0) -> Array:
        """Return by what each stage counts at some places of the step, or in an integral from its start.

        Parameters
        ----------
        shares : array_like, (k,)
            In steps from the start of the step.
        integrals : {0, 1, 2}
            How often to integrate over shares.

        Returns
        -------
        array, (k, s)
        """
        at = np.atleast_1d(np.asarray(shares, float))[:, None]
        degree = np.arange(len(self.nodes))
        factor = np.ones(len(degree))
        for more in range(1, integrals + 1):
            factor = factor / (degree + more)
        found: Array = (at ** (degree + integrals) * factor) @ self._powers
        return found

    def over(self, state: Mapping[str, Any], begin: float, span: float) -> dict[str, Array]:
        """Return the accelerations at the stages of another step, by the polynomial of the one that led to a state.

        Parameters
        ----------
        state : mapping
            By name.
        begin, span : float
            Where that step begins and how long it is, in steps from the start of the one that led there.
        """
        moved = self.weights(begin + span * np.array(self.nodes))
        found: dict[str, Array] = {}
        for newest in self.moving:
            names = self.names(newest)
            values = np.stack([np.asarray(state[name], float) for name in names])
            there = np.tensordot(moved, values, axes=1)
            found |= dict(zip(names, there, strict=True))
        return found


def stage_polynomial(scene: Scene, names: Iterable[str]) -> StagePolynomial | None:
    """Return the polynomial of a scene's steps; None where its kernel keeps no accelerations of stages.

    Parameters
    ----------
    scene : Scene
        Whose integrator.
    names : iterable of str
        Of what its kernel's states hold.
    """
    kept = set(names)
    if "acceleration_stage1" not in kept:
        return None
    from tmm_gen.derive.integrators.registry import integrator  # SymPy comes with it

    scheme = integrator(scene.integrator.name, **scene.integrator.parameters).main
    nodes = tuple(float(stage.instant) for stage in scheme.stages)
    moving = tuple(name.removesuffix(_FIRST) for name in sorted(kept) if name.endswith(_FIRST))
    return StagePolynomial(nodes, moving)
