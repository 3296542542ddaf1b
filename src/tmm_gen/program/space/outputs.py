"""Outputs of an arm in space, read off the state."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Past
from tmm_gen.derive.space.base_pose import facing_line, quaternion_line
from tmm_gen.derive.space.base_pose import velocity_lines as base_velocity
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
from tmm_gen.derive.space.reaction import axis_lines, based_lines, passed_lines
from tmm_gen.derive.station.lets import Line, Update
from tmm_gen.program.arm.loads import exactly
from tmm_gen.program.space.base_values import base_values, moved
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.space.over_stations import MOTION
from tmm_gen.program.space.reactions import handed_in
from tmm_gen.program.space.read_together import together
from tmm_gen.program.space.turns import quaternion_of
from tmm_gen.program.space.walks import SpaceWalks, outward
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Variable
from tmm_gen.scene.spatial.arm import ArmOutput, Frame

_TOTAL = sp.Symbol("total", real=True)
_FORCES = sp.Matrix(sp.symbols("total_x total_y total_z", real=True))


def output_routine(layout: SpaceLayout, bodies: Bodies) -> Routine:
    """Build the outputs from the state."""
    readings = _Readings(layout, bodies)
    sections = tuple(
        Section(
            f"output {', '.join(o.name for o in group)}: {group[0].of.replace('_', ' ')}",
            tuple(readings.statements(group)),
        )
        for group in together(layout)
    )
    return Routine("output", "Read the outputs off the state.", sections)


class _Readings:
    """Statements for each kind of output."""

    def __init__(self, layout: SpaceLayout, bodies: Bodies) -> None:
        self._layout, self._bodies = layout, bodies
        self._outputs = {v.name: v.ref for v in layout.outputs}
        self._by: dict[str, Callable[[Sequence[ArmOutput]], list[Statement]]] = {
            "bend": self._motion,
            "through": self._torque,
            "force": self._force,
            "place": self._place,
            "energy": self._energy,
        }

    def statements(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        """Return the statements of one output, or of several frames that one walk passes."""
        return self._by[outputs[0].quantity.read](outputs)

    def _alone(self, outputs: Sequence[ArmOutput]) -> tuple[ArmOutput, list[Ref]]:
        """Return an output that is read by itself, and its targets."""
        (output,) = outputs
        return output, self._targets(output)

    def _targets(self, output: ArmOutput) -> list[Ref]:
        return [self._outputs[column] for column in output.columns]

    def _state(self, kind: Kind) -> Variable:
        return self._layout.state[Past(kind, 0)]

    def _walks(self) -> SpaceWalks:
        motion = {MOTION[k]: self._state(k) for k in KINDS}
        gains = (sp.S.Zero, sp.S.Zero, sp.S.One)
        return SpaceWalks(self._layout, self._bodies, motion, gains, base=base_values(self._layout))

    def _at_base(self, lines: tuple[Line, ...]) -> tuple[Line, ...]:
        """Return lines that begin a walk at a base that floats; none at one that rests."""
        return lines if self._layout.base else ()

    def _rests(self, frame: Frame) -> bool:
        return not frame.joint and self._layout.base is None

    # -- joints ------------------------------------------------------------------------------------------------

    def _motion(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        output, targets = self._alone(outputs)
        state = self._state(KINDS[output.quantity.order])
        return [Assign(targets[0], sp.Add(*(state.entry(number - 1) for number in output.turning)))]

    def _torque(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        """Return what spring, damper and motor exert on the outer side, or what drives a joint that is given."""
        output, targets = self._alone(outputs)
        layout, k = self._layout, output.passing - 1
        if layout.arm.joints[k].given:
            return self._driving(targets[0])
        stretched = self._state("q").entry(k) - layout.at("rest", k)
        resisting = layout.at("stiffness", k) * stretched + layout.at("damping", k) * self._state("v").entry(
            k
        )
        driving = sp.Integer(0)
        for item in layout.arm.inputs:
            if item.acts == "torque" and item.joint == output.passing:
                gear = layout.parameters.get(f"{item.name}_gear")
                driving += layout.held[item.name].ref * (gear.ref if gear else 1)
        return [Assign(targets[0], driving - resisting)]

    def _driving(self, target: Ref) -> list[Statement]:
        """Return the moment about the axis of what moves as given."""
        walks = self._walks()
        total = walks.scalar(_TOTAL, "about the axis of what moves as given", "N m")

        def inward(pattern: Pattern) -> Sequence[Line]:
            out = outward(pattern.freed, False)
            return axis_lines(out, _TOTAL) if pattern.given else passed_lines(out)

        return [*handed_in(self._layout, walks, inward), Assign(target, total)]

    def _force(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        """Return the force of a base that something holds: all that arrives at it, in the axes of the world."""
        _, targets = self._alone(outputs)
        walks = self._walks()
        totals = [walks.scalar(symbol, "force that has arrived at the base", "N") for symbol in _FORCES]

        def inward(pattern: Pattern) -> Sequence[Line]:
            return based_lines(outward(pattern.freed, False), _FORCES)

        return [
            *(Assign(total, sp.Integer(0)) for total in totals),
            *handed_in(self._layout, walks, inward),
            *(Assign(target, total) for target, total in zip(targets, totals, strict=True)),
        ]

    # -- frames ------------------------------------------------------------------------------------------------

    def _place(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        quantity = outputs[0].quantity
        if quantity.order:
            return self._velocity(outputs)
        turns = len(quantity.components) == len(QUATERNION)
        return self._orientation(outputs) if turns else self._position(outputs)

    def _position(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        frame = _frame(outputs[0])
        if self._rests(frame):
            at, (_, targets) = sp.Matrix([exactly(r) for r in frame.at]), self._alone(outputs)
            return [
                Assign(t, v + moved(self._layout, "place", k))
                for k, (t, v) in enumerate(zip(targets, at, strict=True))
            ]

        def value(frame: Frame) -> sp.Matrix:
            return PLACE + FACING.T * sp.Matrix([exactly(r) for r in frame.at])

        return self._read(pose_lines, (*PLACE, *FACING), value, outputs, facing_line(place=True))

    def _orientation(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        frame = _frame(outputs[0])

        def own(frame: Frame) -> sp.Matrix:
            return sp.Matrix([exactly(x) for x in quaternion_of(frame.turn)])

        if self._rests(frame):
            _, targets = self._alone(outputs)
            return [Assign(t, v) for t, v in zip(targets, own(frame), strict=True)]

        def value(frame: Frame) -> sp.Matrix:
            return quaternion_product(QUATERNION, own(frame))

        return self._read(quaternion_lines, tuple(QUATERNION), value, outputs, quaternion_line())

    def _velocity(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        if self._rests(_frame(outputs[0])):
            _, targets = self._alone(outputs)
            return [Assign(t, moved(self._layout, "velocity", k)) for k, t in enumerate(targets)]

        def lines(pattern: Pattern) -> Sequence[Line]:
            return (*velocity_lines(pattern), *facing_lines(pattern))

        def value(frame: Frame) -> sp.Matrix:
            return FACING.T * (VELOCITY + OMEGA.cross(sp.Matrix([exactly(r) for r in frame.at])))

        carried = (*VELOCITY, *OMEGA, *FACING)
        return self._read(lines, carried, value, outputs, (*base_velocity(), *facing_line()))

    def _read(
        self,
        lines: Callable[[Pattern], Sequence[Line]],
        carried: tuple[sp.Symbol, ...],
        value: Callable[[Frame], sp.Matrix],
        outputs: Sequence[ArmOutput],
        begun: tuple[Line, ...],
    ) -> list[Statement]:
        """Walk out to the last frame's body, and read outputs on the way; ``begun`` at a base that floats."""
        reads: dict[int, dict[Ref, sp.Expr]] = {}
        for output in outputs:
            frame = _frame(output)
            values = zip(self._targets(output), value(frame), strict=True)
            reads.setdefault(frame.joint - 1, {}).update(values)
        last = max(reads)
        if last < 0:
            return list(self._walks().base_lines((*begun, Update(reads[last]))))

        def read(index: int) -> Sequence[Line]:
            return (Update(reads[index]),) if index in reads else ()

        within = self._layout.tree.inward_of(last)
        return self._walks().walk(Order.OUTWARD, lines, carried, read, within, self._at_base(begun))

    # -- energies ----------------------------------------------------------------------------------------------

    def _summed(
        self,
        target: Ref,
        lines: Callable[[Pattern], Sequence[Line]],
        carried: tuple[sp.Symbol, ...],
        energy: Callable[[Pattern], sp.Expr],
        begun: tuple[Line, ...],
    ) -> list[Statement]:
        def all_lines(pattern: Pattern) -> Sequence[Line]:
            share = energy(pattern)
            return (*lines(pattern), *([Update({_TOTAL: _TOTAL + share})] if share != 0 else []))

        walks = self._walks()
        total = walks.scalar(_TOTAL, "of all bodies so far", "J")
        base = self._layout.base
        of_base = (*begun, Update({_TOTAL: _TOTAL + energy(base.pattern)})) if base else ()
        walked = walks.walk(Order.OUTWARD, all_lines, carried, base=of_base)
        return [Assign(total, sp.Integer(0)), *walked, Assign(target, total)]

    def _energy(self, outputs: Sequence[ArmOutput]) -> list[Statement]:
        output, targets = self._alone(outputs)
        by = {"kinetic": self._kinetic, "elastic": self._elastic, "gravitational": self._gravitational}
        return by[output.quantity.energy](targets)

    def _kinetic(self, targets: list[Ref]) -> list[Statement]:
        """Return the bodies' energy, and the rotors' about their joints."""
        carried = (*VELOCITY, *OMEGA)
        found = self._summed(targets[0], velocity_lines, carried, kinetic_energy, base_velocity())
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

        return self._summed(targets[0], pose_lines, (*PLACE, *FACING), energy, facing_line(place=True))


def _frame(output: ArmOutput) -> Frame:
    assert output.frame is not None
    return output.frame
