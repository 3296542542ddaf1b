"""The continuous beam as an element ``[w, psi | M, V]``, derived from its differential equations.

Along a uniform beam, ``x`` from the inboard to the outboard end, ``M`` and ``V`` what the outer side exerts
on the inner one (Timoshenko 1921, Phil. Mag. 41; Pestel & Leckie 1963, *Matrix Methods in Elastomechanics*,
ch. 5):

    w' = psi + V / (kappa G A)        psi' = M / (E I)
    V' = rho A w''_t                  M' = rho I psi''_t - V

Without shear compliance and rotary inertia it is the beam of Euler and Bernoulli. Lengths are in units of the
beam's length ``L``, torques in ``E I / L``, forces in ``E I / L^2``; time enters by ``p = rho A L^4 s^2 / (E
I)`` alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

POSITION = sp.Symbol("xi", real=True)
FREQUENCY = sp.Symbol("p")
"""``rho A L^4 s^2 / (E I)``; at ``s = j omega`` it is ``-(beta L)^4`` of Euler and Bernoulli."""

ROTARY = sp.Symbol("r2", nonnegative=True)
"""Rotary inertia ``I / (A L^2)``, the radius of gyration over the length, squared."""

SHEAR = sp.Symbol("sigma2", nonnegative=True)
"""Shear compliance ``E I / (kappa G A L^2)``."""

WAVE = sp.Symbol("kappa")
"""Wave number of a solution ``exp(kappa xi)``."""

STATE = ("w", "psi", "M", "V")


def equations() -> tuple[sp.Eq, ...]:
    """Return the beam's four differential equations in the Laplace domain, dimensionless."""
    w, psi, moment, shear = (sp.Function(name)(POSITION) for name in STATE)
    return (
        sp.Eq(sp.diff(w, POSITION), psi + SHEAR * shear),
        sp.Eq(sp.diff(psi, POSITION), moment),
        sp.Eq(sp.diff(moment, POSITION), ROTARY * FREQUENCY * psi - shear),
        sp.Eq(sp.diff(shear, POSITION), FREQUENCY * w),
    )


@cache
def system_matrix() -> sp.Matrix:
    """Return ``A`` in ``z' = A z``, read off the differential equations."""
    state = [sp.Function(name)(POSITION) for name in STATE]
    names = sp.symbols("w psi M V")
    named = dict(zip(state, names, strict=True))
    right = sp.Matrix([equation.rhs.subs(named) for equation in equations()])
    return right.jacobian(names)


@dataclass(frozen=True)
class Waves:
    """The four solutions ``z = shape(kappa) exp(kappa xi)``.

    Parameters
    ----------
    squares : tuple of 2 sympy.Expr
        The two values of ``kappa^2``; the solutions have both signs of each root.
    shape : sympy.Matrix
        (4, 1), by ``WAVE`` and ``FREQUENCY``, scaled so that ``w = 1``.
    discriminant : sympy.Expr
        Of the biquadratic equation; the squares are ``(sum +- sqrt(discriminant)) / 2``.
    """

    squares: tuple[sp.Expr, sp.Expr]
    shape: sp.Matrix
    discriminant: sp.Expr


@cache
def waves() -> Waves:
    """Solve the differential equations by exponentials.

    Raises
    ------
    ArithmeticError
        If the characteristic equation is not biquadratic.
    """
    matrix = system_matrix()
    characteristic = sp.Poly((matrix - WAVE * sp.eye(4)).det(), WAVE)
    leading, third, second, first, last = characteristic.all_coeffs()
    if third != 0 or first != 0:
        raise ArithmeticError("a uniform beam is the same from both ends: odd powers should vanish")
    discriminant = sp.expand(second**2 - 4 * leading * last)
    root = sp.sqrt(discriminant)
    squares = tuple(sp.expand((-second + sign * root) / (2 * leading)) for sign in (1, -1))
    shape = sp.Matrix(sp.symbols("one psi M V"))
    unknown = list(shape[1:])
    kept = (matrix - WAVE * sp.eye(4)) * shape
    # three of the four rows; the fourth holds by the choice of kappa. That of psi' is left to M, that of V'
    # to V.
    solved = sp.solve([kept[0], kept[1], kept[3]], unknown, dict=True)[0]
    values = {shape[0]: sp.Integer(1)}
    return Waves(
        squares=squares,
        shape=sp.Matrix([1, *(sp.simplify(solved[name].subs(values)) for name in unknown)]),
        discriminant=discriminant,
    )
