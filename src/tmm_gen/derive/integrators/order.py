"""Order of accuracy, exact, from the amplification matrix and, for Runge-Kutta methods, from the tableau.

A method has order p if, with exact data, displacement and velocity at a fixed time are right to ``O(h^p)``.
Three things must be: free motion ``exp(s w t)``, motion under a load ``exp(s w t)``, and the start-up.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import count
from math import factorial
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement

from tmm_gen.derive.integrators.amplification import OMEGA, ZETA, Amplification, amplification
from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Past
from tmm_gen.derive.integrators.trees import tableau_order

GROWTH = sp.Symbol("s")
"""Exponent of the test motion ``exp(s w t)``."""

Terms = list[tuple[PolyElement, sp.Expr]]
"""Summands ``coefficient * exp(rate * s * Omega)``, coefficients in the ring of ``Omega, zeta, s``."""


def order(integrator: Integrator, linear: Amplification | None = None) -> int:
    """Return the order of an integrator: the least of what each test yields.

    Parameters
    ----------
    integrator : Integrator
        All of whose parameters are numbers.
    linear : Amplification, optional
        That of its main scheme, if it has been derived already.
    """
    linear = linear or amplification(integrator.main)
    found = [free_order(linear), forced_order(linear), *startup_orders(integrator)]
    if integrator.tableau is not None:
        found.append(tableau_order(integrator.tableau))
    return min(found)


@lru_cache(maxsize=256)
def free_order(linear: Amplification) -> int:
    """Return the order for free motion of the damped oscillator.

    The exact eigenvalue ``exp(s Omega)``, with ``s^2 + 2 zeta s + 1 = 0``, leaves ``O(Omega^(p+2))`` in the
    characteristic polynomial, whose double root at ``Omega = 0`` takes the other two powers.
    """
    test = _TestMotion(linear)
    return test.lowest_power(test.insert(linear.characteristic), free=True) - 2


@lru_cache(maxsize=256)
def forced_order(linear: Amplification) -> int:
    """Return the order of displacement and velocity for the motion under a load ``exp(s w t)``."""
    test = _TestMotion(linear)
    denominator, numerators = linear.response
    orders = []
    for value, row in zip(linear.history, numerators, strict=True):
        if value.lag or value.kind == "a":
            continue
        residual = [(-test.size(value) * c, rate) for c, rate in test.insert(denominator)]
        for numerator, instant in zip(row, linear.instants, strict=True):
            residual += [(test.load * c, rate + instant) for c, rate in test.insert(numerator)]
        orders.append(test.lowest_power(residual) - 2 - KINDS.index(value.kind))
    return min(orders)


def startup_orders(integrator: Integrator) -> list[int]:
    """Return the orders to which each start-up step from exact data lets the solution be right.

    An error in the scaled history ``(q, h v)`` lasts and grows by ``1/h`` at most (the double eigenvalue 1),
    which takes one power.
    """
    orders = []
    for scheme in integrator.startup:
        linear = amplification(scheme)
        test = _TestMotion(linear)
        rows = [i for i, value in enumerate(linear.history) if value.lag == 0 and value.kind != "a"]
        orders += [test.lowest_power(test.error_after_step(row)) - 1 for row in rows]
    return orders


class _TestMotion:
    """The motion ``exp(s w t)`` of unit displacement, put into one step's polynomials."""

    def __init__(self, linear: Amplification) -> None:
        self.linear = linear
        self.numbers = sp.QQ.algebraic_field(*linear.roots.values()) if linear.roots else sp.QQ
        self.ring, self.omega, self.zeta, self.growth = sp.ring((OMEGA, ZETA, GROWTH), self.numbers)
        self.free = self.growth**2 + 2 * self.zeta * self.growth + 1
        # the load under which displacement is one, times h^2
        self.load = self.omega**2 * self.free

    def size(self, value: Past) -> PolyElement:
        """Return a component of the scaled history at its own instant."""
        return (self.growth * self.omega) ** KINDS.index(value.kind)

    def insert(self, polynomial: sp.Poly) -> Terms:
        """Insert ``LAMBDA = exp(s Omega)``."""
        by_power: dict[int, PolyElement] = {}
        for (k, a, b), c in polynomial.set_domain(self.numbers).rep.to_dict().items():
            by_power[k] = by_power.get(k, self.ring.zero) + c * self.omega**a * self.zeta**b
        return [(coefficient, sp.Integer(k)) for k, coefficient in by_power.items()]

    def error_after_step(self, row: int) -> Terms:
        """Return the error of one component after one step from the exact motion."""
        linear = self.linear
        width = len(linear.history)
        entries = [linear.matrix[row, j].element for j in range(width)]
        entries += [linear.forcing[row, i].element for i in range(len(linear.instants))]
        cleared = linear.cleared([[e] for e in [*entries, linear.matrix.domain.one]])
        *factors, clear = (self.insert(polynomial) for polynomial in cleared)
        before = [(self.size(p), sp.Integer(-p.lag)) for p in linear.history]
        loads = [(self.load, instant) for instant in linear.instants]
        error = [(-c * self.size(linear.history[row]), sp.Integer(1)) for c, _ in clear]
        for factor, (size, instant) in zip(factors, [*before, *loads], strict=True):
            error += [(c * size, instant) for c, _ in factor]
        return error

    def lowest_power(self, residual: Terms, free: bool = False) -> int:
        """Return the lowest power of ``Omega`` that does not vanish, for any motion or for free ones only."""
        parts: list[tuple[int, PolyElement, Any]] = []
        for coefficient, rate in residual:
            number = self.numbers.from_sympy(sp.expand(sp.radsimp(rate)))
            for (power, a, b), c in coefficient.terms():
                parts.append((power, c * self.zeta**a * self.growth**b, number))
        for m in count():
            total = self.ring.zero
            for power, part, rate in parts:
                if rate and power < m:
                    total += part * (self.growth * rate) ** (m - power) / factorial(m - power)
                elif power == m:
                    total += part
            if (total.rem(self.free) if free else total) != 0:
                return m
        raise AssertionError("unreachable")
