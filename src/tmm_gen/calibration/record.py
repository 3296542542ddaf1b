"""A recorded response, as a file has it."""

from __future__ import annotations

import csv
from collections.abc import Collection
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.inputs.given import input_names, read_tables
from tmm_gen.inputs.signals import Signal
from tmm_gen.reading import open_table
from tmm_gen.scene import Scene
from tmm_gen.scene.columns import output_columns

__all__ = ["known_columns", "missing_inputs", "read_record"]


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
    try:
        with open_table(file) as opened:
            headings = [cell.strip() for cell in next(csv.reader(opened), [])]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{file}: cannot be read: {error}. Save it as CSV in UTF-8.") from None
    names = known_columns(scene, headings, f"{file}:1")
    return read_tables(file, names, input_names(scene)[1], gaps=True)


def known_columns(scene: Scene, headings: Collection[str], where: str) -> tuple[str, ...]:
    """Return the columns that a scene knows, inputs first.

    Raises
    ------
    UserError
        If there is no output among them; `where` says what has none.
    """
    outputs = [column.name for column in output_columns(scene)]
    known = [*(item.name for item in scene.inputs), *outputs]
    found = tuple(name for name in known if name in headings)
    if not set(found) & set(outputs):
        raise UserError(f"{where}: has none of the outputs {', '.join(outputs)}. Name a column after one.")
    return found


def missing_inputs(scene: Scene, record: Collection[str]) -> tuple[str, ...]:
    """Return the inputs that a record does not have."""
    return tuple(item.name for item in scene.inputs if item.name not in record)
