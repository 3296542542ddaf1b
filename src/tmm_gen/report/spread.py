"""Which rows of a run to show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def spread(time: NDArray[np.float64], count: int) -> NDArray[np.int64]:
    """Return the rows next to instants spread evenly over a motion, the first and the last among them.

    Parameters
    ----------
    time : array, (k,)
        Instants of the rows, which may be apart by any time, s.
    count : int
        How many at most.
    """
    evenly = np.linspace(time[0], time[-1], count)
    return np.unique(np.round(np.interp(evenly, time, np.arange(len(time)))).astype(np.int64))
