"""Collocation: fully implicit Runge-Kutta methods, declared by their abscissae alone."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import sympy as sp

from tmm_gen.derive.integrators.declaration import (
    STEP,
    Integrator,
    Kind,
    Scheme,
    Stage,
    Tableau,
    end_of_step,
    past,
    stage,
)

h = STEP
TIME = sp.Symbol("tau", real=True)
"""Time since the start of the step, in steps."""


@cache
def gauss_nodes(stages: int) -> tuple[sp.Expr, ...]:
    """Return the abscissae of Gauss: zeros of Legendre's polynomial on the step."""
    return _zeros(sp.diff((TIME * (TIME - 1)) ** stages, (TIME, stages)))


@cache
def radau_nodes(stages: int) -> tuple[sp.Expr, ...]:
    """Return the right abscissae of Radau (IIA): the last stands at the end of the step."""
    return _zeros(sp.diff(TIME ** (stages - 1) * (TIME - 1) ** stages, (TIME, stages - 1)))


@cache
def lagrange(nodes: tuple[sp.Expr, ...]) -> list[sp.Expr]:
    """Return the polynomials in ``TIME`` that are 1 at one node and 0 at the others."""
    found = []
    for i, node in enumerate(nodes):
        others = [c for k, c in enumerate(nodes) if k != i]
        found.append(_simple(sp.prod((TIME - c) / (node - c) for c in others)))
    return found


@cache
def collocation_table(nodes: tuple[sp.Expr, ...]) -> Tableau:
    """Return the tableau whose stages lie on the polynomial that meets the equations at all nodes.

    Raises
    ------
    ValueError
        If two nodes are one.
    """
    if len(set(nodes)) < len(nodes):
        raise ValueError(f"no two nodes may be the same: {nodes}")
    integrals = [sp.integrate(polynomial, TIME) for polynomial in lagrange(nodes)]
    matrix = sp.Matrix([[_simple(integral.subs(TIME, c)) for integral in integrals] for c in nodes])
    weights = sp.Matrix([[_simple(integral.subs(TIME, 1)) for integral in integrals]])
    return Tableau(matrix.as_immutable(), weights.as_immutable(), sp.ImmutableMatrix(list(nodes)))


def coupled_scheme(table: Tableau) -> Scheme:
    """Turn a full tableau into stages, each of which reads all others.

    Where no stage stands at the end of the step, the acceleration there is that of the polynomial through the stages.
    """
    size = table.matrix.rows
    stages = []
    for i in range(size):
        place = sp.Add(*(table.matrix[i, j] * stage("v", j + 1) for j in range(size)))
        speed = sp.Add(*(table.matrix[i, j] * stage("a", j + 1) for j in range(size)))
        relations = (past("q") + h * place - stage("q", i + 1), past("v") + h * speed - stage("v", i + 1))
        stages.append(Stage(table.nodes[i], relations))
    if table.nodes[size - 1] == 1:
        return Scheme(tuple(stages), end_of_step(size))
    at_end = [_simple(polynomial.subs(TIME, 1)) for polynomial in lagrange(tuple(table.nodes))]

    def summed(kind: Kind, weights: Sequence[sp.Expr]) -> sp.Expr:
        return sp.Add(*(weight * stage(kind, j + 1) for j, weight in enumerate(weights)))

    update: dict[Kind, sp.Expr] = {
        "q": past("q") + h * summed("v", table.weights),
        "v": past("v") + h * summed("a", table.weights),
        "a": summed("a", at_end),
    }
    return Scheme(tuple(stages), update)


def collocated(name: str, title: str, source: str, nodes: Sequence[sp.Expr]) -> Integrator:
    """Return the collocation method of some abscissae.

    Parameters
    ----------
    name, title, source : str
        As of any integrator.
    nodes : sequence of sympy.Expr
        From 0 to 1, in order; exact numbers.
    """
    table, scheme = _declared(tuple(nodes))
    return Integrator(name=name, title=title, source=source, main=scheme, tableau=table)


@cache
def _declared(nodes: tuple[sp.Expr, ...]) -> tuple[Tableau, Scheme]:
    """Return tableau and scheme, the same ones each time: what is derived from them is remembered with them."""
    table = collocation_table(nodes)
    return table, coupled_scheme(table)


def _zeros(polynomial: sp.Expr) -> tuple[sp.Expr, ...]:
    found = sp.roots(sp.Poly(sp.expand(polynomial), TIME), multiple=True)
    return tuple(sorted((_simple(root) for root in found), key=lambda root: root.evalf(50)))


def _simple(value: sp.Expr) -> sp.Expr:
    """Write a value without roots in denominators, so that equal ones look alike."""
    return sp.expand(sp.radsimp(sp.expand(value)))
