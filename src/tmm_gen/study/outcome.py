"""What became of one configuration."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import StrEnum


class Outcome(StrEnum):
    """How a run ended."""

    FINISHED = "finished"
    """There is an error to report, however large."""
    DIVERGED = "diverged"
    """The motion left all bounds."""
    REFUSED = "refused"
    """The scene, the generator or the kernel said no."""
    LOST = "lost"
    """The process that computed it died, time and again."""


@dataclass(frozen=True)
class Result:
    """What is measured of a configuration and is the same on every machine.

    Parameters
    ----------
    outcome : Outcome
        How the run ended.
    reason : str
        Why, where it did not finish; else empty.
    error : float, optional
        Largest distance between the computed and the reference motion of the same links at any instant, relative to
        how far the output travels: the time error.
    rms_error : float, optional
        Root mean square of the same.
    modelling_error : float, optional
        Of a beam: the same distance between the reference motions of so few and of infinitely many links.
    operations : int, optional
        Floating-point operations of one step.
    divisions, functions : int, optional
        Of these, divisions, and sines, cosines and roots.
    state_bytes, model_bytes : int, optional
        Of the C structs.
    code_bytes : int, optional
        Instructions and constants of the C, by `size`, compiled for this machine as it is run.
    """

    outcome: Outcome
    reason: str = ""
    error: float | None = None
    rms_error: float | None = None
    modelling_error: float | None = None
    operations: int | None = None
    divisions: int | None = None
    functions: int | None = None
    state_bytes: int | None = None
    model_bytes: int | None = None
    code_bytes: int | None = None

    @property
    def total_error(self) -> float | None:
        """Upper bound of the whole error: time error and modelling error added."""
        if self.error is None:
            return None
        return self.error + (self.modelling_error or 0.0)

    def values(self) -> dict[str, object]:
        """Return all figures by key."""
        return {**asdict(self), "outcome": self.outcome.value}
