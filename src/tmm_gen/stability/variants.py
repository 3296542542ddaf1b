"""The same scene with another integrator, and with joints that are stiffer or softer by a factor."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.derive.integrators.analysis import is_explicit
from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.scene import Scene
from tmm_gen.scene.integrator import Integrator as Named


def with_integrator(scene: Scene, method: Integrator) -> Scene:
    """Return a scene with an integrator and its parameters, solved for accelerations if that is explicit."""
    named = Named(
        method.name, scene.integrator.step, {name: float(value) for name, value in method.parameters.items()}
    )
    changed = replace(scene, integrator=named)
    if any(is_explicit(scheme) for scheme in method.schemes):
        changed = replace(changed, model=scene.model.model_copy(update={"unknown": "acceleration"}))
    return changed


def with_stiffness(scene: Scene, factor: float) -> Scene:
    """Return a scene whose joints are stiffer by a factor; their damping stays."""
    if scene.spatial is not None:
        revolutes = tuple(
            replace(joint, stiffness=joint.stiffness * factor) for joint in scene.spatial.joints
        )
        return replace(scene, spatial=replace(scene.spatial, joints=revolutes))
    joints = tuple(joint.model_copy(update={"stiffness": joint.stiffness * factor}) for joint in scene.joints)
    return replace(scene, joints=joints)
