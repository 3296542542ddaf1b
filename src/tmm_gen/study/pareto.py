"""What nothing beats: points that are better in one respect than all that are as good in the other."""

from __future__ import annotations

from collections.abc import Sequence


def pareto_front(points: Sequence[tuple[float, float]]) -> list[int]:
    """Return which points no other point beats in both respects, both to be small.

    Parameters
    ----------
    points : sequence of (float, float)
        Error and cost of each.

    Returns
    -------
    list of int
        Positions, by increasing cost. Of equal points the first one counts.
    """
    order = sorted(range(len(points)), key=lambda k: (points[k][1], points[k][0], k))
    front: list[int] = []
    best = float("inf")
    for k in order:
        if points[k][0] < best:
            front.append(k)
            best = points[k][0]
    return front
