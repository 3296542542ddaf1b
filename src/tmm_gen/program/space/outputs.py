"""Outputs of an arm in space, read off the state."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past
from tmm_gen.derive.space.declaration import AXES, OMEGA, VELOCITY
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.pose import (
    FACING,
    PLACE,
    QUATERNION,
    facing_lines,
    kinetic_energy,
    pose_lines,
    quaternion_lines,
    quaternion_product,
    velocity_lines,
)
from tmm_gen.derive.station.lets import Line, Update
from tmm_gen.program.arm.loads import exactly
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.turns import quaternion_of
from tmm_gen.program.space.walks import MOTION, SpaceWalks
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Variable
from tmm_gen.scene.spatial.arm import ArmOutput, Frame

_TOTAL = sp.Symbol("total", real=True)


def output_routine(layout: SpaceLayout, bodies: Bodies) -> Routine:
    """Build the outputs from the state."""
    readings = _Readings(layout, bodies)
    sections = tuple(
        Section(f"{o.name}: {o.of.replace('_', ' ')}", tuple(readings.statements(o)))
        for o in layout.arm.outputs
    )
    return Routine("output", "Read the outputs off the state.", sections)


class _Readings:
    """Statements for each kind of output."""

    def __init__(self, layout: SpaceLayout, bodies: Bodies) -> None:
        self._layout, self._bodies = layout, bodies
        self._outputs = {v.name: v.ref for v in layout.outputs}
        self._by: dict[str, Callable[[ArmOutput, list[Ref]], list[Statement]]] = {
            "bend": self._motion,
            "through": self._torque,
            "place": self._place,
            "energy": self._energy,
        }

    def statements(self, output: ArmOutput) -> list[Statement]:
        """Return the statements of one output."""
        return self._by[output.quantity.read](output, [self._outputs[c] for c in output.columns])

    def _state(self, kind: Kind) -> Variable:
        return self._layout.state[Past(kind, 0)]

    def _walks(self) -> SpaceWalks:
        motion = {MOTION[k]: self._state(k) for k in KINDS}
        return SpaceWalks(self._layout, self._bodies, motion, (sp.S.Zero, sp.S.Zero, sp.S.One))

    # -- joints ------------------------------------------------------------------------------------------------

    def _motion(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        return [Assign(targets[0], self._state(KINDS[output.quantity.order]).entry(output.joint - 1))]

    def _torque(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        """Return what spring, damper and motor exert on the outer side."""
        layout, k = self._layout, output.joint - 1
        stretched = self._state("q").entry(k) - layout.at("rest", k)
        resisting = layout.at("stiffness", k) * stretched + layout.at("damping", k) * self._state("v").entry(
            k
        )
        driving = sp.Integer(0)
        for item in layout.arm.inputs:
            if item.acts == "torque" and item.joint == output.joint:
                gear = layout.parameters.get(f"{item.name}_gear")
                driving += layout.held[item.name].ref * (gear.ref if gear else 1)
        return [Assign(targets[0], driving - resisting)]

    # -- frames ------------------------------------------------------------------------------------------------

    def _place(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        if output.quantity.order:
            return self._velocity(output, targets)
        turns = len(output.quantity.components) == len(QUATERNION)
        return self._orientation(output, targets) if turns else self._position(output, targets)

    def _position(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        frame = _frame(output)
        at = sp.Matrix([exactly(r) for r in frame.at])
        if not frame.joint:
            return [Assign(t, v) for t, v in zip(targets, at, strict=True)]
        return self._read(frame, pose_lines, (*PLACE, *FACING), PLACE + FACING.T * at, targets)

    def _orientation(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        frame = _frame(output)
        own = sp.Matrix([exactly(x) for x in quaternion_of(frame.turn)])
        if not frame.joint:
            return [Assign(t, v) for t, v in zip(targets, own, strict=True)]
        value = quaternion_product(QUATERNION, own)
        return self._read(frame, quaternion_lines, tuple(QUATERNION), value, targets)

    def _velocity(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        frame = _frame(output)
        if not frame.joint:
            return [Assign(t, sp.Integer(0)) for t in targets]
        at = sp.Matrix([exactly(r) for r in frame.at])

        def lines(pattern: Pattern) -> Sequence[Line]:
            return (*velocity_lines(pattern), *facing_lines(pattern))

        carried = (*VELOCITY, *OMEGA, *FACING)
        return self._read(frame, lines, carried, FACING.T * (VELOCITY + OMEGA.cross(at)), targets)

    def _read(
        self,
        frame: Frame,
        lines: Callable[[Pattern], Sequence[Line]],
        carried: tuple[sp.Symbol, ...],
        value: sp.Matrix,
        targets: list[Ref],
    ) -> list[Statement]:
        """Walk out to a frame's body, and read something there."""
        last = frame.joint - 1

        def read(index: int) -> Sequence[Line]:
            return (Update(dict(zip(targets, value, strict=True))),) if index == last else ()

        return self._walks().walk(Order.OUTWARD, lines, carried, read, self._layout.tree.inward_of(last))

    # -- energies ----------------------------------------------------------------------------------------------

    def _summed(
        self,
        target: Ref,
        lines: Callable[[Pattern], Sequence[Line]],
        carried: tuple[sp.Symbol, ...],
        energy: Callable[[Pattern], sp.Expr],
    ) -> list[Statement]:
        def all_lines(pattern: Pattern) -> Sequence[Line]:
            share = energy(pattern)
            return (*lines(pattern), *([Update({_TOTAL: _TOTAL + share})] if share != 0 else []))

        walks = self._walks()
        total = walks.scalar(_TOTAL, "of all bodies so far", "J")
        walked = walks.walk(Order.OUTWARD, all_lines, carried)
        return [Assign(total, sp.Integer(0)), *walked, Assign(target, total)]

    def _energy(self, output: ArmOutput, targets: list[Ref]) -> list[Statement]:
        by = {"kinetic": self._kinetic, "elastic": self._elastic, "gravitational": self._gravitational}
        return by[output.quantity.energy](targets)

    def _kinetic(self, targets: list[Ref]) -> list[Statement]:
        """Return the bodies' energy, and the rotors' about their joints."""
        found = self._summed(targets[0], velocity_lines, (*VELOCITY, *OMEGA), kinetic_energy)
        armature = self._layout.at("armature", None)
        if armature != 0:
            share = armature * self._state("v").at() ** 2 / 2
            loop = Loop(Order.OUTWARD, 0, self._layout.stations, (Assign(targets[0], targets[0] + share),))
            found.append(loop)
        return found

    def _elastic(self, targets: list[Ref]) -> list[Statement]:
        layout = self._layout
        share = layout.at("stiffness", None) * (self._state("q").at() - layout.at("rest", None)) ** 2 / 2
        begin = Assign(targets[0], sp.Integer(0))
        loop = Loop(Order.OUTWARD, 0, layout.stations, (Assign(targets[0], targets[0] + share),))
        return [begin, loop] if share != 0 else [begin]

    def _gravitational(self, targets: list[Ref]) -> list[Statement]:
        layout = self._layout
        gravity = sp.Matrix([layout.at(f"gravity_{axis}", None) for axis in AXES])

        def energy(pattern: Pattern) -> sp.Expr:
            moment = pattern.symbols["first_moment"]
            return -gravity.dot(pattern.mass_symbol * PLACE + FACING.T * moment)

        return self._summed(targets[0], pose_lines, (*PLACE, *FACING), energy)


def _frame(output: ArmOutput) -> Frame:
    assert output.frame is not None
    return output.frame
