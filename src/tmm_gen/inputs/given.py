"""What a user gives as inputs of a simulation: numbers, profiles and CSV files.

``NAME=NUMBER`` is constant; ``NAME=smooth:0:1.5:0.8s`` is a profile; ``NAME=FILE.csv`` is one column of a file;
``FILE.csv`` has a column for each input. In files values are linear in between, and the last one stays; so does the
first before it. The angle of a prescribed base is followed with its rate and acceleration, as
:mod:`tmm_gen.inputs.curve` says; a file may have them too, as ``NAME_rate`` and ``NAME_acceleration``.
"""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.inputs.curve import rates_fit, through, with_rates
from tmm_gen.inputs.profiles import is_profile, profile
from tmm_gen.inputs.signals import Constant, Signal, Table
from tmm_gen.reading import open_table
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import ACCELERATION, PRESCRIBED, RATE

_FIT = 1.5
"""Rates that are so many times the slopes of the angles, more or less, are in another unit."""

TIME = "time"
"""Name of the column of instants, s."""

_MISSING = ("", "nan")
"""What tools write for a sample that is missing."""


def input_names(scene: Scene) -> tuple[tuple[str, ...], frozenset[str]]:
    """Return the names of a scene's inputs, and which of them prescribe a motion."""
    angles = frozenset(item.name for item in scene.inputs if item.acts in PRESCRIBED)
    return tuple(item.name for item in scene.inputs), angles


def read_inputs(
    given: Iterable[str], names: tuple[str, ...], angles: Collection[str] = ()
) -> dict[str, Signal]:
    """Return the inputs a user gives, by name.

    Parameters
    ----------
    given : iterable of str
        ``NAME=NUMBER``, ``NAME=PROFILE``, ``NAME=FILE.csv`` or ``FILE.csv``.
    names : tuple of str
        Inputs of the scene.
    angles : collection of str
        Those of them that prescribe an angle, whose rate and acceleration a file may have too.

    Raises
    ------
    UserError
        If a name is unknown or given twice, a number is none, or a file cannot be used.
    """
    found: dict[str, Signal] = {}
    files: list[str] = []
    for text in given:
        name, equals, value = text.partition("=")
        if not equals and text.strip() in names and not Path(text).exists():
            raise UserError(f"--input {text}: has no value. Write for example --input {text.strip()}=1.5.")
        if not equals or Path(text).is_file():
            files.append(text)
            continue
        _known(name.strip(), names, text)
        _once(name.strip(), found, text)
        found[name.strip()] = _signal(name.strip(), value.strip(), text, angles)
    for text in files:
        wanted = tuple(name for name in names if name not in found)
        if not wanted:
            raise UserError(f"--input {text}: every input is given already. Leave it out.")
        found |= read_tables(Path(text), wanted, angles)
    return found


def constant_inputs(scene: Scene, given: Sequence[str]) -> dict[str, float]:
    """Return the constant inputs that a user gives as ``NAME=VALUE``, by name.

    Raises
    ------
    UserError
        If a word is none of these, names no input, or the scene is a chain, whose motion no load changes.
    """
    names = [item.name for item in scene.inputs]
    found: dict[str, float] = {}
    for text in given:
        name, equals, value = text.partition("=")
        if scene.model.linear:
            raise UserError(
                f"--input {text}: a chain is linear, its modes do not depend on loads. Leave it out."
            )
        if not equals or name not in names:
            listed = f"inputs are {', '.join(names)}" if names else "the scene has no [[input]]"
            raise UserError(f"--input {text}: write NAME=VALUE; {listed}.")
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise UserError(f"--input {text}: '{value}' is not a number.")
        found[name] = number
    return found


def table_files(given: Iterable[str]) -> list[Path]:
    """Return the files among what a user gives as inputs."""
    parts = [part for text in given for part in (text, text.partition("=")[2]) if part]
    return [path for path in map(Path, parts) if os.path.lexists(path)]


def _signal(name: str, value: str, text: str, angles: Collection[str]) -> Signal:
    """Return a constant, a profile, or the column of a file."""
    try:
        number = float(value)
    except ValueError:
        if is_profile(value) and not Path(value).is_file():
            return profile(value, text)
        if Path(value).suffix.lower() != ".csv" and not Path(value).is_file():
            raise UserError(
                f"--input {text}: '{value}' is neither a number nor a CSV file nor a profile. "
                f"Write for example --input {name}=1.5, --input {name}=file.csv or --input {name}=smooth:0:1.5:0.8s."
            ) from None
        return read_tables(Path(value), (name,), angles)[name]
    if not math.isfinite(number):
        raise UserError(f"--input {text}: {value} is not finite. Write for example --input {name}=1.5.")
    return Constant(number)


def _known(name: str, names: tuple[str, ...], text: str) -> None:
    if name in names:
        return
    if not names:
        raise UserError(f"--input {text}: the scene has no inputs. Add [[input]] to it.")
    near = get_close_matches(name, names, n=1)
    remedy = f"Did you mean {near[0]}?" if near else f"Its inputs are {', '.join(names)}."
    raise UserError(f"--input {text}: the scene has no input '{name}'. {remedy}")


def _once(name: str, found: dict[str, Signal], text: str) -> None:
    if name in found:
        raise UserError(f"--input {text}: '{name}' is given twice. Give it once.")


def read_tables(
    path: Path,
    names: tuple[str, ...],
    angles: Collection[str] = (),
    gaps: bool = False,
    what: str = "--input: ",
) -> dict[str, Signal]:
    """Return columns of a CSV file with a ``time`` column.

    Parameters
    ----------
    path : path
        Comma-separated, UTF-8, one line of headings.
    names : tuple of str
        Columns wanted; further ones are ignored. A single one may go by any heading if there is no other.
    angles : collection of str
        Those of them whose rate and acceleration may be there too.
    gaps : bool
        Whether an empty cell, or one that says NaN, is a sample that is missing, as in a record; else it is an error.
    what : str
        Who asks for it: words before the path where it cannot be opened.

    Raises
    ------
    UserError
        Naming the file, the line and what to do.
    """
    rows = _rows(path, what)
    try:
        _, header = next(rows)
    except StopIteration:
        raise UserError(
            f"{path}: is empty. Its first line names the columns: {TIME},{','.join(names)}."
        ) from None
    headings = [cell.strip() for cell in header]
    groups = {
        name: (
            name,
            *(name + which for which in (RATE, ACCELERATION) if name in angles and name + which in headings),
        )
        for name in names
    }
    members = [member for group in groups.values() for member in group]
    further = tuple(member for member in members if member not in names)
    columns = {name: _column(path, headings, name, names, further) for name in (TIME, *members)}
    times: list[float] = []
    values: dict[str, list[float]] = {name: [] for name in members}
    known: dict[str, list[float]] = {name: [] for name in names}
    lines: dict[str, list[int]] = {name: [] for name in names}
    for line, row in rows:
        if len(row) != len(headings):
            raise UserError(
                f"{path}:{line}: has {len(row)} value{'s' if len(row) != 1 else ''} "
                f"where the first line names {len(headings)} columns. Give each row a value for each column."
            )
        now = _number(path, line, TIME, row[columns[TIME]])
        if times and now <= times[-1]:
            raise UserError(
                f"{path}:{line}: {TIME}: {now!r} does not follow {times[-1]!r}. "
                "Sort the rows by time and leave out repetitions."
            )
        times.append(now)
        for name, group in groups.items():
            if gaps and any(row[columns[member]].strip().lower() in _MISSING for member in group):
                continue
            known[name].append(now)
            lines[name].append(line)
            for member in group:
                values[member].append(_number(path, line, member, row[columns[member]]))
    if not times:
        raise UserError(f"{path}: has no rows below its headings. Add at least one.")
    for name in names:
        if not known[name]:
            raise UserError(f"{path}: the column '{name}' is empty. Fill or remove it.")
    found: dict[str, Signal] = {}
    for name in names:
        table = Table(
            np.array(known[name]), np.array(values[name]), source=str(path), lines=tuple(lines[name])
        )
        rates, accelerations = (values.get(name + which) for which in (RATE, ACCELERATION))
        found[name] = table if name not in angles else _motion(name, table, rates, accelerations)
    return found


def _motion(name: str, table: Table, rates: list[float] | None, accelerations: list[float] | None) -> Signal:
    """Return the motion of a prescribed base by as much as the file says of it."""
    if rates is None:
        if accelerations is not None:
            raise UserError(
                f"{table.source}:1: has a column '{name}{ACCELERATION}' and none '{name}{RATE}'. Add the rates, or "
                "remove the accelerations."
            )
        return through(table)
    made = with_rates(table, np.array(rates), None if accelerations is None else np.array(accelerations))
    fit = rates_fit(made, np.array(rates))
    if not 1.0 / _FIT <= fit <= _FIT:
        raise UserError(
            f"{table.source}: the column '{name}{RATE}' is {fit:.3g} times the slope of '{name}'. It must be in rad/s, "
            f"and '{name}' in rad (in m/s and m of a place): correct it, or remove the column."
        )
    return made


def _rows(path: Path, what: str) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows that are not blank, each with its line."""
    try:
        with open_table(path, what) as file:
            reader = csv.reader(file)
            for row in reader:
                if any(cell.strip() for cell in row):
                    yield reader.line_num, row
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not UTF-8 text. Save it as CSV in UTF-8.") from None
    except csv.Error as error:
        raise UserError(f"{path}: {error}. Save it as comma-separated values.") from None


def _column(
    path: Path, headings: list[str], name: str, names: tuple[str, ...], further: tuple[str, ...] = ()
) -> int:
    """Return the place of a column."""
    if headings.count(name) > 1:
        raise UserError(f"{path}:1: two columns are named '{name}'. Remove one.")
    if name in headings:
        return headings.index(name)
    others = [place for place, heading in enumerate(headings) if heading not in (TIME, *further)]
    if name != TIME and len(names) == 1 and TIME in headings and len(others) == 1:
        return others[0]
    there = ", ".join(headings)
    remedy = f"It has {there}. Add the column, with this name in the first line."
    if len(headings) == 1 and any(mark in there for mark in ";\t"):
        remedy = "Separate columns by commas."
    raise UserError(f"{path}:1: has no column '{name}'. {remedy}")


def _number(path: Path, line: int, name: str, cell: str) -> float:
    try:
        number = float(cell)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise UserError(f"{path}:{line}: {name}: '{cell.strip()}' is not a finite number. Correct it.")
    return number
