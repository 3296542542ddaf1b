"""Clocks of files: a simulation begins at zero, a recorder's clock where it likes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.inputs.curve import Curve
from tmm_gen.inputs.signals import Signal, Table

UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Units of a clock, s."""

_NEAR = 1.5
"""A clock whose first instant is within so many sampling intervals of zero may start at zero: many recorders write
their first row one interval after they start."""


@dataclass(frozen=True)
class Spacing:
    """How the rows of tables with one clock lie.

    Parameters
    ----------
    first, last : float
        s, of all of them.
    interval : float
        s between rows, the median; infinite where there is one row only.
    """

    first: float
    last: float
    interval: float


def spacing(tables: Mapping[str, Table]) -> Spacing:
    """Return how the rows of tables lie, one at least."""
    intervals = np.concatenate([np.diff(table.times) for table in tables.values()])
    return Spacing(
        first=min(float(table.times[0]) for table in tables.values()),
        last=max(float(table.times[-1]) for table in tables.values()),
        interval=float(np.median(intervals)) if intervals.size else float("inf"),
    )


def starts_of(outputs: Mapping[str, Table], inputs: Mapping[str, Signal]) -> tuple[float, ...]:
    """Return at what time of a record's clock the arm may have started: where the clock does, mostly.

    Parameters
    ----------
    outputs : mapping from str to Table
        Recorded, one at least.
    inputs : mapping from str to Signal
        What acted; tables have the clock of the outputs.

    Returns
    -------
    tuple of float
        One, or, if the first row is hardly later than zero, zero and that of the first row.

    Raises
    ------
    UserError
        If the clock may as well start at zero as at its first instant, and the two are far apart.
    """
    rows = spacing(outputs)
    tables = [table for table in map(_table, inputs.values()) if table is not None]
    early = [float(table.times[0]) for table in tables if table.times[-1] >= rows.first]
    first = min([rows.first, *early])
    if 0.0 <= first <= _NEAR * min(rows.interval, rows.last - first):
        return tuple(dict.fromkeys((0.0, first)))
    if 0.0 < first <= rows.last - first:
        raise UserError(
            f"the record begins at {first:g} s of its clock: the arm may have started then, or at 0 s. "
            f"Say when it was in the scene's initial state: --start {first:g} or --start 0."
        )
    return (first,)


def from_start(signals: Mapping[str, Signal], start: float, scale: float = 1.0) -> dict[str, Signal]:
    """Return signals on a clock in seconds that is zero at the start of the motion.

    Parameters
    ----------
    signals : mapping from str to Signal
        Tables are put on the new clock, others are the same at all times.
    start : float
        On the old clock, after scaling.
    scale : float
        Seconds in a unit of the old clock.

    Raises
    ------
    UserError
        If a signal with instants of its own is no table.
    """
    return {name: _moved(name, signal, start, scale) for name, signal in signals.items()}


def _moved(name: str, signal: Signal, start: float, scale: float) -> Signal:
    if isinstance(signal, Table):
        return replace(signal, times=scale * signal.times - start)
    if isinstance(signal, Curve):
        return signal.on_clock(start, scale)
    if len(signal.knots) and (start or scale != 1.0):
        raise UserError(
            f"the input '{name}' cannot be put on another clock. Let the record start at 0, in seconds: subtract the "
            "first instant from the columns `time`."
        )
    return signal


def _table(signal: Signal) -> Table | None:
    """Return the rows a signal was made from, if it was."""
    if isinstance(signal, Curve):
        return signal.table
    return signal if isinstance(signal, Table) else None


def refuse_what_is_unknown(inputs: Mapping[str, Signal], until: float, interval: float) -> None:
    """Refuse inputs, on the clock of the motion, of which the record does not tell what acted.

    Parameters
    ----------
    inputs : mapping from str to Signal
        What acted.
    until : float
        s; end of the record.
    interval : float
        s; how much later than the motion an input may begin.

    Raises
    ------
    UserError
        If a table lies outside of the record, or begins late and not with zero.
    """
    for name, signal in inputs.items():
        table = _table(signal)
        if table is None or len(table.times) < 2:  # one row is a constant
            continue
        first, last = float(table.times[0]), float(table.times[-1])
        if last < 0.0 or first > until:
            raise UserError(
                f"the input '{name}' is given from {first:g} s to {last:g} s after the start of the motion, the record "
                f"from 0 to {until:g} s: their clocks differ. Give both the same clock."
            )
        if first > _NEAR * interval and table.values[0] != 0.0:
            raise UserError(
                f"the input '{name}' is given only from {first:g} s after the start of the motion, where it is "
                f"{table.values[0]:g}: what acted before is not known. Add earlier rows, or say when the motion "
                "started by --start."
            )


def refuse_other_clock(signals: Mapping[str, Signal], until: float) -> None:
    """Refuse tables of which a simulation from zero would see no more than the first or the last value.

    Parameters
    ----------
    signals : mapping from str to Signal
        Inputs of the simulation.
    until : float
        s; its end.

    Raises
    ------
    UserError
        If a table of several rows ends before zero or begins when all is over.
    """
    for name, signal in signals.items():
        table = _table(signal)
        if table is None or len(table.times) < 2:
            continue
        first, last = float(table.times[0]), float(table.times[-1])
        if first >= until or last < 0.0:
            raise UserError(
                f"--input: the rows of '{name}' go from {first:.10g} s to {last:.10g} s, the simulation from 0 to "
                f"{until:g} s, so that it would see none of them. Subtract the first instant from the column `time` "
                "(in seconds), or simulate longer (--until)."
            )
