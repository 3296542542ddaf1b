"""Transfer matrices come out of the elements' equations as the thesis prints them."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements.torsion import DAMPING, INERTIA, JOINT, LINK, LOAD, STIFFNESS, TORQUE
from tmm_gen.derive.sweep.product import product_step
from tmm_gen.derive.sweep.riccati import riccati_step
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


def test_riccati_and_product_agree_with_a_direct_solution() -> None:
    """Two stations, clamped: both sweeps against SymPy's solution of all equations at once."""
    k, c, inertia, load = STIFFNESS, DAMPING, INERTIA, LOAD
    motions = [displacement(sp.Integer(0), sp.Integer(0)), displacement(B0, E0), displacement(B1, E1)]
    u1, u2, f1, f2 = sp.symbols("u1 u2 f1 f2")
    twist = lambda inner, outer, e_in, e_out: k * (outer - inner) + c * (D * (outer - inner) + e_out - e_in)  # noqa: E731
    direct = sp.solve(
        [
            f1 - twist(0, u1, 0, E0),
            f2 - twist(u1, u2, E0, E1),
            f2 - f1 - inertia * (A * u1 + B0),
            load - f2 - inertia * (A * u2 + B1),
        ],
        [u1, u2, f1, f2],
        dict=True,
    )[0]
    joints = [transfer_matrix(JOINT, [motions[i]], [motions[i + 1]]) for i in range(2)]
    links = [transfer_matrix(LINK, [motions[i + 1]], [motions[i + 1]]) for i in range(2)]
    # inward: at the tip f = load
    impedance, bias = sp.zeros(1, 1), sp.Matrix([[load]])
    steps = []
    for joint, link in reversed(list(zip(joints, links, strict=True))):
        at_link = riccati_step(link, impedance, bias)
        at_joint = riccati_step(joint, at_link.impedance, at_link.bias)
        steps.append(at_joint)
        impedance, bias = at_joint.impedance, at_joint.bias
    first, second = reversed(steps)
    swept = first.offset[0]
    assert sp.simplify(swept - direct[u1]) == 0
    assert sp.simplify(second.gain[0] * swept + second.offset[0] - direct[u2]) == 0
    assert sp.simplify(bias[0] - direct[f1]) == 0
    # outward: the unknown is the force at the base
    columns = (sp.zeros(1, 1), sp.eye(1), sp.zeros(1, 1), sp.zeros(1, 1))
    for element in (joints[0], links[0], joints[1], links[1]):
        step = product_step(element, *columns)
        columns = (step.motion_gain, step.force_gain, step.motion_known, step.force_known)
    base = (load - columns[3][0]) / columns[1][0]
    assert sp.simplify(base - direct[f1]) == 0
    assert sp.simplify(columns[0][0] * base + columns[2][0] - direct[u2]) == 0
