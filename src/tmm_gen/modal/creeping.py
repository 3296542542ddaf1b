"""Real poles of motions that dampers hold: which two belong to the same motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FAINT = 1e-12
"""Share of the largest damping that every motion has in a comparison: what no damper brakes has a length there too."""


def creeping_pairs(poles: Array, vectors: Array, damping: Array, loose: NDArray[np.intp]) -> Array:
    """Return the real poles of ``s^2 + C s + K`` two by two, a slow one first.

    Between minus and plus infinity as many eigenvalues of the symmetric matrix fall below zero as rise again, so that
    half of all real poles have a falling one, the fast poles, half a rising one. The same dampers brake a motion while
    it loses its speed (fast) and while it creeps back (slow): poles whose vectors are alike to the dampers belong
    together.

    Parameters
    ----------
    poles : array, (n,)
        1/s; exactly zero where a motion has no spring.
    vectors : array, (m, n)
        Theirs, of any length; those of zeros are not looked at.
    damping : array, (m, m)
        ``C`` in coordinates of unit mass.
    loose : array of int
        Coordinates without a spring.
    """
    from scipy.optimize import linear_sum_assignment  # slow to import

    zeros = int(np.sum(poles == 0.0))
    still = max(zeros - len(loose), 0)  # motions that no damper brakes either have two zeros
    moved, speeds = vectors[:, poles != 0.0], poles[poles != 0.0]
    inner = damping + _FAINT * float(np.max(np.abs(damping))) * np.eye(len(damping))
    braked = inner @ moved
    lengths = np.sum(moved * braked, axis=0)
    weight = 2.0 * speeds * np.sum(moved * moved, axis=0)
    order = np.argsort((weight + lengths) / (np.abs(weight) + lengths), kind="stable")
    creeping = zeros - 2 * still
    half = (len(speeds) + creeping) // 2
    fast, slow = order[:half], order[half:]
    alike = np.abs(moved[:, slow].T @ braked[:, fast]) / np.sqrt(np.outer(lengths[slow], lengths[fast]))
    if creeping:  # together they span the loose motions, in which no vector is one motion's own
        within = braked[loose][:, fast]
        held = np.linalg.pinv(inner[np.ix_(loose, loose)])
        share = np.sqrt(np.abs(np.sum(within * (held @ within), axis=0)) / lengths[fast])
        alike = np.concatenate([np.tile(share, (creeping, 1)), alike])
    slowly = np.concatenate([np.zeros(creeping), speeds[slow]])
    rows, columns = linear_sum_assignment(-alike)
    found = np.stack([slowly[rows], speeds[fast[columns]]], axis=1)
    return np.concatenate([np.zeros((still, 2)), found])
