"""What a fit has found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.calibration.telling import hardly_apart
from tmm_gen.calibration.uncertainty import SURE
from tmm_gen.scene import Scene
from tmm_gen.scene.problem import Path

__all__ = ["Calibration", "Fitted"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Fitted:
    """A fitted number.

    Parameters
    ----------
    key : str
        In the scene, dotted.
    given, value : float
        Before and after.
    deviation : float
        Standard deviation of ``value``, from the covariance of the fit.
    """

    key: str
    given: float
    value: float
    deviation: float

    @property
    def interval(self) -> tuple[float, float]:
        """95 % confidence interval, of a normal distribution of the logarithm."""
        reach = float(np.exp(min(SURE * self.deviation / self.value, 700.0)))
        return self.value / reach, self.value * reach


@dataclass(frozen=True, eq=False)
class Calibration:
    """The outcome of a fit.

    Parameters
    ----------
    scene : Scene
        With the fitted numbers.
    changes : mapping from path to float
        What changed in its file.
    found : tuple of Fitted
        One for each.
    correlation : array, (p, p)
        Of the fitted numbers' logarithms.
    misfit_before, misfit : float
        Root mean square of what the model is off, relative to the record's standard deviation.
    samples : int
        Numbers compared.
    outliers : int
        Of these, given less weight by Huber's loss.
    start : float
        When the motion started, on the clock of the record, s.
    unread : tuple of str
        What is said of columns of the record that the scene does not know.
    """

    scene: Scene
    changes: Mapping[Path, float]
    found: tuple[Fitted, ...]
    correlation: Array
    misfit_before: float
    misfit: float
    samples: int
    outliers: int
    start: float
    unread: tuple[str, ...] = ()

    def rows(self) -> Iterator[dict[str, object]]:
        """Yield a row for each number."""
        for found in self.found:
            low, high = found.interval
            yield {
                "key": found.key,
                "given": found.given,
                "value": found.value,
                "deviation": found.deviation,
                "low": low,
                "high": high,
                "change_percent": 100.0 * (found.value / found.given - 1.0),
            }

    def sentences(self) -> list[str]:
        """Say how well the model follows the record now."""
        said = [
            f"what is left: {100 * self.misfit:.3g} % of the record's standard deviation, "
            f"{100 * self.misfit_before:.3g} % before"
        ]
        said += hardly_apart([each.key for each in self.found], self.correlation)
        if self.outliers:
            said.append(f"{self.outliers} of {self.samples} samples are far off and were given less weight")
        if self.start:
            said.append(f"the arm starts at {self.start:.10g} s of the record's clock")
        return [*said, *self.unread]
