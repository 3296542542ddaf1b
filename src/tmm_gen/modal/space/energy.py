"""An equilibrium, or modes, only where what acts has an energy."""

from __future__ import annotations

from tmm_gen.errors import UserError
from tmm_gen.modal.space.still import Still


def require_energy(still: Still, name: str) -> Still:
    """Return a rest about which what acts has an energy.

    Parameters
    ----------
    still : Still
        Where an arm rests.
    name : str
        Of the scene.

    Raises
    ------
    UserError
        If a held load turns with its body, or is a moment that does work around a small loop.
    """
    if still.conservative:
        return still
    held = ", ".join(load.column for load in still.loads)
    raise UserError(
        f"scene '{name}': what --input holds at {held} turns with the arm, or is a moment that has no energy, so that "
        "neither its rest nor its small motion can be judged by stiffness. Hold the arm by torques of its motors, or by "
        'forces with in = "world".'
    )
