"""Order conditions of Runge-Kutta methods over rooted trees."""

from __future__ import annotations

from functools import cache
from itertools import combinations_with_replacement

import sympy as sp

from tmm_gen.derive.integrators.declaration import Tableau

Tree = tuple["Tree", ...]
"""A rooted tree: the subtrees at its root, sorted."""

_HIGHEST = 6


@cache
def rooted_trees(nodes: int) -> tuple[Tree, ...]:
    """Return all rooted trees with a number of nodes."""
    return tuple(sorted(_forests(nodes - 1, nodes - 1)))


@cache
def _forests(nodes: int, largest: int) -> tuple[Tree, ...]:
    """Return all multisets of trees with ``nodes`` nodes together, none of more than ``largest``."""
    if nodes == 0:
        return ((),)
    found: list[Tree] = []
    for size in range(min(nodes, largest), 0, -1):
        for repeat in range(1, nodes // size + 1):
            for chosen in combinations_with_replacement(rooted_trees(size), repeat):
                found += [
                    tuple(sorted((*chosen, *rest))) for rest in _forests(nodes - size * repeat, size - 1)
                ]
    return tuple(found)


def size(tree: Tree) -> int:
    """Return the number of nodes."""
    return 1 + sum(size(child) for child in tree)


def density(tree: Tree) -> int:
    """Return the density of a tree: the product of the sizes of all its subtrees."""
    product = size(tree)
    for child in tree:
        product *= density(child)
    return product


def tableau_order(table: Tableau) -> int:
    """Return the order of a Runge-Kutta method for any smooth equation.

    References
    ----------
    J. C. Butcher, Numerical Methods for Ordinary Differential Equations, 3rd ed. (2016), theorem 315A.
    """
    for order in range(1, _HIGHEST + 1):
        for tree in rooted_trees(order):
            weight = (table.weights * _branches(tree, table))[0]
            if sp.expand(sp.radsimp(sp.expand(weight - sp.Rational(1, density(tree))))) != 0:
                return order - 1
    return _HIGHEST


def _branches(tree: Tree, table: Tableau) -> sp.Matrix:
    """Return, for each stage, the product over the root's children of what the tableau makes of them."""
    product = sp.ones(table.matrix.rows, 1)
    for child in tree:
        product = product.multiply_elementwise(table.matrix * _branches(child, table))
    return product.applyfunc(sp.expand)
