"""The joints' own laws in space: what springs, dampers, rotors and motors ask for, and how it answers to motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind
from tmm_gen.derive.space.inward import IMPEDANCE, TORQUE
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
        impedance = {IMPEDANCE} if self._impedance == 0 else set()
        lawless = not set(_OF.values()) & self.layout.parameters.keys()
        return frozenset(impedance | ({TORQUE} if lawless and not self._driven else set()))

    def impedances(self, target: Variable) -> Section:
        """Return what sets the torque per unknown at each joint."""
        loop = Loop(Order.OUTWARD, 0, self.layout.stations, (Assign(target.at(), self._impedance),))
        return Section("impedances of the joints", () if self._impedance == 0 else (loop,))

    def torques(
        self, target: Variable, moved: Mapping[Kind, sp.Expr], value: Callable[[str], sp.Expr]
    ) -> Section:
        """Return what sets the torque that each joint asks for.

        Parameters
        ----------
        target : Variable
            Array over the joints.
        moved : mapping from "q", "v", "a" to sympy.Expr
            Motion of the joint at station ``j``.
        value : callable
            Returns a motor's torque by its column.
        """
        layout = self.layout
        law = (
            layout.at("stiffness", None) * (moved["q"] - layout.at("rest", None))
            + layout.at("damping", None) * moved["v"]
            + layout.at("armature", None) * moved["a"]
        )
        statements: list[Statement] = [Loop(Order.OUTWARD, 0, layout.stations, (Assign(target.at(), law),))]
        for item in self._driven:
            entry = target.entry(item.joint - 1)
            geared = layout.parameters.get(f"{item.name}_gear")
            acting = value(item.name) * (geared.ref if geared else 1)
            statements.append(Assign(entry, entry - acting))
        return Section("torques of the joints' own", tuple(statements))

    @property
    def _impedance(self) -> sp.Expr:
        """Torque of a joint's spring, damper and rotor per unknown."""
        return sp.Add(*(self.gains[kind] * self.layout.at(_OF[kind], None) for kind in KINDS))

    @property
    def _driven(self) -> list[ArmInput]:
        return [item for item in self.layout.arm.inputs if item.acts == "torque"]
