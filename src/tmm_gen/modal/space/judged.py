"""What must be so of an arm at rest before its small motion can be judged."""

from __future__ import annotations

import numpy as np

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
        f"scene '{name}': what --input holds at {held} turns with the arm, or is a moment that has no energy, so "
        "that neither its rest nor its small motion can be judged by stiffness. Hold the arm by torques of its motors, "
        'or by forces with in = "world".'
    )


def require_inertia(still: Still, name: str) -> Still:
    """Return a rest about which every joint turns something.

    Parameters
    ----------
    still : Still
        Where an arm rests.
    name : str
        Of the scene.

    Raises
    ------
    UserError
        If rounding leaves nothing of some joint's inertia.
    """
    try:
        np.linalg.cholesky(still.mass)
    except np.linalg.LinAlgError:
        raise UserError(
            f"scene '{name}': the arm's masses lie too far apart for double precision, so that some joint seems to "
            "turn nothing. Look for a mass, inertia or rotor that is far too small or large."
        ) from None
    return still
