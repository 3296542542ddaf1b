"""Poles, natural frequencies, damping ratios and mode shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.damped import damped_modes
from tmm_gen.modal.linear import Linear
from tmm_gen.modal.undamped import undamped_modes

Array = NDArray[np.float64]

_FIRST = 16
"""Modes looked for first; twice as many each time they are not enough."""


@dataclass(frozen=True, eq=False)
class Mode:
    """One mode of small motion.

    Parameters
    ----------
    frequency : float
        Natural angular frequency, the geometric mean of both poles' moduli, rad/s; zero for a rigid-body
        motion and where the arm falls over (one pole is positive).
    damping_ratio : float or None
        Share of critical damping; None for a rigid-body or an unstable motion.
    poles : tuple of 2 complex
        1/s; a conjugate pair, or two real ones.
    shape : array, (d,)
        Angles of the free coordinates in the undamped mode, largest one 1; where damping mixes undamped modes, in the
        damped one at the phase where they are largest, of two real poles at the slower one.
    bound : float
        On the relative error of the frequency, estimated from the residuals of shape and poles.
    undamped : int or None
        Number of the undamped mode, counted from 0, whose shape it has; None where there is none.
    """

    frequency: float
    damping_ratio: float | None
    poles: tuple[complex, complex]
    shape: Array
    bound: float = 0.0
    undamped: int | None = None

    @property
    def hertz(self) -> float:
        """Natural frequency in Hz."""
        return float(self.frequency / (2.0 * np.pi))

    @property
    def motion(self) -> str:
        """What becomes of it, in words."""
        if self.unstable:
            return "falls over"
        if not self.frequency:
            return "turns freely"
        return "swings" if self.poles[0].imag else "creeps back"

    @property
    def unstable(self) -> bool:
        """Whether the motion grows."""
        return self.damping_ratio is None and max(pole.real for pole in self.poles) > 0.0


def find_modes(linear: Linear, count: int | None = None) -> tuple[Mode, ...]:
    """Return the modes of the lowest natural frequencies, in ascending order; what falls over comes first.

    Where damping does not couple the undamped modes (it is proportional to stiffness), each has its own quadratic
    equation; else each undamped mode is given the pair of poles nearest to its own, whatever pair that is. Two real
    poles count by the root of their product, as the frequency of a motion by itself does not depend on its damper.

    Parameters
    ----------
    linear : Linear
        Of an arm in small motion.
    count : int, optional
        How many; all by default.
    """
    found = damped_modes(linear, count)
    each = zip(found.pairs, found.shapes.T, found.bounds.tolist(), found.grown, strict=True)
    return tuple(_mode(*one) for one in each)


def modes_up_to(linear: Linear, limit: float) -> tuple[Mode, ...]:
    """Return the lowest modes, with all that swing no faster than a limit among them.

    Parameters
    ----------
    linear : Linear
        Of an arm in small motion.
    limit : float
        Angular frequency, rad/s.
    """
    count = min(_FIRST, linear.parts.size)
    while True:
        squares = undamped_modes(linear, count).squares
        if count == linear.parts.size or squares[-1] > limit**2:
            found = find_modes(linear, count)
            if count == linear.parts.size or found[-1].frequency > limit:
                return found
        count = min(2 * count, linear.parts.size)


def _mode(poles: tuple[complex, complex], shape: Array, bound: float, undamped: int | None) -> Mode:
    product, total = (poles[0] * poles[1]).real, (poles[0] + poles[1]).real
    scaled = shape / shape[np.argmax(np.abs(shape))]
    if product > 0.0:
        frequency = float(np.sqrt(product))
        return Mode(frequency, float(0.0 - total / (2.0 * frequency)), poles, scaled, bound, undamped)
    return Mode(0.0, None, poles, scaled, bound, undamped)
