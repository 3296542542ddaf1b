"""The parameters of a kernel of an arm in space: what they are called, and how they are read off an arm."""

from __future__ import annotations

from collections.abc import Callable

from tmm_gen.derive.space.declaration import AXES, PAIRS
from tmm_gen.program.space.base_layout import base_numbers
from tmm_gen.program.space.gears import marked_by, set_aside, shafts_of
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene.spatial.arm import Revolute, SpatialArm


def parameter_values(arm: SpatialArm) -> dict[str, tuple[float, ...]]:
    """Return all that parameters of an arm's kernel can be, by name: of each joint, or one number of the whole arm.

    A kernel of the same parts, joints and axes takes them, whatever numbers it was built with: one value where
    its parameter is the same everywhere.
    """
    arm = set_aside(arm, shafts_of(arm, marked_by(arm)))
    return {
        **{name: tuple(value(joint) for joint in arm.joints) for name, _, _, value in _of_joints()},
        **{f"{name}_gear": (gear,) for name, _, gear in _gears(arm)},
        **{f"gravity_{axis}": (value,) for axis, value in zip(AXES, arm.gravity, strict=True)},
        **({f"base_{name}": (value,) for name, _, _, value in base_numbers(arm.base)} if arm.base else {}),
    }


def parameters_of(arm: SpatialArm) -> list[Variable]:
    """Return the parameters that some joint has; what is zero in the scene is left out of the code and stays zero."""
    found = []
    for name, doc, unit, value in _of_joints():
        values = tuple(value(joint) for joint in arm.joints)
        if any(values):
            alike = len(set(values)) == 1
            zeros = "" if alike or all(values) else "; what is zero here is not in the code"
            found.append(
                Variable(
                    name,
                    Role.PARAMETER,
                    None if alike else len(values),
                    f"{doc}, the same everywhere" if alike and len(values) > 1 else doc + zeros,
                    unit,
                    values[0] if alike else values,
                )
            )
    for name, joint, gear in _gears(arm):
        if gear != 1.0:
            doc = f"turns of the motor per turn of '{joint}'"
            found.append(Variable(f"{name}_gear", Role.PARAMETER, None, doc, "1", gear))
    for axis, gravity in zip(AXES, arm.gravity, strict=True):
        if gravity:
            doc = f"gravity along {axis}"
            found.append(Variable(f"gravity_{axis}", Role.PARAMETER, None, doc, "m/s^2", gravity))
    return found


def _gears(arm: SpatialArm) -> list[tuple[str, str, float]]:
    """Return the inputs that are torques of motors: name, the joint's name, and its gear."""
    driven = [(item.name, arm.joints[item.joint - 1]) for item in arm.inputs if item.acts == "torque"]
    return [(name, joint.name, joint.gear) for name, joint in driven]


def _of_joints() -> list[tuple[str, str, str, Callable[[Revolute], float]]]:
    """Return what joints and their bodies have: name, words, unit, and how it is read off a joint."""
    return [
        *(
            (
                f"offset_{axis}",
                f"place of each joint from the one it stands on, along {axis}",
                "m",
                _of_vector("at", k),
            )
            for k, axis in enumerate(AXES)
        ),
        ("mass", "mass behind each joint", "kg", lambda joint: joint.body.mass),
        *(
            (f"center_{axis}", f"centre of mass from the joint along {axis}", "m", _of_center(k))
            for k, axis in enumerate(AXES)
        ),
        *(
            (f"center_inertia_{pair}", f"inertia about the centre of mass, {pair}", "kg m^2", _of_inertia(k))
            for k, pair in enumerate(PAIRS)
        ),
        ("stiffness", "stiffness of each joint", "N m/rad", lambda joint: joint.stiffness),
        ("damping", "damping of each joint", "N m s/rad", lambda joint: joint.damping),
        ("rest", "angle at which each joint's spring is slack", "rad", lambda joint: joint.rest),
        ("armature", "inertia of each joint's rotor, at the joint", "kg m^2", lambda joint: joint.armature),
    ]


def _of_vector(field: str, k: int) -> Callable[[Revolute], float]:
    return lambda joint: getattr(joint, field)[k]


def _of_center(k: int) -> Callable[[Revolute], float]:
    return lambda joint: joint.body.center[k] if joint.body.mass else 0.0


def _of_inertia(k: int) -> Callable[[Revolute], float]:
    return lambda joint: joint.body.inertia[k]
