"""Numbers of an arm fitted to a recorded response."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, get_args

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.given import number, required, signals
from tmm_gen.api.html import html_table
from tmm_gen.api.run import Run
from tmm_gen.api.several import Few, texts
from tmm_gen.api.words import path_of
from tmm_gen.calibration.calibrate import Calibration, Loss
from tmm_gen.calibration.calibrate import calibrate as fit
from tmm_gen.calibration.record import headings_of, known_columns, missing_inputs, read_record, unread
from tmm_gen.errors import UserError
from tmm_gen.inputs.clock import UNITS, from_start
from tmm_gen.inputs.curve import through
from tmm_gen.inputs.given import TIME, input_names
from tmm_gen.inputs.sampled import tabled
from tmm_gen.inputs.signals import Signal
from tmm_gen.scene import Scene

if TYPE_CHECKING:
    from tmm_gen.api.arm import Arm

__all__ = ["Calibrated", "fitted"]

_COLUMNS = {
    "key": "key",
    "given": "given",
    "value": "fitted",
    "deviation": "standard deviation",
    "low": "95 % from",
    "high": "to",
    "change_percent": "change (%)",
}


@dataclass(frozen=True, eq=False, repr=False)
class Calibrated:
    """What a fit has found.

    Parameters
    ----------
    calibration : Calibration
        What was found.
    arm : Arm
        With the fitted numbers.
    """

    calibration: Calibration
    arm: Arm

    @property
    def values(self) -> dict[str, float]:
        """The fitted numbers by key."""
        return {each.key: each.value for each in self.calibration.found}

    @property
    def deviations(self) -> dict[str, float]:
        """Their standard deviations."""
        return {each.key: each.deviation for each in self.calibration.found}

    @property
    def correlation(self) -> NDArray[np.float64]:
        """Of the fitted numbers' logarithms, (p, p)."""
        return self.calibration.correlation

    @property
    def misfit(self) -> float:
        """Root mean square of what is left, relative to the record's standard deviation."""
        return self.calibration.misfit

    @property
    def rows(self) -> list[dict[str, object]]:
        """What ``tmm-gen calibrate --json`` has of each number."""
        return list(self.calibration.rows())

    @property
    def statement(self) -> str:
        """How well the model follows the record now, in sentences."""
        return "\n".join(self.calibration.sentences())

    def __repr__(self) -> str:
        """Say what was fitted."""
        found = ", ".join(f"{key} = {value:.6g}" for key, value in self.values.items())
        return f"<Calibration of {self.arm.name}: {found}; {100 * self.misfit:.3g} % left>"

    def _repr_html_(self) -> str:
        title = f"{self.calibration.scene.title}: fitted to {self.calibration.samples} samples"
        return html_table(title, _COLUMNS, self.rows, self.statement.splitlines())


def fitted(
    scene: Scene,
    record: object,
    keys: Few,
    time_unit: object,
    start: float | None,
    loss: object,
    most_misfit: float,
    acting: Mapping[str, object],
) -> Calibration:
    """Fit; arguments as of :meth:`tmm_gen.Arm.calibrate`."""
    unit = UNITS.get(time_unit) if isinstance(time_unit, str) else None
    if unit is None:
        raise UserError(f"time_unit: must be one of {', '.join(UNITS)}, not {time_unit!r}.")
    way = next((each for each in get_args(Loss) if each == loss), None)
    if way is None:
        raise UserError(f"loss: must be 'linear' or 'huber', not {loss!r}.")
    recorded = _recorded(scene, record)
    missing = missing_inputs(scene, recorded)
    for name in acting:
        if name not in missing:
            raise UserError(f"{name}: is a column of the record. Leave it out.")
    given = {**recorded, **signals(scene, acting, 0)}
    done = fit(
        scene,
        from_start(given, 0.0, unit),
        texts("fit", keys) or None,
        start=None if start is None else unit * number("start", start),
        loss=way,
        most_misfit=required("max_misfit", most_misfit, ""),
    )
    return replace(done, unread=unread(scene, _headings(record)))


def _headings(record: object) -> list[str]:
    """Return the names of a record's columns; of a run's, which are the scene's own, none."""
    if isinstance(record, Run):
        return []
    return list(record) if isinstance(record, Mapping) else headings_of(path_of("record", record))


def _recorded(scene: Scene, record: object) -> dict[str, Signal]:
    """Return the columns of a file, a run, or a mapping that the scene knows."""
    if isinstance(record, Run):
        record = {TIME: record.time, **record.inputs, **record.outputs}
    if not isinstance(record, Mapping):
        return read_record(scene, path_of("record", record))
    if TIME not in record:
        raise UserError(
            f"record: has no '{TIME}'. Give a mapping with it and with inputs and outputs by name."
        )
    angles = input_names(scene)[1]
    found: dict[str, Signal] = {}
    for name in known_columns(scene, list(record), "record"):
        times, values = np.asarray(record[TIME]), np.asarray(record[name])
        if values.dtype.kind == "f" and values.shape == times.shape and values.ndim == 1:
            kept = ~np.isnan(values)  # a sample that is missing
            times, values = times[kept], values[kept]
        table = tabled(name, times, values)
        found[name] = through(table) if name in angles else table
    return found
