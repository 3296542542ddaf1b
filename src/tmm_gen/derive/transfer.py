"""Transfer matrices from an element's equations, in discrete time and in the Laplace domain.

The two differ only in how a motion is written by the unknown of a station: ``q = P_q u + q^`` and so on after time
discretisation (3-1, 3-2), ``q = u, v = s u, a = s^2 u`` in the Laplace domain.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.elements.declaration import Element, Port

LAPLACE = sp.Symbol("s")
"""The Laplace variable, 1/s."""


@dataclass(frozen=True)
class DiscreteMotion:
    """One coordinate at one station: gains of the unknown and what is known beforehand.

    Parameters
    ----------
    gain : mapping from "q", "v", "a" to sympy.Expr
        ``P_q, P_v, P_a``.
    known : mapping from "q", "v", "a" to sympy.Expr
        The part that does not depend on the unknown.
    """

    gain: Mapping[str, sp.Expr]
    known: Mapping[str, sp.Expr]


@dataclass(frozen=True)
class TransferMatrix:
    """``[k; f]_out = [[U11, U12], [U21, U22]] [k; f]_in + [u1; u2]``.

    ``k`` holds the unknowns of the motions, ``f`` the forces.
    """

    U11: sp.Matrix
    U12: sp.Matrix
    U21: sp.Matrix
    U22: sp.Matrix
    u1: sp.Matrix
    u2: sp.Matrix

    def full(self) -> sp.Matrix:
        """Return the extended matrix that acts on ``[k; f; 1]``, as the thesis prints it."""
        size = self.u1.rows + self.u2.rows
        top = sp.Matrix.vstack(
            sp.Matrix.hstack(self.U11, self.U12, self.u1), sp.Matrix.hstack(self.U21, self.U22, self.u2)
        )
        return sp.Matrix.vstack(top, sp.Matrix([[0] * size + [1]]))


def laplace_motion() -> DiscreteMotion:
    """Return the Laplace-domain reading of a motion starting from rest."""
    zero = dict.fromkeys(("q", "v", "a"), sp.Integer(0))
    return DiscreteMotion({"q": sp.Integer(1), "v": LAPLACE, "a": LAPLACE**2}, zero)


def transfer_matrix(
    element: Element, inboard: Sequence[DiscreteMotion], outboard: Sequence[DiscreteMotion]
) -> TransferMatrix:
    """Solve an element's equations for its outboard state.

    Parameters
    ----------
    element : Element
        Its equations must be linear in the unknowns once motions are written by them.
    inboard, outboard : sequence of DiscreteMotion
        One for each coordinate of the ports.

    Raises
    ------
    ValueError
        If the equations do not determine the outboard state.
    """
    k_in, f_in, known_in = _by_unknowns(element.inboard, inboard, "in")
    k_out, f_out, known_out = _by_unknowns(element.outboard, outboard, "out")
    equations = [sp.expand(e.subs({**known_in, **known_out})) for e in element.equations]
    outward = [*k_out, *f_out]
    jacobian = sp.Matrix(equations).jacobian(outward)
    if sp.simplify(jacobian.det()) == 0:
        raise ValueError(f"{element.name}: the outboard state is not determined by the inboard one")
    right = sp.Matrix(equations).subs(dict.fromkeys(outward, 0))
    solved = (-jacobian.LUsolve(right)).applyfunc(sp.expand)
    inward = [*k_in, *f_in]
    blocks = solved.jacobian(inward).applyfunc(sp.factor)
    rest = solved.subs(dict.fromkeys(inward, 0))
    m = len(k_in)
    return TransferMatrix(
        U11=blocks[:m, :m],
        U12=blocks[:m, m:],
        U21=blocks[m:, :m],
        U22=blocks[m:, m:],
        u1=rest[:m, :],
        u2=rest[m:, :],
    )


def laplace_matrix(element: Element) -> TransferMatrix:
    """Return an element's transfer matrix in the Laplace domain."""
    motions = [laplace_motion()] * len(element.inboard.motions)
    return transfer_matrix(element, motions, motions)


def _by_unknowns(
    port: Port, motions: Sequence[DiscreteMotion], side: str
) -> tuple[list[sp.Symbol], list[sp.Symbol], dict[sp.Symbol, sp.Expr]]:
    """Write a port's motions by one unknown each."""
    unknowns = [sp.Symbol(f"u{i}_{side}", real=True) for i in range(len(port.motions))]
    values: dict[sp.Symbol, sp.Expr] = {}
    for unknown, symbols, discrete in zip(unknowns, port.motions, motions, strict=True):
        for kind in ("q", "v", "a"):
            values[getattr(symbols, kind)] = discrete.gain[kind] * unknown + discrete.known[kind]
    return unknowns, list(port.forces), values
