"""What a search has chosen: equal steps, or steps that a tolerance chooses."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.study.by_tolerance import ByTolerance
from tmm_gen.study.point import Point
from tmm_gen.study.verify import Verified


@dataclass(frozen=True)
class Winner:
    """What keeps all bounds in the least time.

    Parameters
    ----------
    integrator : str
        Its name.
    step : float or None
        s; None where a tolerance chooses steps.
    tolerance : float or None
        None where all steps are equal.
    error : float
        Largest error of the output, of a run of its own, relative to its travel.
    ns_per_second : float
        Nanoseconds of computing for a simulated second.
    """

    integrator: str
    step: float | None
    tolerance: float | None
    error: float
    ns_per_second: float

    @classmethod
    def of_equal_steps(cls, point: Point, checked: Verified) -> Winner:
        """Return what was chosen, as it does when run afresh."""
        family, step = point.configuration.family, point.configuration.step
        error = checked.error + (point.result.modelling_error or 0.0)
        return cls(family.integrator, step, None, error, checked.ns_per_second)

    @classmethod
    def by_tolerance(cls, each: ByTolerance) -> Winner:
        """Return a run by a tolerance."""
        run = each.run
        assert run.error is not None  # it keeps a bound
        return cls(run.family.integrator, None, run.tolerance, run.error, each.ns_per_second)
