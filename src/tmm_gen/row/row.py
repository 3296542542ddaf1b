"""What a row of elements is: stations that each begin with an element that gives way, a base, and what is read off."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import of_shaft
from tmm_gen.derive.station.law import passes_on
from tmm_gen.derive.station.lets import Coordinate
from tmm_gen.scene.quantity import Read

Elements = tuple[Element, ...]
Boundary = Literal["held", "free", "prescribed"]


@dataclass(frozen=True)
class Parameter:
    """A physical parameter, written in elements by a symbol of its name.

    Parameters
    ----------
    name, doc, unit : str
        For readers of the generated code.
    values : tuple of float
        One for each station, or a single one.
    """

    name: str
    doc: str
    unit: str
    values: tuple[float, ...]

    @property
    def symbol(self) -> sp.Symbol:
        """What stands for it in elements."""
        return sp.Symbol(self.name)


@dataclass(frozen=True)
class Combination:
    """A combination of parameters that a sweep needs at each station, prepared once.

    Parameters
    ----------
    own : sympy.Expr
        What the station's own parameters contribute.
    beyond : sympy.Expr
        What those of the next station contribute.
    last : sympy.Expr
        What stands in its place at the last one.
    at_base : bool
        Whether it is one value at the base: its own, and what the stations that hang there contribute.
    """

    name: str
    doc: str
    unit: str
    own: sp.Expr
    beyond: sp.Expr = sp.S.Zero
    last: sp.Expr = sp.S.Zero
    at_base: bool = False


@dataclass(frozen=True)
class Load:
    """An external force, by the symbol that stands for it in elements.

    Parameters
    ----------
    doc, unit : str
        For readers.
    places : tuple of (int or None, str)
        Index of the station, from 0, and name of the input; None where the element stands outside stations.
    factors : dict from str to float
        What a unit of an input is there, where that is not 1.
    """

    symbol: sp.Symbol
    doc: str
    unit: str
    places: tuple[tuple[int | None, str], ...]
    factors: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Signal:
    """An input by name."""

    name: str
    doc: str
    unit: str


@dataclass(frozen=True)
class Reading:
    """What is read off the motion, and the outputs it goes to.

    Parameters
    ----------
    title : str
        For readers.
    targets : tuple of Signal
        One for each component.
    what : str
        "motion" of the integrated coordinate; "bend", its difference across an element that gives way; the "own" force
        of that element; "place", the motion of a node in the other coordinates; "force" in them beyond an element that
        gives way; or an "energy".
    station : int
        Counted from 1; 0 is the base, and of forces all that stands on it; one more than the last is beyond it.
    kind : str
        "q", "v" or "a" of motions; which energy.
    sign : int
        Of the element's own force.
    inner : int
        Station that a bend is measured against, counted like the other one.
    factor : float
        What the outputs are for a unit of it.
    """

    title: str
    targets: tuple[Signal, ...]
    what: Read
    station: int = 0
    kind: str = ""
    sign: int = 1
    inner: int = 0
    factor: float = 1.0


@dataclass(frozen=True)
class Row:
    """An arm.

    Parameters
    ----------
    name, title : str
        Of the scene.
    coordinates : tuple of Coordinate
        Of every station.
    about : {"prediction", "known"}
        Whether sweeps solve for changes of predicted motion or for motion itself.
    sign : int
        1 where forces are those the inner side exerts on the outer one, -1 otherwise.
    base : tuple of Element
        Inboard of the first station.
    boundary : {"held", "free", "prescribed"}
        What the base does in the integrated coordinate.
    stations : tuple of tuple of Element
        Each begins with the element that gives way.
    tail : tuple of Element
        Beyond the last station.
    detail, detail_tail, detail_base : tuple of tuple of Element, tuple of Element, tuple of Element
        The same with nothing merged: what forces and energies are read off.
    parameters : tuple of Parameter
    combinations : tuple of Combination
    inputs : tuple of Signal
    loads : tuple of Load
    prescribed : tuple of str
        Inputs that move the base: its displacement, rate and acceleration; none where nothing does.
    readings : tuple of Reading
    held : dict from str to Signal
        Inputs as they last acted, kept for readings.
    fall : sympy.Expr
        Acceleration of the base in the last of the coordinates that are not integrated, seen from a falling frame.
    counts_heat : bool
        Whether the energy turned to heat is counted.
    facts : dict from str to str
        For headers.
    angles, rates : tuple of float
        To start from.
    floats : bool
        Whether the base moves freely in the coordinates that are not integrated too.
    hosts : tuple of int
        Index of the station on whose outer end each one hangs, -1 for the base; each branch stands to its end before
        the next. Empty where each station carries the next.
    """

    name: str
    title: str
    coordinates: tuple[Coordinate, ...]
    about: Literal["prediction", "known"]
    sign: int
    base: Elements
    boundary: Boundary
    stations: tuple[Elements, ...]
    tail: Elements
    detail: tuple[Elements, ...]
    detail_tail: Elements
    detail_base: Elements
    parameters: tuple[Parameter, ...]
    combinations: tuple[Combination, ...]
    inputs: tuple[Signal, ...]
    loads: tuple[Load, ...]
    prescribed: tuple[str, ...]
    readings: tuple[Reading, ...]
    held: dict[str, Signal] = field(default_factory=dict)
    fall: sp.Expr = sp.S.Zero
    counts_heat: bool = False
    facts: dict[str, str] = field(default_factory=dict)
    angles: tuple[float, ...] = ()
    rates: tuple[float, ...] = ()
    hosts: tuple[int, ...] = ()
    floats: bool = False

    def host(self, station: int) -> int:
        """Return the index of the station on whose outer end one hangs, -1 for the base."""
        return self.hosts[station] if self.hosts else station - 1

    def carried(self, station: int) -> tuple[int, ...]:
        """Return the stations that hang on one's outer end; -1 is the base."""
        if not self.hosts:
            return (station + 1,) if station + 1 < len(self.stations) else ()
        return tuple(index for index, host in enumerate(self.hosts) if host == station)

    @cached_property
    def shafts(self) -> frozenset[int]:
        """Indices of the stations of one element with one station on them: nothing between the two has inertia."""
        if self.about == "known":
            return frozenset()
        return frozenset(
            k
            for k, elements in enumerate(self.stations[:-1])
            if len(elements) == 1 < len(self.stations[k + 1])
            and self.carried(k) == (k + 1,)
            and passes_on(elements[0])
            and passes_on(self.stations[k + 1][0])
        )

    @cached_property
    def reads_inner_acceleration(self) -> bool:
        """Whether a station's law reads the acceleration at its inner side, which may be the base's."""
        (own,) = [i for i, c in enumerate(self.coordinates) if c.integrated]
        return any(
            equation.has(elements[0].inboard.motions[own].a)
            for _, _, elements in self.runs()
            for equation in elements[0].equations
        )

    def swept(self) -> tuple[Elements, ...]:
        """Return the stations as sweeps cross them: what turns a shaft stands in the station that the shaft turns."""
        found = list(self.stations)
        for k in self.shafts:
            (element,) = self.stations[k]
            symbols = (*element.parameters, *element.inputs)
            found[k] = ()
            found[k + 1] = (element.with_values({s: of_shaft(s) for s in symbols}), *self.stations[k + 1])
        return tuple(found)

    def beyond(self, station: int) -> int:
        """Return where what a station carries ends: the index behind the last one."""
        behind = (k for k in range(station + 1, len(self.stations)) if self.host(k) < station)
        return next(behind, len(self.stations))

    def runs(self, stations: tuple[Elements, ...] | None = None) -> tuple[tuple[int, int, Elements], ...]:
        """Return runs of stations of the same elements: from where to where, and which.

        The first station of a branch is a run of its own; where others hang on a station, a run ends.
        """
        rooted = {k for k, host in enumerate(self.hosts) if host != k - 1}
        begins = rooted | {k + 1 for k in rooted} | {self.hosts[k] + 1 for k in rooted}
        found: list[tuple[int, int, Elements]] = []
        for index, elements in enumerate(self.stations if stations is None else stations):
            if found and found[-1][2] == elements and index not in begins:
                found[-1] = (found[-1][0], index + 1, elements)
            else:
                found.append((index, index + 1, elements))
        return tuple(found)
