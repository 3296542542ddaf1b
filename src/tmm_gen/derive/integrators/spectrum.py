"""Eigenvalues by which the stages of a coupled scheme are solved apart, and the polynomial that predicts the next ones.

With ``A = T diag(lambda) T^-1`` the equations of all stages, linearised alike, are one system for each eigenvalue:
gains ``P_a = 1, P_v = h lambda, P_q = h^2 lambda^2``. Of a conjugate pair one is enough. Rows of ``T^-1`` add up to 1,
so that what all stages share (the rate at the start of the step) stands unchanged in each system.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import mpmath
import sympy as sp

from tmm_gen.derive.integrators.declaration import Scheme
from tmm_gen.derive.integrators.relations import coupled_weights

_DIGITS = 60
_BITS = 170
_LARGEST = 2**46
"""Denominator of the numbers handed on; numerators are a few times larger at most."""

Complex = tuple[sp.Rational, sp.Rational]
"""Real and imaginary part."""


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Numbers of a coupled scheme, exact to far beyond double precision.

    Parameters
    ----------
    scheme : Scheme
        Coupled, with its parameters bound to numbers.
    """

    scheme: Scheme

    @cached_property
    def values(self) -> tuple[Complex, ...]:
        """Real eigenvalues of the weights first, then of each conjugate pair the one with positive imaginary part."""
        return tuple(_rounded(value) for value in self._eigenvalues)

    @cached_property
    def moduli(self) -> tuple[float, ...]:
        """Sizes of the eigenvalues."""
        return tuple(abs(complex(re, im)) for re, im in self.values)

    @cached_property
    def into(self) -> tuple[tuple[Complex, ...], ...]:
        """What each stage adds to each system: rows of ``T^-1``, one for each of ``values``."""
        return tuple(tuple(map(_rounded, row)) for row in self._into)

    @cached_property
    def back(self) -> tuple[tuple[Complex, ...], ...]:
        """What each system adds to each stage, one row for each stage: the real part of a product is meant.

        Columns of ``T``, those of pairs twice.
        """
        with mpmath.workdps(_DIGITS):
            rows = [list(row) for row in self._into]
            rows += [[mpmath.conj(x) for x in row] for row in self._into if not _is_real(row)]
            whole = mpmath.inverse(mpmath.matrix(rows))
            twice = [1 if _is_real(row) else 2 for row in self._into]
            return tuple(
                tuple(_rounded(times * whole[i, k]) for k, times in enumerate(twice))
                for i in range(whole.rows)
            )

    @cached_property
    def matrix(self) -> sp.ImmutableMatrix:
        """Weights of accelerations in rates, (s, s), exact."""
        return coupled_weights(self.scheme)[0]

    @cached_property
    def squared(self) -> sp.ImmutableMatrix:
        """Weights of accelerations in displacements, (s, s), exact."""
        return (self.matrix**2).applyfunc(_simple)

    @cached_property
    def ends(self) -> dict[str, tuple[sp.Expr, ...]]:
        """Weights of accelerations in the motion at the end of the step, by kind, exact."""
        weights, row = coupled_weights(self.scheme)
        return {
            "q": tuple(map(_simple, row * weights)),
            "v": tuple(row),
            "a": self._polynomial(sp.S.One, 0),
        }

    @cached_property
    def nodes(self) -> tuple[sp.Expr, ...]:
        """Instants of the stages, in steps."""
        return tuple(sp.sympify(declared.instant) for declared in self.scheme.stages)

    @cached_property
    def ahead(self) -> sp.ImmutableMatrix:
        """Weights of the last step's accelerations in those that its polynomial predicts, (s, s), exact."""
        return sp.ImmutableMatrix([self._polynomial(1 + c, 0) for c in self.nodes])

    @cached_property
    def middle(self) -> dict[str, tuple[sp.Expr, ...]]:
        """Weights of the stages' accelerations in the motion at the middle of the step, by kind, exact."""
        half = sp.Rational(1, 2)
        return {kind: self._polynomial(half, times) for kind, times in (("a", 0), ("v", 1), ("q", 2))}

    def _polynomial(self, instant: sp.Expr, integrals: int) -> tuple[sp.Expr, ...]:
        """Return weights in the polynomial through the accelerations, or in its integrals from the step's start."""
        powers = range(len(self.nodes))
        basis = sp.Matrix([[c**k for k in powers] for c in self.nodes])
        at = sp.Matrix([[instant ** (k + integrals) / sp.rf(k + 1, integrals) for k in powers]])
        return tuple(map(_simple, at * basis.inv()))

    @cached_property
    def _eigenvalues(self) -> list[mpmath.mpc]:
        symbol = sp.Symbol("lambda")
        polynomial = self.matrix.charpoly(symbol, simplify=_simple)
        with mpmath.workdps(_DIGITS):
            coefficients = [mpmath.mpmathify(_simple(c).evalf(_DIGITS)) for c in polynomial.all_coeffs()]
            roots = mpmath.polyroots(coefficients, maxsteps=200, extraprec=400)
            real = sorted((root for root in roots if abs(root.imag) < _TINY), key=lambda root: root.real)
            pairs = sorted((root for root in roots if root.imag >= _TINY), key=lambda root: root.imag)
            return [*(mpmath.mpc(root.real) for root in real), *pairs]

    @cached_property
    def _into(self) -> list[list[mpmath.mpc]]:
        """Left eigenvectors, entries adding up to 1."""
        found = []
        with mpmath.workdps(_DIGITS):
            weights = mpmath.matrix(
                [
                    [mpmath.mpmathify(x.evalf(_DIGITS)) for x in self.matrix.row(i)]
                    for i in range(self.matrix.rows)
                ]
            )
            size = weights.rows
            for value in self._eigenvalues:
                # y (A - lambda) = 0 and y 1 = 1: one of the former follows from the others
                system = mpmath.matrix(size, size)
                for i in range(size):
                    for j in range(size - 1):
                        system[j, i] = weights[i, j] - (value if i == j else 0)
                    system[size - 1, i] = 1
                right = mpmath.matrix([0] * (size - 1) + [1])
                found.append([mpmath.mpc(x) for x in mpmath.lu_solve(system, right)])
        return found


_TINY = mpmath.mpf(10) ** -30


def _is_real(row: list[mpmath.mpc]) -> bool:
    return all(abs(x.imag) < _TINY for x in row)


def spectrum_of(scheme: Scheme) -> Spectrum:
    """Return the numbers of a coupled scheme, worked out once."""
    if id(scheme) not in _KNOWN:
        _KNOWN[id(scheme)] = Spectrum(scheme)
    return _KNOWN[id(scheme)]


_KNOWN: dict[int, Spectrum] = {}
"""What has been worked out; each holds its scheme, so that no other takes its identity."""


def fraction(value: sp.Expr) -> sp.Rational:
    """Return a number as a fraction of two numbers that doubles hold exactly: right to twice their digits."""
    whole = Fraction(int(sp.floor(sp.N(value, _DIGITS) * 2**_BITS + sp.S.Half)), 2**_BITS)
    return sp.Rational(whole.limit_denominator(_LARGEST))


def _rounded(value: mpmath.mpc) -> Complex:
    return fraction(sp.Float(value.real, _DIGITS)), fraction(sp.Float(value.imag, _DIGITS))


def _simple(value: sp.Expr) -> sp.Expr:
    return sp.expand(sp.radsimp(sp.expand(value)))
