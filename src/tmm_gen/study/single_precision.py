"""What float32 costs and saves: each configuration beside the same one in float64."""

from __future__ import annotations

from dataclasses import dataclass, replace
from statistics import median

from tmm_gen.study.point import Point
from tmm_gen.study.study import Study


@dataclass(frozen=True)
class SinglePrecision:
    """float32 beside float64, over pairs that differ in nothing else.

    Parameters
    ----------
    pairs : int
        How many finished in both.
    least, least_double : float
        Least time errors of either, relative to the travel of the output.
    time : float, optional
        Time of a step over that of float64, the median of all pairs; None where times were not measured.
    """

    pairs: int
    least: float
    least_double: float
    time: float | None

    def sentence(self) -> str:
        """Say it."""
        took = "" if self.time is None else f"a step takes {self.time:.2f} times as long, and "
        return (
            f"float32 beside float64 ({self.pairs} pair{'s' * (self.pairs > 1)}): {took}the least time error is "
            f"{self.least:.1e} instead of {self.least_double:.1e}."
        )


def single_precision(study: Study) -> SinglePrecision | None:
    """Return what float32 costs in a study; None if no configuration was tried in both number types."""
    finished = {point.configuration: point for point in study.points if point.finished}
    pairs: list[tuple[Point, Point]] = []
    for configuration, single in finished.items():
        family = replace(configuration.family, real="float64")
        double = finished.get(replace(configuration, family=family))
        if configuration.family.real == "float32" and double is not None:
            pairs.append((single, double))
    if not pairs:
        return None
    times = [a.cost.ns_per_step / b.cost.ns_per_step for a, b in pairs if a.cost and b.cost]
    least, least_double = (min(_time_error(pair[k]) for pair in pairs) for k in (0, 1))
    return SinglePrecision(len(pairs), least, least_double, median(times) if times else None)


def _time_error(point: Point) -> float:
    assert point.result.error is not None  # it has finished
    return point.result.error
