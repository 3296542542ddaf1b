"""The pins of a planar arm: springs and dampers, and motors at the joints that have one."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements import nodes as element
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.planar import DAMPING, STIFFNESS
from tmm_gen.row.row import Combination, Load, Parameter
from tmm_gen.row.words import symbol
from tmm_gen.scene import Joint, Scene, station_of
from tmm_gen.scene.quantity import INPUT_UNITS


def bent_at_rest(joint: Joint) -> bool:
    """Return whether a spring acts that is slack at another angle than 0."""
    return joint.rest != 0.0 and joint.stiffness != 0.0


def drives_of(scene: Scene) -> tuple[Load, ...]:
    """Return the torques of motors and in joints, which act between both sides."""
    acting = sorted(
        (station_of(item.at, scene.stations) - 1, item.name) for item in scene.inputs if item.acts == "drive"
    )
    if not acting:
        return ()
    return (Load(sp.Symbol("drive_"), "torque of each joint's motor", INPUT_UNITS["drive"], tuple(acting)),)


def armature_of(scene: Scene) -> tuple[Combination, ...]:
    """Return the combination that motors need at each joint, if there are any."""
    if not any(j.rotor_inertia for j in scene.joints):
        return ()
    doc = "inertia of a joint's motor at the joint, between both sides"
    return (Combination("armature", doc, "kg m^2", at_the_joint(scene)),)


def at_the_joint(scene: Scene) -> sp.Expr:
    """Return what a rotor's inertia is at its joint, by the parameters."""
    geared = any(j.gear != 1.0 for j in scene.joints)
    return sp.Symbol("rotor_inertia") * (sp.Symbol("gear") ** 2 if geared else 1)


def pin_of(
    scene: Scene, named: dict[str, Parameter | None], index: int, drives: tuple[Load, ...], armature: sp.Expr
) -> Element:
    """Return the pin of a station, with what is in this one joint alone.

    Parameters
    ----------
    armature : sympy.Expr
        How a rotor's inertia at the joint is written.
    """
    joint = scene.joints[index]
    values = {STIFFNESS: symbol(named["stiffness"]), DAMPING: symbol(named["damping"])}
    driven = any(place == index for load in drives for place, _ in load.places)
    if not (joint.rotor_inertia or driven or bent_at_rest(joint)):
        return element.PIN.with_values(values)
    gear = symbol(named["gear"]) if joint.gear != 1.0 else sp.Integer(1)
    values |= {
        element.REST: symbol(named["rest"]) if bent_at_rest(joint) else sp.Integer(0),
        element.ARMATURE: armature if joint.rotor_inertia else sp.Integer(0),
        element.DRIVE: gear * drives[0].symbol if driven else sp.Integer(0),
    }
    if joint.rotor_inertia or driven:
        values |= {
            key: sp.Integer(0)
            for key, at in ((STIFFNESS, joint.stiffness), (DAMPING, joint.damping))
            if not at
        }
    return element.DRIVEN_PIN.with_values(values)
