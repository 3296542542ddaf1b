"""Scenes whose step has no derivatives here."""

from __future__ import annotations

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.errors import UserError
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.scene import Scene


def require_derivatives(scene: Scene, integrator: Integrator, layout: PlanarLayout | None = None) -> None:
    """Refuse a scene that asks for derivatives of a step that has none.

    Parameters
    ----------
    layout : PlanarLayout, optional
        Of a planar arm.

    Raises
    ------
    UserError
        If the step is not Newton's, needs other steps before it, or sums up energy.
    """
    what = f"scene '{scene.name}': emit.sensitivities = true"
    if layout is not None and scene.model.linearisation != "newton":
        raise UserError(
            f"{what} needs model.linearisation = 'newton', not '{scene.model.linearisation}', whose step is no "
            "iteration on the exact equations"
        )
    if integrator.startup:
        raise UserError(
            f"{what} needs an integrator without start-up steps, such as 'newmark', 'generalized_alpha', 'bathe' or "
            f"'sdirk4', not '{scene.integrator.name}'"
        )
    if layout is not None and layout.dissipated is not None:
        raise UserError(f"{what} does not go with an output of dissipated energy; remove one of the two")
