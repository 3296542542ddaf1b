"""Transfer functions of small torsional chains as rational functions of ``s``, from the elements' matrices.

The system matrix is the product of the elements' matrices in the Laplace domain; the boundary conditions
leave one linear equation for what is unknown at the base (Gholampour 2018, eqs. 2-82 to 2-94). With letters
for numbers this is exact; with numbers and many stations it is not the way (see :mod:`tmm_gen.modal`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.torsion import (
    DAMPING,
    GROUND_DAMPER,
    GROUND_DAMPING,
    INERTIA,
    JOINT,
    LINK,
    LOAD,
    STIFFNESS,
    TORQUE,
)
from tmm_gen.derive.transfer import LAPLACE, laplace_matrix


@dataclass(frozen=True)
class SymbolicChain:
    """A chain whose base is clamped, or free to turn with a hub.

    Parameters
    ----------
    stiffness, damping, inertia : sequence of sympy.Expr
        One for each station, base to tip.
    hub_inertia, hub_damping : sympy.Expr, optional
        Of a motor's hub; a clamp where the inertia is None.
    """

    stiffness: Sequence[sp.Expr]
    damping: Sequence[sp.Expr]
    inertia: Sequence[sp.Expr]
    hub_inertia: sp.Expr | None = None
    hub_damping: sp.Expr = sp.S.Zero

    @property
    def stations(self) -> int:
        """Number of links."""
        return len(self.inertia)


@dataclass(frozen=True)
class TransferFunctions:
    """The answer of a chain to one torque.

    Parameters
    ----------
    numerators : tuple of sympy.Poly
        Of each station's angle, base (of a hub) or link 1 first, in ``s``.
    denominator : sympy.Poly
        Common; its roots are the poles.
    """

    numerators: tuple[sp.Poly, ...]
    denominator: sp.Poly

    def function(self, station: int) -> sp.Expr:
        """Return angle over torque of a station, from 0."""
        return self.numerators[station].as_expr() / self.denominator.as_expr()


def numbered_chain(stations: int, *, hub: bool = False) -> SymbolicChain:
    """Return a chain with letters ``k_1, c_1, I_1, k_2, ...`` for numbers, and ``J, b`` for a hub."""
    k, c, inertia = (
        [sp.Symbol(f"{name}_{i + 1}", positive=True) for i in range(stations)] for name in ("k", "c", "I")
    )
    if not hub:
        return SymbolicChain(k, c, inertia)
    return SymbolicChain(k, c, inertia, sp.Symbol("J", positive=True), sp.Symbol("b", nonnegative=True))


def element_matrix(element: Element, values: dict[sp.Symbol, sp.Expr]) -> sp.Matrix:
    """Return an element's extended matrix in the Laplace domain with its parameters replaced, (3, 3)."""
    return laplace_matrix(element).full().subs(values)


def station_matrices(chain: SymbolicChain, loaded: int) -> list[list[sp.Matrix]]:
    """Return the matrices of the hub (if any) and of each station, base to tip, in the order they are passed.

    Parameters
    ----------
    chain : SymbolicChain
        The chain.
    loaded : int
        The station the unit torque acts on: 1 to n, 0 for the hub.
    """
    torque = element_matrix(TORQUE, {LOAD: sp.Integer(1)})
    found = []
    if chain.hub_inertia is not None:
        hub = [
            element_matrix(GROUND_DAMPER, {GROUND_DAMPING: chain.hub_damping}),
            element_matrix(LINK, {INERTIA: chain.hub_inertia}),
        ]
        found.append([*hub, torque] if loaded == 0 else hub)
    for i in range(chain.stations):
        passed = [
            element_matrix(JOINT, {STIFFNESS: chain.stiffness[i], DAMPING: chain.damping[i]}),
            element_matrix(LINK, {INERTIA: chain.inertia[i]}),
        ]
        found.append([*passed, torque] if loaded == i + 1 else passed)
    return found


def system_matrix(chain: SymbolicChain, loaded: int) -> sp.Matrix:
    """Return the product of all matrices, (3, 3), acting on ``[theta, tau, 1]`` at the base."""
    return _products(station_matrices(chain, loaded))[-1].to_Matrix()


def transfer_functions(chain: SymbolicChain, loaded: int) -> TransferFunctions:
    """Return every station's angle over a torque on one station.

    Parameters
    ----------
    chain : SymbolicChain
        With a handful of stations.
    loaded : int
        1 to n, 0 for the hub.

    Raises
    ------
    ValueError
        If the torque acts where nothing can move.
    """
    hub = chain.hub_inertia is not None
    if not (0 if hub else 1) <= loaded <= chain.stations:
        raise ValueError(f"a torque cannot act on station {loaded} of {chain.stations}")
    products = _products(station_matrices(chain, loaded))
    # the tip is free: row 2 of the system matrix; at the base the torque is unknown (clamp) or the angle
    # (hub)
    unknown = 0 if hub else 1
    whole = products[-1]
    base = -whole[1, 2].element / whole[1, unknown].element
    angles = [matrix[0, unknown].element * base + matrix[0, 2].element for matrix in products]
    denominator = reduce(lambda one, other: one.lcm(other), [angle.denom for angle in angles])
    numerators = tuple(
        sp.Poly((angle.numer * denominator.exquo(angle.denom)).as_expr(), LAPLACE) for angle in angles
    )
    return TransferFunctions(numerators, sp.Poly(denominator.as_expr(), LAPLACE))


def _products(stations: list[list[sp.Matrix]]) -> list[DomainMatrix]:
    """Return the matrix from the base to the outboard side of each station, over rational functions."""
    symbols = {LAPLACE}.union(*(matrix.free_symbols for station in stations for matrix in station))
    field = sp.QQ.frac_field(*sorted(symbols, key=lambda symbol: symbol.name))
    product = DomainMatrix.eye(3, field)
    found = []
    for station in stations:
        for matrix in station:
            product = DomainMatrix.from_Matrix(matrix).convert_to(field).to_dense() * product
        found.append(product)
    return found
