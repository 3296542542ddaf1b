"""What hangs on what in space, from the base outward, each branch to its end before the next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from tmm_gen.scene.parts.order import BASE, Entry
from tmm_gen.scene.spatial.tables import SpatialBeam, SpatialPart, TurningPart


@dataclass(frozen=True)
class Hung(Entry):
    """A part in space, and where the file has it."""

    part: SpatialPart

    @property
    def on(self) -> str:
        """What it hangs on: a part's name, or the base."""
        return self.part.on if self.part.on is not None else BASE

    @property
    def turns(self) -> bool:
        """Whether it is a motor or a joint."""
        return isinstance(self.part, TurningPart)

    @property
    def moves(self) -> bool:
        """Whether what hangs on it moves against what it hangs on."""
        return isinstance(self.part, TurningPart | SpatialBeam)


@dataclass(frozen=True)
class Tree:
    """Parts that hang on each other.

    Parameters
    ----------
    every : tuple of Hung
        All parts, table by table.
    """

    every: tuple[Hung, ...]

    @cached_property
    def by_name(self) -> dict[str, Hung]:
        """Parts by name; of the same name only the first."""
        found: dict[str, Hung] = {}
        for hung in self.every:
            found.setdefault(hung.name, hung)
        return found

    @cached_property
    def on(self) -> dict[str, tuple[Hung, ...]]:
        """Parts by what they hang on."""
        found: dict[str, list[Hung]] = {}
        for hung in self.by_name.values():
            found.setdefault(hung.on, []).append(hung)
        return {name: tuple(hung) for name, hung in found.items()}

    def outward(self) -> tuple[Hung, ...]:
        """Return the parts that the base carries, each after what it hangs on; a branch is whole before the next."""
        found: list[Hung] = []
        waiting = list(reversed(self.on.get(BASE, ())))
        while waiting:
            hung = waiting.pop()
            found.append(hung)
            waiting += reversed(self.on.get(hung.name, ()))
        return tuple(found)

    def inward(self, hung: Hung) -> tuple[str, ...]:
        """Return the names from a part inward, to the base or until one comes twice."""
        found = [hung.name]
        while (on := self.by_name[found[-1]].on) in self.by_name and on not in found:
            found.append(on)
        return (*found, on)

    def mover(self, hung: Hung) -> Hung | None:
        """Return the nearest part inward, or the part itself, that lets it move; None where it is fixed to the base."""
        while not hung.moves:
            if hung.on not in self.by_name:
                return None
            hung = self.by_name[hung.on]
        return hung


def tree_of(tables: Mapping[str, tuple[SpatialPart, ...]]) -> Tree:
    """Return what hangs on what."""
    return Tree(
        tuple(Hung(table, k, part) for table, parts in tables.items() for k, part in enumerate(parts))
    )
