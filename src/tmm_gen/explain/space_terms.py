"""Terms an arm in space may have or not, and the same scene with each put in or taken out."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from tmm_gen.explain.terms import Term
from tmm_gen.program.space.gears import shafts_of
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import ZERO, SpatialArm, Vector

_DOWN: Vector = (0.0, 0.0, -9.81)
_MORE = 1e-3


def space_terms(scene: Scene, arm: SpatialArm) -> list[Term]:
    """Return the terms of an arm in space, in the order of its file."""
    slopes = [] if scene.coupled else [_linearisation(scene)]  # stages solved at once have one form
    return [_gravity(arm), _rounds(scene), *slopes, _damping(arm), _rotors(arm)]


def _gravity(arm: SpatialArm) -> Term:
    falls = any(arm.gravity)
    why = f"model.gravity = {[*arm.gravity]}" if falls else "no model.gravity"
    return Term("gravity", falls, why, lambda s: _with_arm(s, gravity=ZERO if falls else _DOWN))


def _rounds(scene: Scene) -> Term:
    """Return what is done beyond the first sweep: one round of it, or one that could be."""
    count = scene.model.sweeps
    word = "sweep" if scene.model.linearisation == "newton" else "correction"
    changed = count - 1 if count > 1 else 2
    rounds = count - 1
    why = f"model.iterations = {count}: {rounds} {word}{'s' * (rounds != 1)} behind the first sweep"
    return Term(
        f"{'the last' if count > 1 else 'a'} {word} in each stage",
        count > 1,
        why,
        lambda s: _with_model(s, iterations=changed),
    )


def _linearisation(scene: Scene) -> Term:
    """Return all slopes in as many sweeps."""
    newton = scene.model.linearisation == "newton"
    why = f'model.linearisation = "{scene.model.linearisation}"'
    other = "inertial" if newton else "newton"
    return Term("slopes by angles and rates", newton, why, lambda s: _with_model(s, linearisation=other))


def _damping(arm: SpatialArm) -> Term:
    damped = sum(joint.damping > 0.0 for joint in arm.joints)
    why = f"{damped} of {_moving(arm)} joints have a damper" if damped else "no joint has damping"
    return Term("joint damping", damped > 0, why, lambda s: _with_damping(s, 0.0 if damped else _MORE))


def _rotors(arm: SpatialArm) -> Term:
    others = _rigidly_driven(arm)
    rotors = sum(arm.joints[k].armature > 0.0 for k in others)
    behind = ", elastic gears aside" if len(others) < _moving(arm) else ""
    why = f"{rotors} of {_moving(arm)} joints have" if rotors else "no joint has"
    return Term(
        "rotors", rotors > 0, f"{why} a rotor{behind}", lambda s: _with_rotors(s, 0.0 if rotors else _MORE)
    )


def _with_damping(scene: Scene, value: float) -> Scene:
    assert scene.spatial is not None
    return _with_arm(
        scene, joints=tuple(j if j.given else replace(j, damping=value) for j in scene.spatial.joints)
    )


def _with_rotors(scene: Scene, value: float) -> Scene:
    assert scene.spatial is not None
    changed = _rigidly_driven(scene.spatial)
    joints = enumerate(scene.spatial.joints)
    return _with_arm(
        scene, joints=tuple(replace(j, armature=value) if k in changed else j for k, j in joints)
    )


def _rigidly_driven(arm: SpatialArm) -> list[int]:
    """Return the indices of joints that move by forces, without those of elastic gears, which need their rotors."""
    shafts = shafts_of(arm, frozenset())
    aside = shafts | {k + 1 for k in shafts}
    return [k for k, joint in enumerate(arm.joints) if not joint.given and k not in aside]


def _moving(arm: SpatialArm) -> int:
    """Return how many joints move by forces."""
    return sum(not joint.given for joint in arm.joints)


def _with_arm(scene: Scene, **update: Any) -> Scene:
    assert scene.spatial is not None
    return replace(scene, spatial=replace(scene.spatial, **update))


def _with_model(scene: Scene, **update: object) -> Scene:
    return replace(scene, model=scene.model.model_copy(update=update))
