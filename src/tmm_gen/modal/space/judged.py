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


def require_numbers(still: Still, name: str) -> Still:
    """Return an arm held still of which all numbers are numbers.

    Parameters
    ----------
    still : Still
        Wherever an arm is.
    name : str
        Of the scene.

    Raises
    ------
    UserError
        If one overflows.
    """
    found = (still.mass, still.geometric, still.scale, still.numbers.damping)
    if not all(np.all(np.isfinite(each)) for each in found):
        raise UserError(
            f"scene '{name}': the arm's masses, lengths or forces leave the range of numbers. Look for one that is far "
            "too large."
        )
    return still


def require_inertia(still: Still, name: str) -> Still:
    """Return a rest about which all numbers are numbers, and every joint turns something.

    Parameters
    ----------
    still : Still
        Where an arm rests.
    name : str
        Of the scene.

    Raises
    ------
    UserError
        If numbers overflow, or rounding leaves nothing of some joint's inertia.
    """
    try:
        np.linalg.cholesky(require_numbers(still, name).mass)
    except np.linalg.LinAlgError:
        raise UserError(
            f"scene '{name}': the arm's masses lie too far apart for double precision, so that some joint seems to "
            "turn nothing. Look for a mass, inertia or rotor that is far too small or large."
        ) from None
    return still
