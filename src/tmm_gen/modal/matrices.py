"""Mass, damping and stiffness matrices of an arm in small motion, gathered from its elements' matrices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import LinearArm, Placed

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Matrices:
    """``M q'' + C q' + K q = 0`` for the free angles ``q``: a motor's hub, then the links.

    Parameters
    ----------
    mass, damping, stiffness : array, (d, d)
        kg m^2, N m s/rad, N m/rad; symmetric.
    """

    mass: Array
    damping: Array
    stiffness: Array


def matrices(arm: LinearArm) -> Matrices:
    """Gather the matrices: motions outward by ``U11``, forces inward by ``U21``, power of ``s`` by power.

    The torque a joint passes on, less what all beyond it needs, is what turns the links there.
    """
    first = int(arm.hub)
    count = arm.scene.stations + first
    angle = arm.width - 1
    powers = _Powers(arm)
    motions = _motions(arm, powers, count)
    force: Array = np.zeros((3, arm.width, count))
    # of all free angles: the torque of the joint inboard, less the torque needed there; by powers of s
    missing = np.zeros((count + 1, 3, count))
    for placed, motion in zip(reversed(arm.elements), reversed(motions), strict=True):
        own = placed.station - 1 + first
        if placed.name == "joint":
            law = arm.functions(placed).impedance(placed.values)
            twist = -motion[angle]
            twist[own] += 1.0
            missing[own] = -force[:, angle]
            missing[own, :2] += law[:, None] * twist
            continue
        by_power, _, passing = powers.of(placed)
        force = np.asarray(np.linalg.solve(passing, force - by_power @ motion), float)
    if arm.hub:
        missing[0] = -force[:, angle]
    found = arm.sign * (missing[:-1] - missing[1:])
    stiffness, damping, mass = (found[:, power] for power in range(3))
    return Matrices(*(0.5 * (each + each.T) for each in (mass, damping, stiffness)))


class _Powers:
    """The elements' coefficients, computed once for identical elements."""

    def __init__(self, arm: LinearArm) -> None:
        self._arm = arm
        self._known: dict[tuple[str, tuple[float, ...]], tuple[Array, Array, Array]] = {}

    def of(self, placed: Placed) -> tuple[Array, Array, Array]:
        """Return an element's coefficients of powers of ``s``."""
        key = (placed.name, placed.values)
        if key not in self._known:
            self._known[key] = self._arm.functions(placed).powers(placed.values)
        return self._known[key]


def _motions(arm: LinearArm, powers: _Powers, count: int) -> list[Array]:
    """Return the motion at the inboard side of each element for a unit of each free angle, (width, count)."""
    first = int(arm.hub)
    motion = np.zeros((arm.width, count))
    if arm.hub:
        motion[-1, 0] = 1.0
    found = []
    for placed in arm.elements:
        found.append(motion)
        if placed.name == "joint":
            motion = motion.copy()
            motion[-1] = 0.0
            motion[-1, placed.station - 1 + first] = 1.0
        else:
            _, carrying, _ = powers.of(placed)
            motion = carrying @ motion
    return found
