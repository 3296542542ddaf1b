"""Forces of a rigid body by what does not change of it: mass, first moment and inertia, each times some motion.

A point of a body that turns accelerates by a matrix times its place, ``alpha x r + omega x (omega x r)``: six products
of rates and three angular accelerations make its nine entries. The first moment meets all of them, products of inertia
those off the diagonal again, so that force and moment share what momentum and angular momentum would each find anew.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive.space.declaration import ACCEL, ALPHA, AXES, OMEGA
from tmm_gen.derive.space.shared import spread
from tmm_gen.derive.space.sheet import Sheet

_PRODUCTS = {
    (i, j): sp.Symbol(f"product_{AXES[i]}{AXES[j]}", real=True) for i in range(3) for j in range(i, 3)
}
"""Products of two angular velocities."""


def by_constants(sheet: Sheet, forces: sp.Matrix, values: Mapping[sp.Symbol, sp.Expr]) -> sp.Matrix:
    """Return what a body takes, where what each of its constants is multiplied by has a name.

    Parameters
    ----------
    sheet : Sheet
        Receives the names.
    forces : sympy.Matrix
        By the symbols of motion: linear in accelerations, quadratic in the angular velocity.
    values : mapping from sympy.Symbol to sympy.Expr
        What those symbols stand for.
    """
    products = {
        symbol: sheet.named(
            symbol.name, values[OMEGA[i]] * values[OMEGA[j]], "of angular velocities", "rad^2/s^2"
        )
        for (i, j), symbol in _PRODUCTS.items()
    }
    there = {**values, **products}
    return forces.applyfunc(lambda force: _collected(sheet, _with_products(force), there))


def _with_products(force: sp.Expr) -> sp.Expr:
    """Return a force with symbols for the products of two angular velocities."""
    found = force.xreplace(dict.fromkeys(OMEGA, sp.Integer(0)))
    for (i, j), product in _PRODUCTS.items():
        found += sp.diff(force, OMEGA[i], OMEGA[j]) * product / (2 if i == j else 1)
    return sp.expand(found)


def _collected(sheet: Sheet, force: sp.Expr, values: Mapping[sp.Symbol, sp.Expr]) -> sp.Expr:
    motion = {*ALPHA, *ACCEL, *_PRODUCTS.values()}
    shared: dict[sp.Expr, sp.Expr] = {}
    for constant in sorted(force.free_symbols - motion, key=str):
        by = sp.diff(force, constant)
        sign = -1 if by.could_extract_minus_sign() else 1
        shared[sign * by] = shared.get(sign * by, sp.Integer(0)) + sign * constant
    found = sp.Integer(0)
    for by, constant in shared.items():
        name = "turning_" + "_".join(sorted(s.name.removeprefix("product_") for s in by.free_symbols))
        moved = sheet.named(name, by.xreplace(dict(values)), "of points of the body", "rad/s^2")
        found += (spread(sheet, constant) if constant.is_Add else constant) * moved
    return found
