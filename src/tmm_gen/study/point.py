"""One row of a study: a configuration, what became of it, and what it costs."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.native.timing import Cost
from tmm_gen.study.configuration import Configuration
from tmm_gen.study.outcome import Outcome, Result


@dataclass(frozen=True)
class Point:
    """A configuration with all that is measured of it.

    Parameters
    ----------
    configuration : Configuration
        How the motion is computed.
    result : Result
        Errors and counts.
    cost : Cost, optional
        Time of a step; None where no run of its family finished, or times were not asked for.
    """

    configuration: Configuration
    result: Result
    cost: Cost | None = None

    @property
    def finished(self) -> bool:
        """Whether there is an error to report."""
        return self.result.outcome is Outcome.FINISHED

    @property
    def error(self) -> float:
        """Time error and modelling error together; infinite where the run did not finish."""
        total = self.result.total_error
        return float("inf") if total is None else total

    @property
    def ns_per_second(self) -> float | None:
        """Nanoseconds of computing for a simulated second."""
        return self.cost.ns_per_step / self.configuration.step if self.cost else None

    @property
    def operations_per_second(self) -> float | None:
        """Floating-point operations for a simulated second."""
        operations = self.result.operations
        return None if operations is None else operations / self.configuration.step

    def values(self) -> dict[str, object]:
        """Return all figures by key."""
        return {
            **self.configuration.values(),
            **self.result.values(),
            "total_error": self.result.total_error,
            "ns_per_step": self.cost.ns_per_step if self.cost else None,
            "ns_spread": self.cost.spread if self.cost else None,
            "ns_per_simulated_second": self.ns_per_second,
            "operations_per_simulated_second": self.operations_per_second,
        }
