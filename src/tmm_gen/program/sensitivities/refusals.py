"""Scenes whose step has no derivatives here."""

from __future__ import annotations

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.errors import UserError
from tmm_gen.row.row import Row
from tmm_gen.scene import Scene


def require_derivatives(scene: Scene, integrator: Integrator, row: Row) -> None:
    """Refuse a scene that asks for derivatives of a step that has none.

    Raises
    ------
    UserError
        If the step is not Newton's, needs other steps before it, or sums up energy.
    """
    what = f"scene '{scene.name}': emit.sensitivities = true"
    if scene.model.linearisation != "newton":
        raise UserError(
            f"{what} needs model.linearisation = 'newton', not '{scene.model.linearisation}', whose step is no "
            "iteration on the exact equations"
        )
    if integrator.startup:
        raise UserError(
            f"{what} needs an integrator without start-up steps, such as 'newmark', 'generalized_alpha', 'bathe' or "
            f"'sdirk4', not '{scene.integrator.name}'"
        )
    if row.counts_heat:
        raise UserError(f"{what} does not go with an output of dissipated energy; remove one of the two")
