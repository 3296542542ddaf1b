"""The plain product of transfer matrices (Gholampour 2018, eqs. 2-82, 3-19), kept because the thesis uses it.

It multiplies growing and decaying solutions together and loses their difference: digits vanish with every station.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.transfer import TransferMatrix


@dataclass(frozen=True)
class ProductStep:
    """One element of the product acting on ``k = K x + k0``, ``f = F x + f0`` with the base unknown ``x``.

    Parameters
    ----------
    motion_gain, force_gain : sympy.Matrix
        Outboard ``K`` and ``F``.
    motion_known, force_known : sympy.Matrix
        Outboard ``k0`` and ``f0``.
    """

    motion_gain: sp.Matrix
    force_gain: sp.Matrix
    motion_known: sp.Matrix
    force_known: sp.Matrix


def product_step(
    matrix: TransferMatrix,
    motion_gain: sp.Matrix,
    force_gain: sp.Matrix,
    motion_known: sp.Matrix,
    force_known: sp.Matrix,
) -> ProductStep:
    """Carry the state from the inboard to the outboard side of an element."""
    return ProductStep(
        motion_gain=matrix.U11 * motion_gain + matrix.U12 * force_gain,
        force_gain=matrix.U21 * motion_gain + matrix.U22 * force_gain,
        motion_known=matrix.U11 * motion_known + matrix.U12 * force_known + matrix.u1,
        force_known=matrix.U21 * motion_known + matrix.U22 * force_known + matrix.u2,
    )
