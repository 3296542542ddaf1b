"""Reading and writing values where they are kept."""

from __future__ import annotations

from dataclasses import dataclass, replace

from tmm_gen.program.passes.rewrite import map_references
from tmm_gen.program.statements import Section
from tmm_gen.program.variables import Ref, Role, Variable


def kept_as(section: Section, names: dict[Ref, Ref]) -> Section:
    """Return a section that reads and writes values where they are kept, by where they were."""
    places = _Places.of(names)

    def moved(ref: Ref) -> Ref:
        kept = places.of_ref(ref)
        return ref if kept is None else kept

    return map_references(section, moved)


@dataclass(frozen=True)
class _Places:
    """Where values are kept: arrays that turned out alike at every station became scalars.

    Parameters
    ----------
    names : dict from Ref to Ref
        By what they were.
    arrays : dict from Variable to Variable
        The same array, looked at from other stations: found at once, since there are as many names as values.
    """

    names: dict[Ref, Ref]
    arrays: dict[Variable, Variable]

    @classmethod
    def of(cls, names: dict[Ref, Ref]) -> _Places:
        """Sort names."""
        arrays: dict[Variable, Variable] = {}
        for other, kept in names.items():
            if other.variable.length is not None and kept.variable.length is not None:
                arrays.setdefault(other.variable, kept.variable)
        return cls(names, arrays)

    def of_ref(self, ref: Ref) -> Ref | None:
        """Return where a value is kept; None if it is not."""
        if ref in self.names:
            return self.names[ref]
        kept = self.arrays.get(ref.variable)
        if kept is not None:
            return kept.at(ref.offset) if ref.offset is not None else kept.entry(ref.entry or 0)
        if ref.variable.role is not Role.WORK:
            return None
        return self.names.get(replace(ref.variable, role=Role.LOCAL, length=None).ref)
