"""From a scene to its program: choose the integrator, then the builder of the scene's kind."""

from __future__ import annotations

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import UnsuitableUnknownError
from tmm_gen.errors import UserError
from tmm_gen.program.planar.build import build_planar
from tmm_gen.program.statements import Program
from tmm_gen.program.torsion.build import build_chain
from tmm_gen.program.torsion.rounding import require_digits
from tmm_gen.program.torsion.safety import require_safe_product
from tmm_gen.scene import Scene


def build_program(scene: Scene, *, auto: bool = False) -> Program:
    """Build the program of a scene.

    Parameters
    ----------
    scene : Scene
        What to build.
    auto : bool
        Whether the steps of a planar arm sweep as often as it takes: for simulations, not for controllers.

    Raises
    ------
    UserError
        If the scene asks for something that does not exist: a planar product sweep, a
        product over more stations than it is safe for, an unknown (displacement,
        increment) that an explicit integrator cannot be solved for, or a step of which
        rounding leaves too few digits.
    """
    chosen = integrator(scene.integrator.name, **scene.integrator.parameters)
    try:
        if scene.model.kind == "chain":
            require_safe_product(scene, chosen)
            require_digits(scene, chosen)
            return build_chain(scene, chosen)
        _refuse_unsupported(scene)
        return build_planar(scene, chosen, auto=auto)
    except UnsuitableUnknownError as error:
        raise UserError(
            f"scene '{scene.name}': model.unknown = '{scene.model.unknown}' with model.sweep = "
            f"'{scene.model.sweep}' and integrator '{scene.integrator.name}': {error}"
        ) from error


def _refuse_unsupported(scene: Scene) -> None:
    if scene.model.sweep != "riccati":
        raise UserError(
            f"scene '{scene.name}': model.sweep = '{scene.model.sweep}' multiplies transfer matrices, which loses "
            "all digits in a planar arm; use sweep = 'riccati'"
        )
