"""Walks of a step whose stages are solved at once: what its equations leave over, and what mends that."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import RESIDUAL, force, lacking, of_shaft
from tmm_gen.derive.station.lets import Coordinate, Let, composed
from tmm_gen.derive.station.residual import residual
from tmm_gen.derive.station.shaft import GAP, OWN, PASSED
from tmm_gen.program.arm.at_places import BASE
from tmm_gen.program.arm.binding import Binding
from tmm_gen.program.arm.branches import Gathered
from tmm_gen.program.arm.correction import Correction
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.statements import Assign, Order, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, local

ZERO = sp.Integer(0)
AGAIN = "mended again: "
"""How titles begin where a sweep's factors serve once more."""


def left_at_base(coordinate: Coordinate) -> Ref:
    """Return what the equations leave over at a base that moves freely."""
    if coordinate.integrated:
        return local("residual_of_hub", "torque that the equations leave over at the hub", "N m")
    doc = f"force that the equations leave over at the base along {coordinate.name}"
    return local(f"residual_of_base_{coordinate.name}", doc, coordinate.force_unit)


def left_over(stations: int) -> Variable:
    """Return the scratch array of what the equations leave over at each joint."""
    doc = "torque that the equations leave over at each joint"
    return Variable("residual", Role.WORK, stations, doc, "N m")


def over_on_shaft(stations: int) -> Variable:
    """Return the scratch array of what is over of the torques on a shaft, at the station that it turns."""
    return Variable("torque_gap", Role.WORK, stations, "what is over of the torques on a shaft", "N m")


class ResidualWalks(Walks):
    """Walks out with motion and in with exact forces, at the motion of a stage.

    Parameters
    ----------
    again : bool
        Whether a sweep before has brought the torques on both sides of each shaft together: their laws are linear.
    """

    def __init__(self, *places: Any, again: bool = False) -> None:
        super().__init__(*places)
        self._again = again

    def plain(self) -> list[Section]:
        """Return both walks, and what they leave over."""
        return [
            Section("accelerations of the nodes at the stages", tuple(self.outward_motion())),
            Section("torques of the joints at the stages", tuple(self.joint_forces())),
            Section("walk inward: what the equations of the stages leave over", tuple(self.inward_forces())),
        ]

    def joint_forces(self) -> list[Statement]:
        """Return the own torques of joints."""
        here = self.at_station()
        found: list[Statement] = [s for symbol in self._of_joints for s in self.loads.filled({symbol})]
        for start, stop, elements in self.runs:
            known = self._known(elements)
            if known:
                found.append(self.over(Order.OUTWARD, start, stop, here.lines(known)))
        return found

    def _known(self, elements: tuple[Element, ...]) -> tuple[Let, ...]:
        found = residual(elements, self.frame)
        return found.known if self._again else (*found.known, *found.on_shaft)

    def at_station(self) -> Binding:
        """Return what symbols stand for at station j of a loop."""
        return _left(super().at_station(), self)

    @property
    def _of_joints(self) -> list[sp.Symbol]:
        """Loads that stand in the laws of joints."""
        known = [let for _, _, elements in self.runs for let in self._known(elements)]
        used = {s for let in known for s in let.value.free_symbols}
        return [s for s in self.loads.values if s in used or of_shaft(s) in used]

    def inward_forces(self) -> list[Statement]:
        """Walk in with the exact forces beyond each place."""
        row, gathered, here = self.layout.row, Gathered(self.layout.row), self.at_station()
        forces = [force(c) for c in self.frame.coordinates]
        carried = [self.scratch.ref(s.name) for s in forces]
        found: list[Statement] = self.loads.filled_besides(self._of_joints)
        for start, stop, elements in reversed(self.runs):
            begin = gathered.joined(stop - 1, carried)
            if not row.carried(stop - 1):
                at_tip = self._at_tip(forces) if stop == len(row.stations) else [ZERO] * len(forces)
                begin = dict(zip(carried, at_tip, strict=True))
            found += [Assign(ref, value) for ref, value in begin.items()]
            lines = residual(elements, self.frame).lines
            found.append(self.over(Order.INWARD, start, stop, here.lines(lines)))
            found += gathered.leave(start, carried)
        if row.boundary == "free":
            at_base = gathered.joined(BASE - 1, carried)
            found += [Assign(ref, value) for ref, value in at_base.items()]
            lines = residual(row.base, self.frame, moved=True).lines
            found += self.at_node(BASE).lines(lines)
            found += [
                Assign(left_at_base(c), -self.frame.sign * self.scratch.ref(force(c).name))
                for c in self.frame.coordinates
                if c.integrated or row.floats
            ]
        return found

    def _at_tip(self, forces: list[sp.Symbol]) -> list[sp.Expr]:
        left = composed(residual(self.layout.row.tail, self.frame, moved=True).lines)
        at_tip = self.at_node(self.layout.stations)
        nothing = dict.fromkeys(forces, ZERO)
        return [at_tip.value(left.get(s, ZERO).subs(nothing)) for s in forces]


class _OfResiduals(Walks):
    """Walks whose joints and hub have what the equations leave over in place of their own torques."""

    def at_station(self) -> Binding:
        """Return what symbols stand for at station j of a loop."""
        return _left(super().at_station(), self)

    def at_node(self, index: int) -> Binding:
        """Return what symbols stand for at a node, counted from the base."""
        here = super().at_node(index)
        of_base = {lacking(c): left_at_base(c) for c in self.frame.coordinates}
        return Binding(self.scratch, {**here.values, **of_base})


class MendingWalks(_OfResiduals):
    """The sweep that finds what changes of accelerations make up for what the equations leave over."""


class MendingAgain(_OfResiduals, Correction):
    """The same behind a sweep, with its pivots, slopes and answers: forces in, unknowns out."""

    def plain(self) -> list[Section]:
        """Return both walks and the base between them, under titles of their own."""
        return [replace(s, title=AGAIN + s.title) for s in super().plain()]

    def outward_motion(self) -> list[Statement]:
        """Return nothing: the walks over the stages have been there."""
        return []

    def joint_forces(self) -> list[Statement]:
        """Return nothing: on no shaft is anything over."""
        return []

    def at_station(self) -> Binding:
        """Return what symbols stand for at station j of a loop."""
        here = super().at_station()
        return Binding(self.scratch, {**here.values, PASSED: ZERO, OWN: ZERO})


def _left(here: Binding, walks: Walks) -> Binding:
    """Bind what the equations leave over at a station, beside what else stands there."""
    n = walks.layout.stations
    own = {RESIDUAL: left_over(n).at(), GAP: over_on_shaft(n).at()}
    return Binding(walks.scratch, {**here.values, **own})
