"""What commands show: tables for people, JSON for machines, progress for those who wait."""

from __future__ import annotations

import json
import math
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from enum import Enum
from pathlib import PurePath
from typing import Any, Literal, Protocol

import click

__all__ = ["Advance", "Column", "plain", "print_json", "progress", "say_written", "table"]

# rich is imported inside functions: it costs more than all of `tmm-gen --help`.

_QUIET = 15.0
"""Seconds of work after which those who see no bar are told that it goes on."""
_WIDE = 10_000  # columns; a table that goes to a file or a pipe is not to be folded


@dataclass(frozen=True)
class Column:
    """A column of a printed table.

    Attributes
    ----------
    key
        Key of the row, snake_case.
    heading
        What is printed above; by default the key with spaces.
    form
        A format specification (``".3g"``) for numbers, or a function from the value to text.
    justify
        Side; numbers are right-justified when this is None.
    """

    key: str
    heading: str | None = None
    form: str | Callable[[Any], str] = ""
    justify: Literal["left", "center", "right"] | None = None

    def text(self, value: object) -> str:
        """Return a cell's text: a dash for what is absent, yes or no for a truth value."""
        value = plain(value, finite=False)
        if callable(self.form):
            return self.form(value)
        if value is None:
            return "-"
        if isinstance(value, bool):
            return "yes" if value else "no"
        if isinstance(value, int | float):
            return format(value, self.form)
        return str(value)


def plain(value: object, *, finite: bool = True) -> Any:
    """Return a value made of what JSON knows.

    NumPy scalars and arrays become numbers and lists, paths text, enumerations their values,
    and, if `finite`, numbers that are not finite None.

    Raises
    ------
    TypeError
        If JSON has nothing like it.
    """
    if isinstance(value, Enum):
        return plain(value.value, finite=finite)
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        return float(value) if math.isfinite(value) or not finite else None
    if isinstance(value, Mapping):
        return {_key(key): plain(item, finite=finite) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item, finite=finite) for item in value]
    if isinstance(value, PurePath):
        return str(value)
    if hasattr(value, "tolist"):  # NumPy, without importing it
        return plain(value.tolist(), finite=finite)
    raise TypeError(f"no JSON for {type(value).__name__}: {value!r}")


def _key(key: object) -> str:
    if not (isinstance(key, str) and key.isidentifier() and key == key.lower()):
        raise TypeError(f"a JSON key is to be snake_case, not {key!r}")
    return key


def print_json(values: Mapping[str, object]) -> None:
    """Print one JSON object: keys in snake_case, null for numbers that are not finite.

    Raises
    ------
    TypeError
        If a key is not in snake_case or a value has no JSON.
    """
    click.echo(json.dumps(plain(values), indent=2, allow_nan=False, ensure_ascii=False))


def table(
    rows: Sequence[Mapping[str, object]],
    columns: Sequence[Column | str],
    json_mode: bool = False,
    *,
    title: str | None = None,
    more: Mapping[str, object] | None = None,
) -> None:
    """Print rows as a table, or as one JSON object ``{..., "rows": [...]}``.

    Parameters
    ----------
    rows
        Values by key. JSON shows all of a row, the table only its `columns`.
    columns
        What the table shows, in order; a plain string is the key of a `Column` of no format.
    json_mode
        Whether JSON is asked for.
    title
        Line above the table; not in the JSON.
    more
        Further keys of the JSON object, beside ``rows``; not in the table.

    Raises
    ------
    TypeError
        If a key is not in snake_case or a value has no JSON.
    """
    if json_mode:
        print_json({**(more or {}), "rows": list(rows)})
        return

    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    shown = [column if isinstance(column, Column) else Column(column) for column in columns]
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else _WIDE
    # as wide as its title, which would be broken otherwise
    grid = Table(title=title, title_justify="left", min_width=min(len(title or ""), width))
    for column in shown:
        grid.add_column(
            Text(column.heading or column.key.replace("_", " ")),
            justify=column.justify or _side(rows, column.key),
            overflow="fold",
        )
    for row in rows:
        # Text: square brackets are to stay themselves.
        grid.add_row(*(Text(column.text(row.get(column.key))) for column in shown))
    console = Console(width=None if sys.stdout.isatty() else _WIDE)
    if rows and console.measure(grid, options=console.options.update(width=_WIDE)).maximum > width:
        _print_records(rows, shown, title)
    else:
        console.print(grid)


def _print_records(
    rows: Sequence[Mapping[str, object]], columns: Sequence[Column], title: str | None
) -> None:
    """Print a row below the other, a line for each column: cells of a few letters' width could not be read."""
    headings = [column.heading or column.key.replace("_", " ") for column in columns]
    reach = max(len(heading) for heading in headings)
    if title:
        click.echo(title)
    for row in rows:
        click.echo()
        for heading, column in zip(headings, columns, strict=True):
            click.echo(f"{heading:<{reach}}  {column.text(row.get(column.key))}")
    click.echo()


def _side(rows: Sequence[Mapping[str, object]], key: str) -> Literal["left", "right"]:
    """Numbers go to the right, so that their digits stand below each other."""
    values = [plain(row.get(key), finite=False) for row in rows]
    present = [value for value in values if value is not None]
    numeric = all(isinstance(value, int | float) and not isinstance(value, bool) for value in present)
    return "right" if present and numeric else "left"


def say_written(files: Sequence[PurePath], more: str = "") -> None:
    """Name the files that a command has written; say what else it does where it wrote none.

    Parameters
    ----------
    files
        What was written.
    more
        What to read after "more: "; nothing is said where it is empty.
    """
    for path in files:
        click.echo(f"wrote {path}")
    if more and not files:
        click.echo(f"more: {more}")


class Advance(Protocol):
    """Say that a piece of work is done, and optionally what is being done now."""

    def __call__(self, count: float = 1, doing: str | None = None) -> None:
        """Count `count` units of work as done."""


@contextmanager
def _in_lines(title: str, total: float | None) -> Iterator[Advance]:
    """Say on standard error how long work goes on, in lines that become rarer the longer it does."""
    over, begun = threading.Event(), time.monotonic()
    done, now, stream = 0.0, "", sys.stderr

    def advance(count: float = 1, doing: str | None = None) -> None:
        nonlocal done, now
        done, now = done + count, doing or now

    def tell() -> None:
        wait = _QUIET
        while not over.wait(wait):
            wait = time.monotonic() - begun
            share = f" ({min(100.0 * done / total, 99.0):.0f} %)" if total and done else ""
            what = f": {now}" if now and now != title else ""
            with suppress(OSError, ValueError):  # a stream that was closed meanwhile
                print(f"{title}{what}{share}, {wait:.0f} s so far", file=stream, flush=True)

    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield advance
    finally:
        over.set()
        teller.join()


@contextmanager
def progress(doing: str, total: float | None = None, *, after: float = 1.0) -> Iterator[Advance]:
    """Show a progress bar on standard error while the block runs.

    Nothing is shown of work shorter than `after`. Where standard error is no terminal a line says what is being done,
    once the work has taken `_QUIET` seconds, and again each time it has taken twice as long.

    Parameters
    ----------
    doing
        What is being done, in a few words.
    total
        Units of work; None where it is not known.
    after
        Seconds of work before the bar appears.

    Yields
    ------
    Advance
        To be called as work is done.
    """
    if not sys.stderr.isatty():
        with _in_lines(doing, total) as tell:
            yield tell
        return

    from rich.console import Console
    from rich.progress import Progress

    bar = Progress(console=Console(stderr=True), transient=True)
    task = bar.add_task(doing, total=total)

    def advance(count: float = 1, doing: str | None = None) -> None:
        bar.update(task, advance=count, description=doing)

    # A timer, not a look at the clock in `advance`: one long piece of work is to be shown too.
    appear = threading.Timer(after, bar.start)
    appear.daemon = True
    appear.start()
    try:
        yield advance
    finally:
        appear.cancel()
        appear.join()  # so that it cannot start the bar after the stop below
        if bar.live.is_started:
            bar.stop()
