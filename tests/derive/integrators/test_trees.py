from __future__ import annotations

import pytest
import sympy as sp

from tmm_gen.derive.integrators.dirk import dirk_scheme, tableau
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.trees import density, rooted_trees, size, tableau_order


def test_counts_are_those_of_rooted_trees() -> None:
    """A000081."""
    assert [len(rooted_trees(nodes)) for nodes in range(1, 8)] == [1, 1, 2, 4, 9, 20, 48]
    assert all(size(tree) == 6 for tree in rooted_trees(6))
    assert len(set(rooted_trees(6))) == 20


def test_densities_of_order_four() -> None:
    """Butcher (2016), section 301."""
    assert sorted(density(tree) for tree in rooted_trees(4)) == [4, 8, 12, 24]


def test_known_methods() -> None:
    half = sp.S.Half
    assert tableau_order(tableau([[1]])) == 1
    assert tableau_order(tableau([[half]], weights=[1])) == 2
    root = sp.sqrt(3) / 6
    gamma = half + root
    assert tableau_order(tableau([[gamma], [1 - 2 * gamma, gamma]], weights=[half, half])) == 3
    weights = [sp.S.One / 6, sp.S.One / 3, sp.S.One / 3, sp.S.One / 6]
    assert tableau_order(tableau([[0], [half, 0], [0, half, 0], [0, 0, 1, 0]], weights)) == 4


def test_declared_tableaux() -> None:
    for name, expected in (("sdirk2", 2), ("sdirk4", 4)):
        table = integrator(name).tableau
        assert table is not None
        assert tableau_order(table) == expected
        diagonal = {table.matrix[i, i] for i in range(table.matrix.rows)}
        assert len(diagonal) == 1
        assert sp.radsimp(table.nodes[len(table.nodes) - 1]) == 1


def test_tableaux_that_end_between_stages_are_refused() -> None:
    with pytest.raises(ValueError, match="stiffly accurate"):
        dirk_scheme(tableau([[sp.S.Half]], weights=[1]))
