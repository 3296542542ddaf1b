r"""The Riccati sweep, from any element's blocks.

Outboard of an element let ``f = S k + e`` (at a free tip ``S = 0, e = 0``). With
``k_out = U11 k + U12 f + u1`` and ``f_out = U21 k + U22 f + u2`` the same form holds inboard,

.. math:: f = (U_{22} - S U_{12})^{-1} [(S U_{11} - U_{21}) k + S u_1 + e - u_2],

and the outboard unknowns follow from the inboard ones (Horner & Pilkey 1978).
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.transfer import TransferMatrix


@dataclass(frozen=True)
class RiccatiStep:
    """One element of the sweep.

    Parameters
    ----------
    impedance, bias : sympy.Matrix
        Inboard ``S`` and ``e``.
    gain, offset : sympy.Matrix
        ``k_out = gain k_in + offset``.
    """

    impedance: sp.Matrix
    bias: sp.Matrix
    gain: sp.Matrix
    offset: sp.Matrix


def riccati_step(matrix: TransferMatrix, impedance: sp.Matrix, bias: sp.Matrix) -> RiccatiStep:
    """Carry ``f = S k + e`` from the outboard to the inboard side of an element.

    Common factors are cancelled, so that a joint without impedance (explicit methods) is no singularity.
    """
    inverse = (matrix.U22 - impedance * matrix.U12).inv()
    inner_impedance = inverse * (impedance * matrix.U11 - matrix.U21)
    inner_bias = inverse * (impedance * matrix.u1 + bias - matrix.u2)
    gain = matrix.U11 + matrix.U12 * inner_impedance
    offset = matrix.U12 * inner_bias + matrix.u1
    return RiccatiStep(*(m.applyfunc(sp.cancel) for m in (inner_impedance, inner_bias, gain, offset)))
