"""From parts in space to joints that turn about their own frame axes, each with one rigid body on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.initial import Values
from tmm_gen.scene.parts.order import BASE
from tmm_gen.scene.signal import ALONG
from tmm_gen.scene.spatial.arm import ArmInput, ArmOutput, Frame, Revolute, RigidBody, Vector
from tmm_gen.scene.spatial.beam import cells
from tmm_gen.scene.spatial.geometry import (
    NOWHERE,
    Point,
    Pose,
    floats,
    joint_frame,
    point,
    product,
    settled,
    transposed,
    turned,
    unit,
    vector,
)
from tmm_gen.scene.spatial.mass import NOTHING, Weight, weight
from tmm_gen.scene.spatial.signals import OF_JOINTS, SpatialInput, SpatialOutput
from tmm_gen.scene.spatial.tables import (
    RigidPart,
    SpatialBeam,
    SpatialJoint,
    SpatialMotor,
    SpatialPart,
    TurningPart,
)
from tmm_gen.scene.spatial.tree import Tree


@dataclass(frozen=True)
class SpatialExpansion:
    """What parts in space make.

    Parameters
    ----------
    joints : tuple of Revolute
        Base to tips, each branch to its end before the next, at angle and rate zero.
    frames : dict from str to Frame
        Outer end of each part by its name, in the order of ``joints``.
    numbers : dict from str to int
        Number of the joint that each motor or joint is, from 1.
    gears : dict from str to int
        Number of the joint that the spring of each motor's elastic gear is.
    inner : tuple of str
        Name of the part that each joint comes from.
    base : RigidBody
        All that is rigidly fixed to the base; nothing where that never moves.
    """

    joints: tuple[Revolute, ...]
    frames: Mapping[str, Frame]
    numbers: Mapping[str, int]
    gears: Mapping[str, int]
    inner: tuple[str, ...]
    base: RigidBody

    def inputs(self, items: Sequence[SpatialInput]) -> tuple[ArmInput, ...]:
        """Return inputs in the joints and on the frames that names mean."""
        return tuple(self._input(item) for item in items)

    def outputs(self, items: Sequence[SpatialOutput]) -> tuple[ArmOutput, ...]:
        """Return outputs of the joints and frames that names mean."""
        return tuple(
            ArmOutput(
                item.name,
                item.of,
                joint=self.numbers[item.at] if item.of in OF_JOINTS else 0,
                gear=self.gears.get(item.at, 0) if item.of in OF_JOINTS else 0,
                frame=None if item.of in OF_JOINTS else self._frame(item.at),
            )
            for item in items
        )

    def moving(self, angles: Values, rates: Values) -> tuple[Revolute, ...]:
        """Return the joints as they are at time zero; beams are straight."""
        found = list(self.joints)
        for name, number in self.numbers.items():
            if name == BASE:  # moves as its input says
                continue
            angle, rate = (_value(values, name) for values in (angles, rates))
            found[number - 1] = replace(found[number - 1], angle=angle, rate=rate)
        return tuple(found)

    def _input(self, item: SpatialInput) -> ArmInput:
        if item.acts in ALONG:
            return ArmInput(item.name, item.acts)
        if item.acts in ("torque", "angle"):
            return ArmInput(item.name, item.acts, joint=self.numbers[item.at])
        return ArmInput(item.name, item.acts, frame=self._frame(item.at), axes=item.axes)

    def _frame(self, name: str) -> Frame | None:
        """Return the outer end of a part, or the base's own frame; None of the arm as a whole."""
        return self.frames.get(name, Frame(BASE, 0) if name == BASE else None)


def _value(values: Values, name: str) -> float:
    """Return the value of a motor or joint: its own, or that of all; 0 where it has none."""
    if isinstance(values, dict):
        return values.get(name, 0.0)
    assert not isinstance(values, tuple)
    return values


@dataclass
class _Building:
    """An arm that grows from the base outward.

    Parameters
    ----------
    afloat : bool
        Whether the base moves, so that what is fixed to it weighs.
    """

    afloat: bool = False
    joints: list[Revolute] = field(default_factory=list)
    weights: list[Weight] = field(default_factory=lambda: [NOTHING])
    frames: dict[str, Frame] = field(default_factory=dict)
    numbers: dict[str, int] = field(default_factory=dict)
    gears: dict[str, int] = field(default_factory=dict)
    inner: list[str] = field(default_factory=list)

    def joint(self, joint: Revolute, part: str) -> int:
        """Add a joint without a body, and return its number."""
        self.joints.append(joint)
        self.weights.append(NOTHING)
        self.inner.append(part)
        return len(self.joints)

    def put(self, pose: Pose, body: Weight) -> None:
        """Fix a body to that of a joint, or to the base where that moves."""
        if pose.joint or self.afloat:
            self.weights[pose.joint] += body.at(pose)

    def done(self) -> SpatialExpansion:
        """Return what has grown."""
        bodies: dict[int, RigidBody] = {}
        for body in self.weights:  # pieces of a beam are one and the same
            if id(body) not in bodies:
                bodies[id(body)] = body.body()
        joints = tuple(
            replace(joint, body=bodies[id(body)])
            for joint, body in zip(self.joints, self.weights[1:], strict=True)
        )
        base = bodies[id(self.weights[0])]
        return SpatialExpansion(joints, self.frames, self.numbers, self.gears, tuple(self.inner), base)


def expanded(
    tree: Tree, *, afloat: bool = False, turns: tuple[Vector, str] | None = None
) -> SpatialExpansion:
    """Expand parts that keep all rules.

    Parameters
    ----------
    afloat : bool
        Whether nothing holds the base.
    turns : tuple of (Vector, str), optional
        The axis that a prescribed base turns about, and the input that is its angle.
    """
    made = _Building(afloat)
    ends = {BASE: Pose() if turns is None else _turning_base(made, *turns)}
    for hung in tree.outward():
        part = hung.part
        pose = ends[hung.on].then(point(part.at), turned(part.turn))
        ends[hung.name] = end = _placed(made, part, pose)
        made.frames[hung.name] = Frame(hung.name, end.joint, vector(end.at), floats(end.turn))
    return made.done()


def _turning_base(made: _Building, direction: Vector, given: str) -> Pose:
    """Add the joint that a prescribed base is, and return where parts hang on it."""
    axis, turn = joint_frame(Pose().turn, unit(direction))
    number = made.joint(Revolute(BASE, 0, turn=floats(turn), axis=axis, given=given), BASE)
    made.numbers[BASE] = number
    pose = Pose(number, NOWHERE, settled(transposed(turn)))
    made.frames[BASE] = Frame(BASE, number, vector(pose.at), floats(pose.turn))
    return pose


def _placed(made: _Building, part: SpatialPart, pose: Pose) -> Pose:
    """Add a part whose inner end has a pose, and return that of its outer end."""
    if isinstance(part, TurningPart):
        return _turning(made, part, pose)
    if isinstance(part, SpatialBeam):
        return _bending(made, part, pose)
    assert isinstance(part, RigidPart)
    made.put(pose, weight(part.mass, part.middle, part.inertia))
    return pose.then(point(part.outer))


def _turning(made: _Building, part: TurningPart, pose: Pose) -> Pose:
    axis, turn = joint_frame(pose.turn, unit(part.axis))
    joint = Revolute(
        part.name,
        pose.joint,
        at=vector(pose.at),
        turn=floats(turn),
        axis=axis,
        damping=part.damping,
        limits=part.limits,
    )
    if isinstance(part, SpatialMotor):
        armature = nearest(exact(part.gear) ** 2 * exact(part.rotor_inertia))
        damping = nearest(exact(part.damping) + exact(part.gear) ** 2 * exact(part.motor_damping))
        joint = replace(joint, armature=armature, damping=damping, gear=part.gear)
    if isinstance(part, SpatialJoint):
        joint = replace(joint, stiffness=part.stiffness, rest=part.rest)
    number = made.numbers[part.name] = made.joint(joint, part.name)
    if isinstance(part, SpatialMotor) and part.stiffness is not None:
        twist = nearest(exact(part.stiffness) * exact(part.damping_time))
        spring = Revolute(f"{part.name}_gear", number, axis=axis, stiffness=part.stiffness, damping=twist)
        number = made.gears[part.name] = made.joint(spring, part.name)
    # at angle zero what hangs on it stands as the part was placed, seen from the joint's own frame
    return Pose(number, NOWHERE, settled(product(transposed(turn), pose.turn)))


def _bending(made: _Building, part: SpatialBeam, pose: Pose) -> Pose:
    cut = cells(part)
    half, whole = (_ahead(cut.piece / 2), _ahead(cut.piece))
    made.put(pose, cut.half)
    pose = pose.then(half)
    for number, joints in enumerate(cut.joints, start=1):
        for joint in joints:
            revolute = Revolute(
                joint.name,
                pose.joint,
                at=vector(pose.at),
                turn=floats(pose.turn),
                axis=joint.axis,
                stiffness=joint.stiffness,
                damping=joint.damping,
            )
            pose = Pose(made.joint(revolute, part.name))
        last = number == part.links
        made.put(pose, cut.half if last else cut.whole)
        pose = pose.then(half if last else whole)
    return pose


def _ahead(length: Fraction) -> Point:
    return length, NOWHERE[1], NOWHERE[2]
