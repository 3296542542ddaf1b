"""Tables as notebooks show them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape

__all__ = ["html_table"]

_LEFT, _RIGHT = "text-align: left", "text-align: right"


def html_table(
    title: str,
    columns: Mapping[str, str],
    rows: Sequence[Mapping[str, object]],
    notes: Sequence[str] = (),
) -> str:
    """Return a table with a title above and sentences below.

    Parameters
    ----------
    title : str
        Plain text, as all others.
    columns : mapping from str to str
        Headings by key of the rows.
    rows : sequence of mapping
        Values; None is a dash, numbers have five digits.
    notes : sequence of str
        Sentences.
    """
    head = "".join(f'<th style="{_LEFT}">{escape(heading)}</th>' for heading in columns.values())
    body = "".join("<tr>" + "".join(_cell(row.get(key)) for key in columns) + "</tr>" for row in rows)
    below = "".join(f"<div>{escape(note)}</div>" for note in notes)
    return (
        f"<div><strong>{escape(title)}</strong><table><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table>{below}</div>"
    )


def _cell(value: object) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return f'<td style="{_LEFT}">-</td>'
    if isinstance(value, bool):
        return f'<td style="{_LEFT}">{"yes" if value else "no"}</td>'
    if isinstance(value, int | float):
        return f'<td style="{_RIGHT}">{value:.5g}</td>'
    return f'<td style="{_LEFT}">{escape(str(value))}</td>'
