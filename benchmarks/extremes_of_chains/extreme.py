"""A chain far from the usual: its stations, its first period, and the scene that says so."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene, parse_scene

Array = NDArray[np.float64]
Pattern = Literal["halves", "alternating", "graded"]
Start = Literal["loaded", "released"]
Real = Literal["float64", "float32"]
Unknown = Literal["acceleration", "increment", "displacement"]

STEPS = 32
"""How many are taken."""

_LONG = 300
"""Stations from which fewer steps are taken."""

_SWEEPS = 12
"""Of the iteration for the first period; it only sets the scale of the step."""

_SCENE = """
name = "{name}"
[model]
kind = "chain"
sweep = "{sweep}"
unknown = "{unknown}"
[integrator]
name = "{integrator}"
step = {step!r}
[base]
kind = "clamp"
{stations}
[[input]]
name = "tip_torque"
at = "tip"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
[emit]
backends = ["c"]
real = "{real}"
"""


@dataclass(frozen=True)
class ChainExtreme:
    """A clamped chain and a step.

    Parameters
    ----------
    links : int
        Number of links.
    stiffness_ratio, inertia_ratio : float
        Of the other joints and links to those at the base, whose stiffness and inertia are 1.
    step : float
        As a share of the first period.
    damping : float
        Joint damping over stiffness, as a share of the first period.
    real : {"float64", "float32"}
        Number type of the compiled kernel.
    sweep : {"riccati", "product"}
        How stations are combined.
    unknown : {"acceleration", "increment", "displacement"}
        What the sweep solves for.
    integrator : str
        Name.
    start : {"loaded", "released"}
        At rest, with a torque at the tip that deflects it by 1 rad; or let go from that deflection.
    pattern : {"halves", "alternating", "graded"}
        Which stations are the other ones: those of the outer half, every second one, or a geometric series.
    """

    links: int = 10
    stiffness_ratio: float = 1.0
    inertia_ratio: float = 1.0
    step: float = 1e-3
    damping: float = 0.0
    real: Real = "float64"
    sweep: Literal["riccati", "product"] = "riccati"
    unknown: Unknown = "acceleration"
    integrator: str = "newmark"
    start: Start = "loaded"
    pattern: Pattern = "halves"

    @property
    def steps(self) -> int:
        """How many steps are taken."""
        return STEPS if self.links < _LONG else STEPS // 4

    @property
    def stiffness(self) -> Array:
        """Of the joints, (n,)."""
        return self._ratios(self.stiffness_ratio)

    @property
    def inertia(self) -> Array:
        """Of the links, (n,)."""
        return self._ratios(self.inertia_ratio)

    @property
    def torque(self) -> float:
        """At the tip, N m, for a static deflection of 1 rad there."""
        return float(1.0 / np.sum(1.0 / self.stiffness))

    @property
    def deflection(self) -> Array:
        """Static deflection under that torque, rad, (n,)."""
        flexibility: Array = np.cumsum(1.0 / self.stiffness)
        shape: Array = flexibility / flexibility[-1]
        return shape

    @property
    def period(self) -> float:
        """First period, s: of the motion that inverse iteration from the static deflection finds.

        The flexibility of a chain is a sum of positive numbers, so no digits are lost at any ratio.
        """
        compliance, inertia = 1.0 / self.stiffness, self.inertia
        shape, square = self.deflection, 1.0
        for _ in range(_SWEEPS):
            torque = np.cumsum((inertia * shape)[::-1])[::-1]
            moved = np.cumsum(compliance * torque)
            square = float(np.sum(inertia * shape * moved) / np.sum(inertia * moved * moved))
            shape = moved / np.max(moved)
        return 2.0 * math.pi / math.sqrt(square)

    def scene(self, name: str = "extreme") -> Scene:
        """Return it as a scene."""
        h, c = self.step * self.period, self.damping * self.period
        stiffness, inertia = self.stiffness.tolist(), self.inertia.tolist()
        stations = []
        start = 0
        for k in range(1, self.links + 1):
            same = k < self.links and (stiffness[k], inertia[k]) == (stiffness[start], inertia[start])
            if same:
                continue
            stations.append(
                f"[[joint]]\nstiffness = {stiffness[start]!r}\ndamping = {c * stiffness[start]!r}\n"
                f"repeat = {k - start}\n[[link]]\ninertia = {inertia[start]!r}\nrepeat = {k - start}"
            )
            start = k
        return parse_scene(
            _SCENE.format(
                name=name,
                sweep=self.sweep,
                unknown=self.unknown,
                integrator=self.integrator,
                step=h,
                stations="\n".join(stations),
                real=self.real,
            )
        )

    def _ratios(self, ratio: float) -> Array:
        n = self.links
        place = np.arange(n)
        if self.pattern == "graded":
            return np.asarray(ratio ** (place / max(n - 1, 1)), float)
        other = place >= (n + 1) // 2 if self.pattern == "halves" else place % 2 == 1
        return np.where(other, ratio, 1.0)
