"""A recorded response, as a file has it."""

from __future__ import annotations

import csv
from collections.abc import Collection
from difflib import get_close_matches
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.inputs.given import TIME, input_names, read_tables
from tmm_gen.inputs.signals import Signal
from tmm_gen.reading import open_table
from tmm_gen.scene import Scene
from tmm_gen.scene.columns import output_columns

__all__ = ["headings_of", "known_columns", "missing_inputs", "read_record", "unread"]


def read_record(scene: Scene, file: Path) -> dict[str, Signal]:
    """Return the columns of a record that a scene knows, on the record's own clock.

    Parameters
    ----------
    scene : Scene
        Gives the names of inputs and outputs.
    file : Path
        CSV with a ``time`` column; an empty cell is a sample that is missing.

    Raises
    ------
    UserError
        If the file cannot be read, or has none of the outputs.
    """
    names = known_columns(scene, headings_of(file), f"{file}:1")
    return read_tables(file, names, input_names(scene)[1], gaps=True)


def headings_of(file: Path) -> list[str]:
    """Return the names of a record's columns.

    Raises
    ------
    UserError
        If the file cannot be read.
    """
    try:
        with open_table(file) as opened:
            return [cell.strip() for cell in next(csv.reader(opened), [])]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{file}: cannot be read: {error}. Save it as CSV in UTF-8.") from None


def known_columns(scene: Scene, headings: Collection[str], where: str) -> tuple[str, ...]:
    """Return the columns that a scene knows, inputs first.

    Raises
    ------
    UserError
        If there is no output among them; `where` says what has none.
    """
    outputs = [column.name for column in output_columns(scene)]
    found = tuple(name for name in _names(scene) if name in headings)
    if not set(found) & set(outputs):
        raise UserError(f"{where}: has none of the outputs {', '.join(outputs)}. Name a column after one.")
    return found


def unread(scene: Scene, headings: Collection[str]) -> tuple[str, ...]:
    """Say of each column that the scene does not know that it was not read.

    A record may have more than a model does. But of an output misspelt nothing else would be seen: the others alone
    would be fitted.
    """
    absent = [name for name in _names(scene) if name not in headings]
    said = []
    for name in headings:
        if name and name != TIME and name not in _names(scene):
            near = get_close_matches(name, absent, n=1)
            meant = f": did you mean '{near[0]}'?" if near else ""
            said.append(
                f"column '{name}' is neither an input nor an output of the scene and was not read{meant}"
            )
    return tuple(said)


def _names(scene: Scene) -> list[str]:
    """Return all columns that a scene knows, inputs first."""
    return [*(item.name for item in scene.inputs), *(column.name for column in output_columns(scene))]


def missing_inputs(scene: Scene, record: Collection[str]) -> tuple[str, ...]:
    """Return the inputs that a record does not have."""
    return tuple(item.name for item in scene.inputs if item.name not in record)
