"""Keys of a TOML table, with errors that name file, line, key, value and a remedy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from tmm_gen.scene.locate import nearest_line
from tmm_gen.scene.problem import Path, show_path
from tmm_gen.scene.table import closest, is_finite_number
from tmm_gen.urdf.faults import Faults


@dataclass(frozen=True)
class Keys:
    """A table that is read key by key.

    Parameters
    ----------
    faults : Faults
        Takes what is wrong.
    lines : dict of path to int
        As `tmm_gen.scene.locate.locate` returns them.
    path : tuple of str and int
        Of the table.
    values : mapping
        The table.
    """

    faults: Faults
    lines: dict[Path, int]
    path: Path
    values: Mapping[str, Any]

    @property
    def line(self) -> int:
        """Line of the table."""
        return nearest_line(self.lines, self.path)

    def fault(self, key: str, message: str, remedy: str) -> None:
        """Note what is wrong with a key, or with the table where the key is empty."""
        path = (*self.path, key) if key else self.path
        value = self.values.get(key) if key else None
        self.faults.add(nearest_line(self.lines, path), show_path(path), message, remedy, value)

    def only(self, known: Sequence[str]) -> None:
        """Refuse keys that are not known."""
        for key in self.values:
            if key not in known:
                self.fault(key, "is no key of it", closest(key, known))

    def table(self, key: str) -> Keys | None:
        """Return a table in it, None where it is absent or none."""
        value = self.values.get(key)
        if value is None:
            return None
        if not isinstance(value, dict):
            self.fault(key, "must be a table", f"Write [{show_path((*self.path, key))}] and its keys below.")
            return None
        return Keys(self.faults, self.lines, (*self.path, key), value)

    def tables(self, key: str, known: Iterable[str], what: str) -> dict[str, Keys]:
        """Return the tables in a table by name; names that are not known are a fault."""
        outer, names = self.table(key), list(known)
        found: dict[str, Keys] = {}
        for name in outer.values if outer else ():
            assert outer is not None
            if name not in names:
                outer.fault(name, f"is no {what} of the URDF", closest(name, names))
            elif (inner := outer.table(name)) is not None:
                found[name] = inner
        return found

    def number(self, key: str, *, least: float = -math.inf, above: float = -math.inf) -> float | None:
        """Return a finite number, None where the key is absent or at fault."""
        value = self.values.get(key)
        if value is None:
            return None
        if not is_finite_number(value):
            self.fault(key, "must be a finite number", f"Write for example `{key} = 0.5`.")
        elif value <= above:
            self.fault(key, f"must be greater than {above:g}", "Correct it, or leave it out.")
        elif value < least:
            self.fault(key, f"must not be less than {least:g}", "Correct it, or leave it out.")
        else:
            return float(value)
        return None

    def text(self, key: str) -> str | None:
        """Return a text, None where the key is absent or at fault."""
        value = self.values.get(key)
        if value is not None and not isinstance(value, str):
            self.fault(key, "must be text", f'Write it in quotes, for example `{key} = "elbow"`.')
            return None
        return value

    def numbers(self, key: str, count: int) -> tuple[float, ...] | None:
        """Return a list of finite numbers, None where the key is absent or at fault."""
        value = self.values.get(key)
        if value is None:
            return None
        if not isinstance(value, list) or len(value) != count or not all(map(is_finite_number, value)):
            example = ", ".join(["0.1"] * count)
            self.fault(key, f"must be a list of {count} finite numbers", f"Write `{key} = [{example}]`.")
            return None
        return tuple(map(float, value))
