"""Conditions that change something of an arm: one that does not would only seem to have been tried."""

from __future__ import annotations

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.condition import CONDITIONS, Condition
from tmm_gen.control.plant.gears import rigid_gears
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene


def conditions_of(scene: Scene) -> tuple[Condition, ...]:
    """Return the conditions that a scene's controllers can be tried under: those that its arm differs in."""
    return tuple(case for case in CONDITIONS if _lacking(scene, case) is None)


def require_difference(scene: Scene, condition: Condition) -> None:
    """Refuse a condition that changes nothing of the arm of a scene.

    Raises
    ------
    UserError
        Saying what it would have to have.
    """
    lacking = _lacking(scene, condition)
    if lacking is not None:
        origin = scene.source.origin.partition(" (with ")[0]
        lack, remedy = lacking
        raise UserError(
            f"{origin}: {lack}, so that condition '{condition.name}' would change nothing. Leave out the "
            f"condition, or {remedy}."
        )


def _lacking(scene: Scene, condition: Condition) -> tuple[str, str] | None:
    """Return what an arm has not that a condition changes, and how a scene would say it."""
    if condition.payload != 1.0 and not any(arm_of(scene).payloads().values()):
        where = "[[body]] at the end of the arm" if scene.parts or scene.spatial else "[tip]"
        return "the arm carries no mass at its end", f"write `mass`, in kg, under a {where}"
    if condition.stiffness != 1.0 and not _gives_way(scene):
        return "nothing of the arm gives way", "write `stiffness` under a joint"
    if condition.twist and not rigid_gears(scene):
        return "no motor has a rigid gear other than 1", "write `gear` under a [[motor]] without `stiffness`"
    return None


def _gives_way(scene: Scene) -> bool:
    joints = scene.joints if scene.spatial is None else scene.spatial.joints
    return any(joint.stiffness > 0.0 for joint in joints)
