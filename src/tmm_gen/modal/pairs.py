"""Poles of ``s^2 + C s + K`` two by two, one pair for each undamped mode."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.creeping import creeping_pairs

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pair = tuple[complex, complex]

_NOTHING = 1e-12
"""Share of the largest damping that counts as none."""


def quadratic(square: float, twice: float) -> Pair:
    """Return the roots of ``s^2 + twice s + square``, without cancellation."""
    half = 0.5 * twice
    root = np.sqrt(complex(half * half - square))
    large = -(half + root) if half >= 0.0 else -(half - root)
    if large == 0.0:
        return 0j, 0j
    if root.imag != 0.0:
        return complex(-half, abs(root.imag)), complex(-half, -abs(root.imag))
    return complex(square / large), complex(large)


def paired(stiffness: Array, damping: Array, guesses: list[Pair], loose: NDArray[np.intp]) -> list[Pair]:
    """Give each undamped mode the two poles that belong to it."""
    from scipy.linalg import eig
    from scipy.optimize import linear_sum_assignment

    size = len(stiffness)
    system = np.zeros((2 * size, 2 * size))
    system[:size, size:] = np.eye(size)
    system[size:, :size], system[size:, size:] = -stiffness, -damping
    still = _still(damping, loose)
    poles = eig(system, right=False)
    poles[np.argsort(np.abs(poles))[:still]] = 0.0
    wanted = np.array([pole for pair in guesses for pole in pair])
    _, order = linear_sum_assignment(_apart(wanted, poles))
    matched = poles[order].reshape(-1, 2)
    if np.any(np.abs(matched[:, 0] - matched[:, 1].conj()) * (np.abs(matched.imag).max(axis=1) > 0.0)):
        poles, vectors = eig(system)
        poles[np.argsort(np.abs(poles))[:still]] = 0.0
        real = poles.imag == 0.0
        upper, lower = vectors[:size, real].real, vectors[size:, real].real
        moved = np.where(np.abs(poles[real]) > 1.0, lower, upper)  # the larger half has more digits
        pairs = creeping_pairs(poles[real].real, moved, damping, loose)
        matched = _whole_pairs(poles[poles.imag > 0.0], pairs, np.array(guesses))
    return [_conjugates(complex(one), complex(other)) for one, other in matched]


def _still(damping: Array, loose: NDArray[np.intp]) -> int:
    """Return how many poles are exactly zero.

    One for each motion that no spring resists, as where it stands does not matter; two where no damper does either.
    """
    if len(loose) == 0:
        return 0
    braked = np.linalg.eigvalsh(damping[np.ix_(loose, loose)])
    least = _NOTHING * float(np.max(np.abs(damping)))
    return 2 * len(loose) - int(np.sum(np.abs(braked) > least))


def _apart(wanted: Complex, poles: Complex) -> Array:
    """Return how far poles lie from those wanted, relatively: slow ones are told apart as well as fast ones."""
    scale = np.maximum(np.abs(poles)[None, :], np.abs(wanted)[:, None])
    distance = np.abs(wanted[:, None] - poles[None, :])
    return np.divide(distance, scale, out=np.zeros_like(distance), where=scale > 0.0)


def _whole_pairs(upper: Complex, pairs: Array, guesses: Complex) -> Complex:
    """Give modes whole pairs, as damping couples them so much that the nearest poles are none.

    Parameters
    ----------
    upper : array, (a,)
        Poles with a positive imaginary part; these are given first.
    pairs : array, (b, 2)
        Real ones.
    guesses : array, (a + b, 2)
        Those of each undamped mode by itself.
    """
    from scipy.optimize import linear_sum_assignment

    found = np.zeros_like(guesses)
    modes, order = linear_sum_assignment(_apart(guesses[:, 0], upper))
    found[modes, 0], found[modes, 1] = upper[order], upper[order].conj()
    left = np.setdiff1d(np.arange(len(guesses)), modes)
    slow, fast = pairs.astype(complex).T
    apart = _apart(guesses[left, 0], slow) + _apart(guesses[left, 1], fast)
    rows, order = linear_sum_assignment(apart)
    found[left[rows]] = pairs[order]
    return found


def _conjugates(one: complex, other: complex) -> Pair:
    """Order a pair: the pole with positive imaginary part, or the slower one, first."""
    first = one.imag > other.imag if one.imag != other.imag else abs(one) <= abs(other)
    return (one, other) if first else (other, one)
