"""The amplification matrix of a step on ``q'' + 2 zeta w q' + w^2 q = f``, from the declaration alone.

Time is counted in steps: the history is ``(q, h v, h^2 a)`` at each instant, the frequency ``Omega = w h``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache, reduce

import sympy as sp
from sympy.polys.fields import FracElement
from sympy.polys.matrices import DomainMatrix

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Past, Scheme, past, stage
from tmm_gen.derive.integrators.history import history_of
from tmm_gen.derive.integrators.relations import affine_motion, coupled_weights

OMEGA = sp.Symbol("Omega", positive=True)
"""Angular frequency times step."""

ZETA = sp.Symbol("zeta", nonnegative=True)
"""Physical damping ratio."""

LAMBDA = sp.Symbol("lambda")
"""Eigenvalue of the amplification matrix."""

_Z = sp.Symbol("z")

POLYNOMIAL_GENERATORS = (LAMBDA, OMEGA, ZETA)


@dataclass(frozen=True, eq=False)  # one of each scheme: what follows from it is remembered by it
class Amplification:
    """One step as a linear map of its scaled history, ``x_new = matrix x + forcing (h^2 f at each stage)``.

    Parameters
    ----------
    history : tuple of Past
        Components of the history vector ``x``, n of them.
    matrix : DomainMatrix
        (n, n), over the field of rational functions in ``OMEGA`` and ``ZETA``.
    forcing : DomainMatrix
        (n, stages), over the same field.
    instants : tuple of sympy.Expr
        Of the stages, in steps.
    roots : mapping from sympy.Symbol to sympy.Expr
        Irrational numbers of the method, which the matrices carry as symbols.
    """

    history: tuple[Past, ...]
    matrix: DomainMatrix
    forcing: DomainMatrix
    instants: tuple[sp.Expr, ...]
    roots: Mapping[sp.Symbol, sp.Expr]

    @property
    def expression(self) -> sp.Matrix:
        """The amplification matrix, (n, n), as expressions in ``OMEGA`` and ``ZETA``."""
        return self.matrix.to_Matrix().subs(self.roots)

    @cached_property
    def characteristic(self) -> sp.Poly:
        """``det(LAMBDA - matrix)`` with its fractions cleared, a polynomial in ``LAMBDA, OMEGA, ZETA``."""
        return self.cleared([self._monic])[0]

    @cached_property
    def response(self) -> tuple[sp.Poly, tuple[tuple[sp.Poly, ...], ...]]:
        """Steady response to a load that grows by the factor ``LAMBDA`` a step.

        Returns
        -------
        denominator : sympy.Poly
            A multiple of the characteristic polynomial.
        numerators : tuple of tuple of sympy.Poly
            One row for each component of the history, one column for each stage's load.
        """
        monic, size = self._monic, len(self.history)
        rows: list[list[list[FracElement]]] = [[[] for _ in self.instants] for _ in range(size)]
        for column in range(len(self.instants)):
            # adj(LAMBDA - matrix) b by Horner's scheme: the coefficient of the next lower power is
            # matrix times the last one plus a coefficient of the characteristic polynomial times b.
            load = self.forcing[:, column]
            power = load
            for k in range(size):
                if k:
                    power = self.matrix * power + load * monic[k]
                for row in range(size):
                    rows[row][column].append(power[row, 0].element)
        flat = self.cleared([monic, *(cell for row in rows for cell in row)])
        stages = len(self.instants)
        numerators = flat[1:]
        return flat[0], tuple(tuple(numerators[r * stages : (r + 1) * stages]) for r in range(size))

    @cached_property
    def _monic(self) -> list[FracElement]:
        """Coefficients of ``det(LAMBDA - matrix)``, highest power first."""
        return list(self.matrix.charpoly())

    def cleared(self, coefficients: list[list[FracElement]]) -> list[sp.Poly]:
        """Make polynomials in ``LAMBDA, OMEGA, ZETA`` from rows of coefficients of powers of ``LAMBDA``.

        Highest powers come first; all rows are multiplied by their least common denominator.
        """
        one = self.matrix.domain.one
        clear = reduce(lambda a, b: a.lcm(b), {c.denom for row in coefficients for c in row}, one.denom)
        made = []
        for row in coefficients:
            terms = [
                (c.numer * clear.exquo(c.denom)).as_expr() * LAMBDA ** (len(row) - 1 - k)
                for k, c in enumerate(row)
            ]
            made.append(sp.Poly(sum(terms).subs(self.roots), *POLYNOMIAL_GENERATORS, extension=True))
        return made


@lru_cache(maxsize=256)
def amplification(scheme: Scheme) -> Amplification:
    """Derive the amplification matrix of a scheme, whose own parameters may be symbols."""
    if scheme.coupled:
        return _of_coupled(scheme)
    values = history_of([scheme], "acceleration")
    motions = [affine_motion(scheme, index, "acceleration") for index in range(1, len(scheme.stages) + 1)]
    expressions = [*scheme.update.values()]
    for motion in motions:
        expressions += [*motion.gain.values(), *motion.offset.values()]
    field, named = _rational_functions(expressions)
    omega, zeta = field.from_sympy(OMEGA), field.from_sympy(ZETA)

    width = len(values) + len(motions)
    unit = DomainMatrix.eye(width, field)
    rows = {past(p.kind, p.lag): unit[i, :] for i, p in enumerate(values)}

    def number(coefficient: sp.Expr) -> FracElement:
        return field.from_sympy(coefficient.subs(STEP, 1).xreplace(named))

    def linear(expression: sp.Expr) -> DomainMatrix:
        """Write a linear expression in values already known as a row over history and loads."""
        row = DomainMatrix.zeros((1, width), field)
        for value in expression.free_symbols & set(rows):
            row += rows[value] * number(sp.diff(expression, value))
        return row

    for index, motion in enumerate(motions, start=1):
        gain = {kind: number(motion.gain[kind]) for kind in KINDS}
        offset = {kind: linear(motion.offset[kind]) for kind in KINDS}
        effective = gain["a"] + 2 * zeta * omega * gain["v"] + omega**2 * gain["q"]
        known = offset["a"] + offset["v"] * (2 * zeta * omega) + offset["q"] * omega**2
        unknown = (unit[len(values) + index - 1, :] - known) * (1 / effective)
        rows |= {stage(kind, index): unknown * gain[kind] + offset[kind] for kind in KINDS}

    new = [linear(scheme.update[p.kind]) if p.lag == 0 else rows[past(p.kind, p.lag - 1)] for p in values]
    whole = DomainMatrix.vstack(*new).to_dense()
    size = len(values)
    return Amplification(
        history=values,
        matrix=whole[:, :size],
        forcing=whole[:, size:],
        instants=tuple(stage_.instant for stage_ in scheme.stages),
        roots={symbol: root for root, symbol in named.items()},
    )


def _of_coupled(scheme: Scheme) -> Amplification:
    """Derive it from ``R(z) = 1 + z b (1 - z A)^-1 1`` at the matrix of the oscillator.

    Numerators and denominator are polynomials, so that irrational abscissae leave what they cancel from.
    """
    weights, row = coupled_weights(scheme)
    size = weights.rows
    eye = sp.eye(size)
    denominator = sp.Poly(sp.expand((eye - _Z * weights).det()), _Z)
    # the adjugate times det is what an inverse would be, without fractions
    loads = [sp.Poly(sp.expand(entry), _Z) for entry in row * (eye - _Z * weights).adjugate()]
    numerator = denominator + sp.Poly(sp.expand(_Z * sp.Add(*(p.as_expr() for p in loads))), _Z)
    polynomials = (denominator, numerator, *loads)
    coefficients = [[sp.expand(c) for c in polynomial.all_coeffs()] for polynomial in polynomials]
    field, named = _rational_functions([c for each in coefficients for c in each])
    omega, zeta = field.from_sympy(OMEGA), field.from_sympy(ZETA)
    oscillator = DomainMatrix(
        [[field.zero, field.one], [-(omega**2), -2 * zeta * omega]], (2, 2), field
    ).to_sparse()
    unit = DomainMatrix.eye(2, field)

    def at_oscillator(polynomial: list[sp.Expr]) -> DomainMatrix:
        made = DomainMatrix.zeros((2, 2), field)
        for coefficient in polynomial:
            made = made * oscillator + unit * field.from_sympy(coefficient.xreplace(named))
        return made

    below, above, *through = map(at_oscillator, coefficients)
    inverse = below.to_dense().inv().to_sparse()
    push = unit[:, 1]
    return Amplification(
        history=history_of([scheme], "acceleration"),
        matrix=(above * inverse).to_dense(),
        forcing=DomainMatrix.hstack(*(each * inverse * push for each in through)).to_dense(),
        instants=tuple(stage_.instant for stage_ in scheme.stages),
        roots={symbol: root for root, symbol in named.items()},
    )


def _rational_functions(expressions: Iterable[sp.Expr]) -> tuple[sp.Domain, dict[sp.Expr, sp.Symbol]]:
    """Return the rational functions in ``OMEGA``, ``ZETA`` and parameters, and names for irrational numbers.

    Irrational numbers are carried as parameters, because fractions over algebraic fields are slow to reduce.
    """
    roots: set[sp.Expr] = set()
    parameters: set[sp.Symbol] = set()
    for expression in expressions:
        roots |= {p for p in expression.atoms(sp.Pow) if p.is_number and not p.is_Rational}
        parameters |= {s for s in expression.free_symbols if "_past" not in s.name and "_stage" not in s.name}
    named = {root: sp.Symbol(f"root{k}") for k, root in enumerate(sorted(roots, key=str))}
    others = sorted({*(parameters - {STEP}), *named.values()}, key=lambda s: s.name)
    return sp.QQ.frac_field(OMEGA, ZETA, *others), named
