"""``[control]`` has an open vocabulary, but what is in it must be usable."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.table import is_finite_number

TIME_GRID = (("control", "horizon"), ("control", "sample_time"))
"""Keys with a rule, and so a remedy, of their own."""


def control_values(document: Document) -> Iterator[Finding]:
    """Find values a controller cannot use, and a time grid that makes no sense."""
    control = document.control
    if control is None:
        return
    yield from _unusable(("control",), control)
    horizon = control.get("horizon", 1)
    if not isinstance(horizon, int) or isinstance(horizon, bool) or horizon < 1:
        yield Finding(
            ("control", "horizon"),
            "must be a whole number of samples from 1",
            "Write for example `horizon = 30`.",
            horizon,
        )
    sample = control.get("sample_time", 1.0)
    if not is_finite_number(sample) or sample <= 0:
        yield Finding(
            ("control", "sample_time"),
            "must be greater than 0",
            "Write for example `sample_time = 0.02` (s).",
            sample,
        )


def _unusable(path: Path, value: object) -> Iterator[Finding]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _unusable((*path, key), item)
    elif isinstance(value, list | tuple):
        for index, item in enumerate(value):
            yield from _unusable((*path, index), item)
    elif path not in TIME_GRID and not isinstance(value, str | bool) and not is_finite_number(value):
        yield Finding(path, "must be a finite number, text or boolean", "Write a plain TOML value.", value)
