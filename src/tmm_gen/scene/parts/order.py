"""In which order parts hang on each other, from the base outward, branch by branch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from tmm_gen.scene.parts.tables import BodyPart, JointPart, MotorPart, Part

Tables = Mapping[str, tuple[Part, ...]]
"""Parts by the name of their table, in the order of the file."""

BASE = "base"


@dataclass(frozen=True)
class Entry:
    """A part, and where the file has it.

    Parameters
    ----------
    table : str
        Name of its table.
    index : int
        Among those of that table, from 0.
    part : Part
        What it says.
    """

    table: str
    index: int
    part: Part

    @property
    def name(self) -> str:
        """Its name."""
        return self.part.name

    @property
    def path(self) -> tuple[str | int, ...]:
        """Where it stands in the file."""
        return (self.table, self.index)

    @property
    def turns(self) -> bool:
        """Whether it is a motor or a joint."""
        return isinstance(self.part, MotorPart | JointPart)

    @property
    def words(self) -> str:
        """How to call it in a sentence."""
        return f"[[{self.table}]] '{self.name}'"


@dataclass(frozen=True)
class Hanging:
    """What hangs on what.

    Parameters
    ----------
    entries : tuple of Entry
        All parts, in the order of the file; of the same name only the first.
    """

    entries: tuple[Entry, ...]

    @cached_property
    def by_name(self) -> dict[str, Entry]:
        """All parts by name."""
        return {entry.name: entry for entry in self.entries}

    def host(self, entry: Entry) -> str:
        """Return the name of the motor, joint, beam or link that a part hangs on, or "base"; bodies are looked through.

        A body without `on` sits on the only beam or link.
        """
        on, seen = self.on(entry), {entry.name}
        while (
            (host := self.by_name.get(on)) is not None and isinstance(host.part, BodyPart) and on not in seen
        ):
            seen.add(on)
            on = self.on(host)
        return on

    def on(self, entry: Entry) -> str:
        """Return what a part hangs on as the file says, or means where it leaves that out."""
        if entry.part.on is not None:
            return entry.part.on
        solid = [e.name for e in self.entries if e.table in ("beam", "link")]
        return solid[0] if isinstance(entry.part, BodyPart) and len(solid) == 1 else BASE

    def carried(self, name: str) -> tuple[Entry, ...]:
        """Return the motors, joints, beams and links that hang on a part or on the base."""
        return tuple(e for e in self.entries if not isinstance(e.part, BodyPart) and self.host(e) == name)

    def bodies(self, name: str) -> tuple[Entry, ...]:
        """Return the bodies on a part's outer end."""
        return tuple(e for e in self.entries if isinstance(e.part, BodyPart) and self.host(e) == name)

    def outward(self) -> tuple[Entry, ...]:
        """Return motors, joints, beams and links from the base outward, each branch to its end before the next."""
        found: dict[str, Entry] = {}
        waiting = list(reversed(self.carried(BASE)))
        while waiting:
            entry = waiting.pop()
            if entry.name not in found:  # what closes a loop is told by a rule
                found[entry.name] = entry
                waiting += reversed(self.carried(entry.name))
        return tuple(found.values())


def hanging(tables: Tables) -> Hanging:
    """Return what hangs on what."""
    found: dict[str, Entry] = {}
    for entry in entries(tables):
        found.setdefault(entry.name, entry)
    return Hanging(tuple(found.values()))


def entries(tables: Tables) -> Iterator[Entry]:
    """Yield all parts, table by table."""
    for table, parts in tables.items():
        for index, part in enumerate(parts):
            yield Entry(table, index, part)
