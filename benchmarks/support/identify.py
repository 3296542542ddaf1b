"""Poles read off a recorded free motion, by the matrix pencil."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NOISE = 1e-11


def identify_poles(motion: Array, step: float, most: int = 16) -> Complex:
    """Return the poles ``s`` of a sum of exponentials ``exp(s t)`` sampled at equal steps.

    The matrix pencil (Hua & Sarkar 1990, IEEE Trans. Acoust. Speech Signal Process. 38, 814-824): the eigenvalues of
    the map from the samples' history to the history one step later, on the subspace the samples span.

    Parameters
    ----------
    motion : array, (k,)
        Samples, free of noise but for rounding.
    step : float
        s.
    most : int
        Most poles looked for.

    Returns
    -------
    array, (poles,)
        1/s, fastest oscillation first; imaginary parts up to ``pi / step`` can be told apart.
    """
    rows = len(motion) // 2
    history = np.lib.stride_tricks.sliding_window_view(motion, rows)
    _, sizes, right = np.linalg.svd(history, full_matrices=False)
    rank = min(most, int(np.sum(sizes > _NOISE * sizes[0])))
    basis = right[:rank].T
    values = np.linalg.eigvals(np.linalg.lstsq(basis[:-1], basis[1:], rcond=None)[0])
    values = values[np.abs(values) > 0.0]
    poles = np.log(values.astype(complex)) / step
    found: Complex = poles[np.argsort(-poles.imag)]
    return found
