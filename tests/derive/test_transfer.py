"""Transfer matrices come out of the elements' equations as the thesis prints them."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements.torsion import DAMPING, INERTIA, JOINT, LINK, LOAD, STIFFNESS, TORQUE
from tmm_gen.derive.transfer import LAPLACE, DiscreteMotion, laplace_matrix, transfer_matrix

A, B0, B1, D, E0, E1 = sp.symbols("A B0 B1 D E0 E1")


def displacement(b: sp.Symbol, e: sp.Symbol) -> DiscreteMotion:
    """The thesis's choice: everything by the displacement (3-1, 3-2)."""
    one, zero = sp.Integer(1), sp.Integer(0)
    return DiscreteMotion({"q": one, "v": D, "a": A}, {"q": zero, "v": e, "a": b})


def test_laplace_matrices_are_those_of_the_thesis() -> None:
    s, k, c, inertia = LAPLACE, STIFFNESS, DAMPING, INERTIA
    assert sp.simplify(
        laplace_matrix(JOINT).full() - sp.Matrix([[1, 1 / (k + c * s), 0], [0, 1, 0], [0, 0, 1]])
    ) == (sp.zeros(3))  # 2-74
    assert laplace_matrix(LINK).full() == sp.Matrix([[1, 0, 0], [inertia * s**2, 1, 0], [0, 0, 1]])  # 2-73
    assert laplace_matrix(TORQUE).full() == sp.Matrix([[1, 0, 0], [0, 1, -LOAD], [0, 0, 1]])  # 2-75


def test_discrete_matrices_are_those_of_the_thesis() -> None:
    k, c, inertia = STIFFNESS, DAMPING, INERTIA
    joint = transfer_matrix(JOINT, [displacement(B0, E0)], [displacement(B1, E1)]).full()
    printed = sp.Matrix(
        [[1, 1 / (c * D + k), c * (E0 - E1) / (c * D + k)], [0, 1, 0], [0, 0, 1]]
    )  # 3-13, D_0 = D_1
    assert sp.simplify(joint - printed) == sp.zeros(3)
    link = transfer_matrix(LINK, [displacement(B1, E1)], [displacement(B1, E1)]).full()
    assert link == sp.Matrix([[1, 0, 0], [inertia * A, 1, inertia * B1], [0, 0, 1]])  # 3-17
