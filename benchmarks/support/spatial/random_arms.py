"""Random arms in space: chains and trees, any axes and turns, full inertias, massless joints with bodies behind."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation

from tmm_gen.scene.spatial.arm import (
    UPRIGHT,
    ArmInput,
    ArmOutput,
    Frame,
    Revolute,
    RigidBody,
    SpatialArm,
    Turn,
    Vector,
)

MASSLESS = 0.25
"""Share of the joints that carry no body, where another joint stands on them."""


def random_arm(
    seed: int, joints: int | None = None, *, tree: bool | None = None, loads: bool = True
) -> SpatialArm:
    """Return a random arm, the same for the same arguments.

    Parameters
    ----------
    seed : int
    joints : int, optional
        3 to 12 by the seed if not given.
    tree : bool, optional
        Whether it may branch; by the seed if not given.
    loads : bool
        Whether forces and moments act on its frames, besides torques in all joints.
    """
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 13)) if joints is None else joints
    branches = bool(rng.random() < 0.5) if tree is None else tree
    hosts = _hosts(rng, count, branches)
    made: list[Revolute] = []
    for number in range(1, count + 1):
        bare = number in hosts and bool(rng.random() < MASSLESS)
        joint = _joint(rng, number, hosts[number - 1], bare)
        if joint.host and not made[joint.host - 1].body.mass:
            joint = _apart(joint, made[joint.host - 1])
        made.append(joint)
    frames = tuple(
        Frame(f"end_{number}", number, _vector(rng, 0.2), _turn(rng))
        for number in dict.fromkeys((count, max(1, count // 2)))
    )
    inputs = [ArmInput(f"torque_{number}", "torque", joint=number) for number in range(1, count + 1)]
    if loads:
        kinds: tuple[tuple[Literal["force", "moment"], Literal["world", "body"]], ...] = (
            ("force", "world"),
            ("force", "body"),
            ("moment", "world"),
            ("moment", "body"),
        )
        inputs += [
            ArmInput(f"{acts}_{axes}_{frame.name}", acts, frame=frame, axes=axes)
            for acts, axes in kinds
            for frame in frames
        ]
    outputs = [
        ArmOutput("last_angle", "angle", joint=count),
        ArmOutput("first_torque", "torque", joint=1),
        ArmOutput("tip", "position", frame=frames[0]),
        ArmOutput("tip_velocity", "velocity", frame=frames[0]),
        ArmOutput("tip_turn", "orientation", frame=frames[0]),
        ArmOutput("kinetic", "kinetic_energy"),
        ArmOutput("elastic", "elastic_energy"),
        ArmOutput("weight", "gravitational_energy"),
    ]
    return SpatialArm(tuple(made), frames, _vector(rng, 10.0), tuple(inputs), tuple(outputs))


def undamped(arm: SpatialArm) -> SpatialArm:
    """Return an arm without its dampers."""
    return replace(arm, joints=tuple(replace(joint, damping=0.0) for joint in arm.joints))


def random_body(rng: np.random.Generator) -> RigidBody:
    """Return a body of three to five point masses, so that its inertia is one that a body can have."""
    points = rng.uniform(-0.15, 0.15, (int(rng.integers(4, 6)), 3))
    shares = rng.uniform(0.05, 0.4, len(points))
    center = shares @ points / shares.sum()
    apart = points - center
    inertia = sum(m * (x @ x * np.eye(3) - np.outer(x, x)) for m, x in zip(shares, apart, strict=True))
    xx, yy, zz, xy, xz, yz = (
        float(inertia[r, c]) for r, c in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    )
    return RigidBody(float(shares.sum()), _tuple(center), (xx, yy, zz, xy, xz, yz))


def _hosts(rng: np.random.Generator, count: int, branches: bool) -> list[int]:
    """Return the host of each joint such that each branch stands to its end before the next."""
    hosts: list[int] = []
    way = [0]
    for number in range(1, count + 1):
        if branches and number > 1 and rng.random() < 0.35:
            way = way[: int(rng.integers(1, len(way) + 1))]
        hosts.append(way[-1])
        way.append(number)
    return hosts


def _joint(rng: np.random.Generator, number: int, host: int, bare: bool) -> Revolute:
    axis: Literal[0, 1, 2] = (0, 1, 2)[int(rng.integers(3))]
    sprung = rng.random() < 0.6
    return Revolute(
        name=f"joint_{number}",
        host=host,
        at=_vector(rng, 0.3) if rng.random() < 0.8 else (0.0, 0.0, 0.0),
        turn=_turn(rng),
        axis=axis,
        body=RigidBody() if bare else random_body(rng),
        stiffness=float(rng.uniform(1.0, 20.0)) if sprung else 0.0,
        damping=float(rng.uniform(0.0, 0.3)),
        rest=float(rng.uniform(-0.5, 0.5)) if sprung and rng.random() < 0.5 else 0.0,
        armature=float(rng.uniform(0.01, 0.1)) if rng.random() < 0.5 else 0.0,
        gear=float(rng.uniform(-50.0, 100.0)) if rng.random() < 0.5 else 1.0,
        angle=float(rng.uniform(-1.0, 1.0)),
        rate=float(rng.uniform(-2.0, 2.0)),
    )


def _apart(joint: Revolute, host: Revolute) -> Revolute:
    """Return a joint that turns about another axis than its massless host, so that no motion is without inertia.

    Where it is massless itself, a rotor holds the host: the axis behind both may come to lie along the first.
    """
    axis: Literal[0, 1, 2] = (1, 2, 0)[host.axis]
    rotor = joint.armature if joint.body.mass else max(joint.armature, 0.02)
    return replace(joint, axis=axis, turn=UPRIGHT, armature=rotor)


def _turn(rng: np.random.Generator) -> Turn:
    """Return no turn, quarter turns about one or two axes, or any."""
    kind = int(rng.integers(3))
    if kind == 0:
        return UPRIGHT
    if kind == 1:
        angles = 90.0 * rng.integers(0, 4, 2)
        matrix = np.round(Rotation.from_euler("xz", angles, degrees=True).as_matrix())
    else:
        matrix = Rotation.from_rotvec(rng.uniform(-2.0, 2.0, 3)).as_matrix()
    first, second, third = (_tuple(row + 0.0) for row in matrix)
    return (first, second, third)


def _vector(rng: np.random.Generator, size: float) -> Vector:
    return _tuple(rng.uniform(-size, size, 3))


def _tuple(values: np.ndarray) -> Vector:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
