"""From a scene to its program: choose the integrator, then the builder of the scene's kind."""

from __future__ import annotations

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import UnsuitableUnknownError
from tmm_gen.errors import UserError
from tmm_gen.program.statements import Program
from tmm_gen.program.torsion import build_chain
from tmm_gen.scene import Scene


def build_program(scene: Scene) -> Program:
    """Build the program of a scene.

    Raises
    ------
    UserError
        If the scene asks for something that does not exist: an unsupported kind, or an unknown (displacement,
        increment) that an explicit integrator cannot be solved for.
    """
    chosen = integrator(scene.integrator.name, **scene.integrator.parameters)
    if scene.model.kind != "chain":
        raise UserError(
            f"scene '{scene.name}': model.kind = '{scene.model.kind}' is not supported yet; use 'chain'"
        )
    try:
        return build_chain(scene, chosen)
    except UnsuitableUnknownError as error:
        raise UserError(
            f"scene '{scene.name}': model.unknown = '{scene.model.unknown}' with model.sweep = '{scene.model.sweep}' "
            f"and integrator '{scene.integrator.name}': {error}"
        ) from error
