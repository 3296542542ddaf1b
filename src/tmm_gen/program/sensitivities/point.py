"""Variables a linearised step keeps for its tangents."""

from __future__ import annotations

from tmm_gen.program.variables import Ref, Role, Variable


class Point:
    """Collects what is kept in one sweep of one stage.

    Parameters
    ----------
    stations : int
        Number of stations.
    sweeps : int
        How many sweeps a step has in all: names are numbered where there are several.
    sweep : int
        Which of them this is, from 1.
    """

    def __init__(self, stations: int, sweeps: int, sweep: int) -> None:
        self._stations = stations
        self._suffix = f"_{sweep}" if sweeps > 1 else ""
        self._kept: dict[str, Ref] = {}

    def at_station(self, name: str, doc: str, unit: str = "1") -> Ref:
        """Return what keeps a value of every station."""
        return self._keep(name, doc, unit, self._stations)

    def scalar(self, name: str, doc: str, unit: str = "1") -> Ref:
        """Return what keeps a value there is once."""
        return self._keep(name, doc, unit, None)

    def kept(self, name: str) -> Ref | None:
        """Return what keeps a value, if anything does."""
        return self._kept.get(name)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """What is kept."""
        return tuple(ref.variable for ref in self._kept.values())

    def _keep(self, name: str, doc: str, unit: str, length: int | None) -> Ref:
        return self._kept.setdefault(name, Variable(name + self._suffix, Role.POINT, length, doc, unit).at())
