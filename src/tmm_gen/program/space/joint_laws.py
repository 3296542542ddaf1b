"""The joints' own laws in space: what springs, dampers, rotors and motors ask for, and how it answers to motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind
from tmm_gen.derive.space.inward import IMPEDANCE, TORQUE
from tmm_gen.program.space.gears import ElasticGear
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Variable
from tmm_gen.scene.spatial.arm import ArmInput

_OF: dict[Kind, str] = {"q": "stiffness", "v": "damping", "a": "armature"}
"""What takes a torque against each kind of motion."""


@dataclass(frozen=True)
class JointLaws:
    """Writes the laws of all joints at a stage.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    gains : mapping from "q", "v", "a" to sympy.Expr
        Motion per unknown.
    """

    layout: SpaceLayout
    gains: Mapping[Kind, sp.Expr]

    @property
    def absent(self) -> frozenset[sp.Symbol]:
        """What of them is zero everywhere."""
        impedance = {IMPEDANCE} if self._impedance(None) == 0 else set()
        lawless = not set(_OF.values()) & self.layout.parameters.keys()
        return frozenset(impedance | ({TORQUE} if lawless and not self._driven else set()))

    def impedances(self, target: Variable) -> Section:
        """Return what sets the torque per unknown at each joint; where there is a shaft, of both together."""
        if self._impedance(None) == 0:
            return Section("impedances of the joints", ())
        found: list[Statement] = [
            Loop(Order.OUTWARD, start, stop, (Assign(target.at(), self._impedance(None)),))
            for start, stop in self._stretches
        ]
        for k, gear in self._gears().items():
            found += gear.ahead
            found.append(Loop(Order.OUTWARD, k + 1, k + 2, (Assign(target.at(), gear.impedance),)))
        return Section("impedances of the joints", tuple(found))

    def torques(
        self, target: Variable, moved: Mapping[Kind, Variable], value: Callable[[str], sp.Expr]
    ) -> Section:
        """Return what sets the torque that each joint asks for; where there is a shaft, of both together.

        Parameters
        ----------
        target : Variable
            Array over the joints.
        moved : mapping from "q", "v", "a" to Variable
            Motion of the joints; what is left out is zero.
        value : callable
            Returns a motor's torque by its column.
        """
        statements = self._plain(target, moved, value)
        for k, gear in self._gears(moved, value).items():
            statements += gear.known(target.entry(k + 1))
        return Section("torques of the joints' own", tuple(statements))

    def lacking(
        self,
        target: Variable,
        moved: Mapping[Kind, Variable],
        value: Callable[[str], sp.Expr],
        over: Variable | None,
    ) -> Section:
        """Return what sets the torque that each joint asks for, where shafts are eliminated later.

        Parameters
        ----------
        target, moved, value
            As of :meth:`torques`.
        over : Variable or None
            Array over the joints: receives what is over of the torques on each shaft; None where nothing can be.
        """
        statements = self._plain(target, moved, value)
        for k, gear in self._gears(moved, value).items():
            joint = target.entry(k + 1)
            if over is not None:
                statements += gear.lacking(over.entry(k), joint)
            else:
                statements.append(
                    Assign(joint, self._torque(moved, k + 1) - self._acting(value).get(k + 1, 0))
                )
        return Section("torques of the joints' own", tuple(statements))

    def shared(self, target: Variable) -> Section:
        """Return what both lack together, in place of the joints behind shafts, by what each of both does.

        Parameters
        ----------
        target : Variable
            Array over the joints.
        """
        statements: list[Statement] = []
        for k, gear in self._gears().items():
            statements += gear.shared(target.entry(k), target.entry(k + 1))
        return Section("torques that shafts pass on", tuple(statements))

    def moved_torques(self, target: Variable, impedance: Variable, found: Variable) -> Section:
        """Return what changes these torques by what the sweep before has found joints to do: laws are linear.

        Parameters
        ----------
        target, impedance, found : Variable
            Arrays over the joints: torques, torques per unknown, unknowns.
        """
        if self._impedance(None) == 0:
            return Section("torques of the joints' own", ())
        changed = Assign(target.at(), target.at() + impedance.at() * found.at())
        statements: list[Statement] = [
            Loop(Order.OUTWARD, start, stop, (changed,)) for start, stop in self._stretches
        ]
        for k in sorted(self.layout.tree.shafts):
            both = impedance.at() * (found.at(-1) + found.at())
            statements.append(Loop(Order.OUTWARD, k + 1, k + 2, (Assign(target.at(), target.at() + both),)))
        return Section("torques of the joints' own", tuple(statements))

    def answers(self, found: Variable, *, again: bool) -> Section:
        """Return what sets what shafts and the joints behind them do, by what the sweep found both to do.

        Parameters
        ----------
        found : Variable
            Array over the joints.
        again : bool
            Whether a sweep before has brought the torques on both sides of each shaft together.
        """
        statements: list[Statement] = []
        for k, gear in self._gears().items():
            statements += gear.answer(found.entry(k), found.entry(k + 1), again=again)
        return Section("what shafts do, and their gears", tuple(statements))

    def _plain(
        self, target: Variable, moved: Mapping[Kind, Variable], value: Callable[[str], sp.Expr]
    ) -> list[Statement]:
        """Return what sets the torque that each joint asks for which has no shaft before it."""
        law = Assign(target.at(), self._torque(moved, None))
        statements: list[Statement] = [
            Loop(Order.OUTWARD, start, stop, (law,)) for start, stop in self._stretches
        ]
        shafts = self.layout.tree.shafts
        for joint, acting in self._acting(value).items():
            if joint not in shafts and joint - 1 not in shafts:
                entry = target.entry(joint)
                statements.append(Assign(entry, entry - acting))
        return statements

    @property
    def _stretches(self) -> list[tuple[int, int]]:
        """Where stations follow each other that neither are shafts nor stand behind one."""
        found, start = [], 0
        for shaft in sorted(self.layout.tree.shafts):
            found.append((start, shaft))
            start = shaft + 2
        return [(begin, end) for begin, end in (*found, (start, self.layout.stations)) if begin < end]

    def _gears(
        self, moved: Mapping[Kind, Variable] = {}, value: Callable[[str], sp.Expr] = lambda _: sp.Integer(0)
    ) -> dict[int, ElasticGear]:
        """Return the elastic gears by the index of their shafts."""
        acting = self._acting(value)
        return {
            k: ElasticGear(
                k,
                (self._impedance(k), self._impedance(k + 1)),
                (
                    self._torque(moved, k) - acting.get(k, sp.Integer(0)),
                    self._torque(moved, k + 1) - acting.get(k + 1, sp.Integer(0)),
                ),
            )
            for k in sorted(self.layout.tree.shafts)
        }

    def _impedance(self, index: int | None) -> sp.Expr:
        """Torque of a joint's spring, damper and rotor per unknown."""
        return sp.Add(*(self.gains[kind] * self.layout.at(_OF[kind], index) for kind in KINDS))

    def _torque(self, moved: Mapping[Kind, Variable], index: int | None) -> sp.Expr:
        """Torque of a joint's spring, damper and rotor, in a loop or at one index."""
        layout = self.layout
        q, v, a = (
            (variable.at() if index is None else variable.entry(index))
            if (variable := moved.get(kind))
            else sp.Integer(0)
            for kind in KINDS
        )
        return (
            layout.at("stiffness", index) * (q - layout.at("rest", index))
            + layout.at("damping", index) * v
            + layout.at("armature", index) * a
        )

    def _acting(self, value: Callable[[str], sp.Expr]) -> dict[int, sp.Expr]:
        """Return what motors do at joints, by index."""
        found: dict[int, sp.Expr] = {}
        for item in self._driven:
            geared = self.layout.parameters.get(f"{item.name}_gear")
            torque = value(item.name) * (geared.ref if geared else 1)
            found[item.joint - 1] = found.get(item.joint - 1, sp.Integer(0)) + torque
        return found

    @property
    def _driven(self) -> list[ArmInput]:
        return [item for item in self.layout.arm.inputs if item.acts == "torque"]
