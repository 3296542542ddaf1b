"""What a robot's links weigh: each by itself, and all that a joint carries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tmm_gen.urdf.faults import Faults
from tmm_gen.urdf.flexibility import Flexibility, JointGives
from tmm_gen.urdf.placement import Floats, Place, matrix_of, moved
from tmm_gen.urdf.robot import TURNING, Inertial
from tmm_gen.urdf.tree import RobotTree

_ROUNDING = 1e-13
"""Of the largest moment of inertia at hand: what is less is none."""
_DIGITS = 1e-9
"""Of the largest moment of inertia: how far digits cut off may make a matrix seem impossible."""
_SPECK = 1e-6
"""m; a moment of inertia that mass as near as this to the centre has is none."""


def own_inertia(inertial: Inertial) -> Floats:
    """Return a link's inertia about its centre of mass in the link's axes, kg m^2; shape (3, 3)."""
    turn = inertial.origin.turn
    given = matrix_of(inertial.inertia)
    # as written where nothing is turned: no digit is lost
    inertia: Floats = given if np.array_equal(turn, np.eye(3)) else turn @ given @ turn.T
    return inertia


def cannot_be(inertia: Floats) -> bool:
    """Whether no body of positive mass has an inertia: one principal moment exceeds the sum of the others."""
    low, middle, high = np.linalg.eigvalsh(inertia)
    return bool(high > (low + middle) * (1.0 + 1e-6))


def is_rounding(inertial: Inertial) -> bool:
    """Whether an inertia is what rounding left of zero: that of no body, and far too small for this mass."""
    largest = max(map(abs, inertial.inertia))
    return largest <= inertial.mass * _SPECK**2 and _least(inertial) < 0.0


def _least(inertial: Inertial) -> float:
    """Return the least principal moment, kg m^2."""
    largest = max(map(abs, inertial.inertia))
    # over the largest, so that neither huge nor tiny ones leave the range
    return largest * float(np.linalg.eigvalsh(matrix_of(inertial.inertia) / largest)[0]) if largest else 0.0


def require_possible(tree: RobotTree, faults: Faults) -> None:
    """Refuse inertias by which a body would turn the wrong way; those of the clamped base do nothing."""
    clamped = {tree.root.name}
    for link in tree.outward():
        here = link.name in clamped
        clamped |= {j.child for j in tree.leaving.get(link.name, ()) if here and j.kind == "fixed"}
        inertial = link.inertial
        if here or inertial is None or is_rounding(inertial):
            continue
        least = _least(inertial)
        if least < -_DIGITS * max(map(abs, inertial.inertia)):
            faults.add(
                inertial.inertia_line,
                f"link '{link.name}' <inertia>",
                f"has the principal moment {least:g} kg m^2; no body has a negative one",
                "Check signs and the axes of the products of inertia.",
            )


@dataclass
class _Carried:
    """All that a link carries and is, at angles of zero: mass, first moment and inertia about the root's origin."""

    mass: float
    moment: Floats
    inertia: Floats


def require_inertia(tree: RobotTree, flexibility: Flexibility, faults: Faults) -> None:
    """Refuse joints that carry nothing that resists their turning: their acceleration would have no bounds."""
    places = {tree.root.name: Place.of()}
    carried: dict[str, _Carried] = {}
    links = tree.outward()
    for link in links:
        place, inertial = places[link.name], link.inertial
        for joint in tree.leaving.get(link.name, ()):
            places[joint.child] = place @ joint.origin
        if inertial is None:
            carried[link.name] = _Carried(0.0, np.zeros(3), np.zeros((3, 3)))
            continue
        center = place.at + place.turn @ inertial.origin.at
        about_center = place.turn @ own_inertia(inertial) @ place.turn.T
        inertia = moved(inertial.mass, about_center, center)
        carried[link.name] = _Carried(inertial.mass, inertial.mass * center, inertia)
    for link in reversed(links):
        for joint in tree.leaving.get(link.name, ()):
            outer, inner = carried[joint.child], carried[link.name]
            inner.mass += outer.mass
            inner.moment = inner.moment + outer.moment
            inner.inertia = inner.inertia + outer.inertia
            if joint.kind not in TURNING:
                continue
            place = places[joint.child]
            resists = _about_axis(outer, place.at, place.turn @ np.array(joint.axis))
            gives = flexibility.joints.get(joint.name, JointGives(0))
            rigid_gear = gives.stiffness is None
            held = rigid_gear and gives.rotor_inertia > 0.0
            if not held and resists <= _ROUNDING * float(np.trace(outer.inertia)):
                faults.add(
                    joint.line,
                    f"joint '{joint.name}'",
                    "carries nothing that has inertia about its axis",
                    "Give a link behind it an <inertial>, or the joint a rotor_inertia or `lock = 0.0` in a file given "
                    "by --flex.",
                )


def _about_axis(body: _Carried, at: Floats, axis: Floats) -> float:
    """Return the moment of inertia about an axis through a point, kg m^2."""
    arm = np.cross(axis, at)
    # of r x axis for every mass: about the origin, less what the axis lies away from it
    shift = 2.0 * float(np.cross(axis, body.moment) @ arm) - body.mass * float(arm @ arm)
    return float(axis @ body.inertia @ axis) - shift
