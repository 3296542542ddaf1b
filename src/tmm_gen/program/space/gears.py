"""Elastic gears in space: a shaft without mass between a motor and the spring of its gear takes no part in sweeps.

The shaft and the joint behind it turn about one axis, so that what stands beyond sees one joint, which turns by the sum
of both. Its law is that of motor and gear one behind the other (:mod:`tmm_gen.derive.station.shaft`), as in a plane.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import sympy as sp

from tmm_gen.derive.station.lets import Let, Line, Pivot
from tmm_gen.derive.station.shaft import GAP, OWN, TORQUES, UNKNOWN, Shaft
from tmm_gen.program.statements import Assign, Require
from tmm_gen.program.variables import Ref, local
from tmm_gen.scene.spatial.arm import UPRIGHT, ZERO, RigidBody, SpatialArm

_TORQUE, _FOUND, _TURN = sp.symbols("gear_torque_of_both gear_found gear_turn", real=True)
"""Of a shaft and the joint behind it: their torque, and what the sweep finds them to do together."""


def shafts_of(arm: SpatialArm, marked: frozenset[int]) -> frozenset[int]:
    """Return the indices of shafts: joints that carry nothing but a joint about the same axis at the same point.

    Parameters
    ----------
    marked : frozenset of int
        Indices of joints on whose bodies something acts or is read.
    """
    found: set[int] = set()
    hosts = [joint.host for joint in arm.joints]
    for k, joint in enumerate(arm.joints):
        number = joint.host
        if not number or hosts.count(number) > 1 or number - 1 in marked | found:
            continue
        shaft = arm.joints[number - 1]
        in_line = joint.at == ZERO and joint.turn == UPRIGHT and joint.axis == shaft.axis and k == number
        # a start without a rotor on either side has no pivot
        turns = shaft.body == RigidBody() and shaft.armature + joint.armature > 0.0
        if in_line and turns and not shaft.given and number - 2 not in found:
            found.add(number - 1)
    return frozenset(found)


def marked_by(arm: SpatialArm) -> frozenset[int]:
    """Return the indices of joints on whose bodies something acts or is read."""
    frames = [item.frame for item in arm.inputs] + [item.frame for item in arm.outputs]
    return frozenset(frame.joint - 1 for frame in frames if frame is not None and frame.joint)


def set_aside(arm: SpatialArm, shafts: frozenset[int]) -> SpatialArm:
    """Return an arm in which what a shaft turns stands where the shaft is mounted."""
    joints = list(arm.joints)
    for k in shafts:
        shaft = joints[k]
        joints[k + 1] = replace(joints[k + 1], host=shaft.host, at=shaft.at, turn=shaft.turn)
    return replace(arm, joints=tuple(joints))


class ElasticGear:
    """Writes what a shaft adds to a sweep.

    Parameters
    ----------
    index : int
        Of the shaft; the joint that it turns comes next.
    impedances, torques : tuple of 2 sympy.Expr
        Torque per unknown, and at the point of linearisation, of what turns the shaft and of its gear.
    """

    def __init__(
        self, index: int, impedances: tuple[sp.Expr, sp.Expr], torques: tuple[sp.Expr, sp.Expr]
    ) -> None:
        shaft = self._shaft = Shaft(impedances, TORQUES, 1, "kg m^2")
        own = zip(TORQUES, torques, ("torque on a shaft before the sweep", "torque of its gear"), strict=True)
        self._torques = [Let(symbol, value, doc, "N m") for symbol, value, doc in own]
        self._gap, *self._shared = shaft.known(_TORQUE, "torque of a motor and its gear")
        self._known: list[Line] = [*self._torques, self._gap, *self._shared]
        self._answer: list[Line] = [Let(_TURN, _FOUND, "what a shaft and its joint do together", "rad/s^2")]
        lets = [line for line in (*shaft.ahead, *self._known, *self._answer) if isinstance(line, Let)]
        self._names = {let.symbol: local(f"{let.symbol.name}{index + 1}", let.doc, let.unit) for let in lets}

    @property
    def ahead(self) -> list[Assign | Require]:
        """Its factors, of parameters and gains alone."""
        return self._written(self._shaft.ahead, {})

    @property
    def impedance(self) -> sp.Expr:
        """Torque per unknown of both together."""
        return self._shaft.impedance.xreplace(self._names)

    def known(self, target: Ref) -> list[Assign | Require]:
        """Return the torque of both together, and what of it remains for the way back."""
        return self._written(self._known, {_TORQUE: target})

    def lacking(self, gap: Ref, joint: Ref) -> list[Assign | Require]:
        """Return the torque of the gear, and what is over of those on the shaft, each by itself."""
        return self._written([*self._torques, self._gap], {GAP: gap, TORQUES[1]: joint})

    def shared(self, gap: Ref, joint: Ref) -> list[Assign | Require]:
        """Return what both together lack in place of the joint, by what each of both does."""
        return self._written([*self._shared], {GAP: gap, TORQUES[1]: joint, _TORQUE: joint})

    def answer(self, shaft: Ref, joint: Ref, *, again: bool) -> list[Assign | Require]:
        """Return what each of both does, by what the sweep has found both to do.

        The gear's twist is written first, not as a difference: it may be many orders smaller.

        Parameters
        ----------
        again : bool
            Whether a sweep before has brought the torques on both sides of the shaft together.
        """
        twist = self._shaft.answer(_TURN, sp.Integer(0))
        known: dict[sp.Symbol, sp.Expr] = {_FOUND: joint, UNKNOWN: joint}
        written = self._written([*self._answer, twist], known | ({OWN: sp.Integer(0)} if again else {}))
        return [*written, Assign(shaft, self._names[_TURN] - joint)]

    def _written(self, lines: list[Line], values: Mapping[sp.Symbol, sp.Expr]) -> list[Assign | Require]:
        names = {**self._names, **values}
        found: list[Assign | Require] = []
        for line in lines:
            if isinstance(line, Pivot):
                found.append(Require(sp.sympify(line.value).xreplace(names)))
            elif isinstance(line, Let):
                found.append(Assign(names[line.symbol], sp.sympify(line.value).xreplace(names)))
            else:
                found += [Assign(names[s], sp.sympify(v).xreplace(names)) for s, v in line.values.items()]
        return found
