"""Poles, natural frequencies, damping ratios and mode shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.matrices import Matrices

Array = NDArray[np.float64]

_PROPORTIONAL = 1e-10
"""Coupling of modes by damping below this, relative to their own, is none."""

_RIGID = 1e-7
"""Frequencies below this, relative to the highest, are zero: those of rigid-body motions are rounding."""


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
        Angles of the free coordinates in the undamped mode, largest one 1.
    """

    frequency: float
    damping_ratio: float | None
    poles: tuple[complex, complex]
    shape: Array

    @property
    def hertz(self) -> float:
        """Natural frequency in Hz."""
        return float(self.frequency / (2.0 * np.pi))

    @property
    def unstable(self) -> bool:
        """Whether the motion grows."""
        return self.damping_ratio is None and max(pole.real for pole in self.poles) > 0.0


def natural_modes(linear: Matrices) -> tuple[Array, Array]:
    """Return the undamped squared frequencies, increasing, and mode shapes, orthonormal to the mass matrix.

    Squares of rigid-body motions are set to zero; negative ones belong to unstable equilibria.
    """
    from scipy.linalg import eigh  # slow to import

    squares, shapes = eigh(linear.stiffness, linear.mass)
    squares = np.where(np.abs(squares) < _RIGID**2 * np.max(np.abs(squares)), 0.0, squares)
    return squares, shapes


def find_modes(linear: Matrices, count: int | None = None) -> tuple[Mode, ...]:
    """Return the lowest modes.

    Where damping does not couple the undamped modes (it is proportional to mass and stiffness), each has its
    own quadratic equation; else the poles are the eigenvalues of the first-order system, and each undamped
    mode is given the pair nearest to its own.

    Parameters
    ----------
    linear : Matrices
        Of an arm in small motion.
    count : int, optional
        How many; all by default.
    """
    squares, shapes = natural_modes(linear)
    damping = shapes.T @ linear.damping @ shapes
    own = np.diag(damping)
    coupling = np.abs(damping - np.diag(own))
    pairs = [_quadratic(square, twice) for square, twice in zip(squares, own, strict=True)]
    if np.any(coupling > _PROPORTIONAL * np.max(np.abs(own), initial=0.0)):
        pairs = _paired(linear, pairs)
    wanted = len(squares) if count is None else min(count, len(squares))
    return tuple(_mode(pairs[k], shapes[:, k]) for k in range(wanted))


def _mode(poles: tuple[complex, complex], shape: Array) -> Mode:
    product, total = (poles[0] * poles[1]).real, (poles[0] + poles[1]).real
    scaled = shape / shape[np.argmax(np.abs(shape))]
    if product > 0.0:
        frequency = float(np.sqrt(product))
        return Mode(frequency, float(-total / (2.0 * frequency)), poles, scaled)
    return Mode(0.0, None, poles, scaled)


def _quadratic(square: float, twice: float) -> tuple[complex, complex]:
    """Return the roots of ``s^2 + twice s + square``, without cancellation."""
    half = 0.5 * twice
    root = np.sqrt(complex(half * half - square))
    large = -(half + root) if half >= 0.0 else -(half - root)
    if large == 0.0:
        return 0j, 0j
    if root.imag != 0.0:
        return complex(-half, abs(root.imag)), complex(-half, -abs(root.imag))
    return complex(square / large), complex(large)


def _paired(linear: Matrices, guesses: list[tuple[complex, complex]]) -> list[tuple[complex, complex]]:
    """Give each undamped mode the two poles that belong to it."""
    from scipy.linalg import eig, solve
    from scipy.optimize import linear_sum_assignment

    size = len(linear.mass)
    system = np.zeros((2 * size, 2 * size))
    system[:size, size:] = np.eye(size)
    system[size:, :size] = -solve(linear.mass, linear.stiffness, assume_a="pos")
    system[size:, size:] = -solve(linear.mass, linear.damping, assume_a="pos")
    poles = eig(system, right=False)
    scale = np.max(np.abs(poles))
    poles = np.where(np.abs(poles) < _RIGID * scale, 0.0, poles)
    wanted = np.array([pole for pair in guesses for pole in pair])
    # on a logarithmic scale: slow poles are told apart as well as fast ones
    size_of = np.maximum(np.abs(poles), _RIGID * scale)
    distance = np.abs(wanted[:, None] - poles[None, :]) / np.maximum(
        size_of[None, :], np.maximum(np.abs(wanted), _RIGID * scale)[:, None]
    )
    _, order = linear_sum_assignment(distance)
    matched = poles[order].reshape(-1, 2)
    return [_conjugates(complex(one), complex(other)) for one, other in matched]


def _conjugates(one: complex, other: complex) -> tuple[complex, complex]:
    """Order a pair: the pole with positive imaginary part, or the slower one, first."""
    first = one.imag > other.imag if one.imag != other.imag else abs(one) <= abs(other)
    return (one, other) if first else (other, one)
