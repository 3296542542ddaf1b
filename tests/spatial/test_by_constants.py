"""What a body takes, collected by its constants, is what Kirchhoff's equations say."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.by_constants import by_constants
from tmm_gen.derive.space.declaration import ACCEL, ALPHA, FIRST_MOMENT, INERTIA, MASS, OMEGA, rigid_body
from tmm_gen.derive.space.equations import body_equations
from tmm_gen.derive.space.sheet import Sheet


def test_it_is_the_same_and_shares_what_force_and_moment_need() -> None:
    body = body_equations(rigid_body(MASS, FIRST_MOMENT, INERTIA))
    forces = sp.Matrix.vstack(body.force + OMEGA.cross(body.momentum), body.moment + OMEGA.cross(body.spin))
    sheet = Sheet()
    found = by_constants(sheet, forces, {s: s for s in (*OMEGA, *ALPHA, *ACCEL)})
    # six products, six entries off the diagonal, three on it, three differences of these; three differences of inertias
    assert len(sheet.lets) == 6 + 6 + 3 + 3 + 3
    for let in reversed(sheet.lets):
        found = found.xreplace({let.symbol: let.value})
    assert (found - forces).expand() == sp.zeros(6, 1)
