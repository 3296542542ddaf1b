"""The plain product of transfer matrices in the frequency domain, kept to show what it loses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import LinearArm

Complex = NDArray[np.complex128]


def product_tip_motion(arm: LinearArm, s: Complex, number: int) -> Complex:
    """Return the tip's motion for a unit of one input, by multiplying all matrices.

    As the thesis does (Gholampour 2018, eqs. 2-82 to 2-94): what is unknown at the base follows from the free tip,
    the tip's motion from what was unknown. Where waves fade along the arm, as half of a beam's do at any frequency,
    both are differences of numbers that have grown along the product.

    Parameters
    ----------
    arm : LinearArm
        Its base not prescribed.
    s : array, (f,)
        Laplace variable, 1/s.
    number : int
        Of the input.

    Returns
    -------
    array, (f, width)
        What the rounding leaves of it; NaN where it overflows or nothing is left to divide by.

    Raises
    ------
    ValueError
        If the base is prescribed.
    """
    if arm.prescribed is not None:
        raise ValueError("the plain product is for a base that is clamped or free to turn")
    m = arm.width
    whole = np.broadcast_to(np.eye(2 * m + 1, dtype=complex), (len(s), 2 * m + 1, 2 * m + 1))
    unknown = [k if free else m + k for k, free in enumerate(arm.free)]
    motion = np.full((len(s), m), np.nan, complex)
    with np.errstate(all="ignore"):
        for placed in arm.elements:
            blocks = arm.functions(placed).blocks(s, placed.values)
            matrix = np.zeros((len(s), 2 * m + 1, 2 * m + 1), complex)
            matrix[:, :m, :m], matrix[:, :m, m : 2 * m] = blocks.U11, blocks.U12
            matrix[:, m : 2 * m, :m], matrix[:, m : 2 * m, m : 2 * m] = blocks.U21, blocks.U22
            matrix[:, 2 * m, 2 * m] = 1.0
            for which, load in placed.loads:
                if which == number:
                    matrix[:, m : 2 * m, 2 * m] += np.array(load)
            whole = matrix @ whole
        for k, each in enumerate(whole):
            if np.all(np.isfinite(each)):
                motion[k] = _tip(each, unknown, m)
    return motion


def _tip(whole: Complex, unknown: list[int], m: int) -> Complex:
    """Solve the free tip for what is unknown at the base, and return the tip's motion."""
    try:
        base = -np.linalg.solve(whole[m : 2 * m, unknown], whole[m : 2 * m, 2 * m])
    except np.linalg.LinAlgError:
        return np.full(m, np.nan, complex)
    found: Complex = whole[:m, unknown] @ base + whole[:m, 2 * m]
    return found
