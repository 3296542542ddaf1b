"""The plain product of transfer matrices in the frequency domain, kept to show what it loses."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import LinearArm

Complex = NDArray[np.complex128]


def product_tip_response(arm: LinearArm, s: Complex, number: int) -> Complex:
    """Return the tip's angle of a clamped chain for a unit of one input, by multiplying all matrices.

    As the thesis does (Gholampour 2018, eqs. 2-82 to 2-94): the torque at the base follows from that at the
    free tip, the tip's angle from the torque at the base. Both are differences of numbers that grow along the
    chain.

    Parameters
    ----------
    arm : LinearArm
        A chain with a clamped base.
    s : array, (f,)
        Laplace variable, 1/s.
    number : int
        Of the input.

    Returns
    -------
    array, (f,)
        rad per N m; whatever the rounding leaves of it, and NaN where it overflows.

    Raises
    ------
    ValueError
        If the arm is not a clamped chain.
    """
    if arm.kind != "chain" or arm.hub or arm.prescribed is not None:
        raise ValueError("the plain product is for a clamped chain")
    whole = np.broadcast_to(np.eye(3, dtype=complex), (len(s), 3, 3))
    with np.errstate(all="ignore"):
        for placed in arm.elements:
            blocks = arm.functions(placed).blocks(s, placed.values)
            matrix = np.zeros((len(s), 3, 3), complex)
            matrix[:, :1, :1], matrix[:, :1, 1:2] = blocks.U11, blocks.U12
            matrix[:, 1:2, :1], matrix[:, 1:2, 1:2] = blocks.U21, blocks.U22
            matrix[:, 2, 2] = 1.0
            matrix[:, 1, 2] = sum(load[0] for which, load in placed.loads if which == number)
            whole = matrix @ whole
        base = -whole[:, 1, 2] / whole[:, 1, 1]
        tip: Complex = whole[:, 0, 1] * base + whole[:, 0, 2]
    return tip
