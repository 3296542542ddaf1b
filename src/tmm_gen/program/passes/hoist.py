"""Hoisting by binding time: what depends on parameters and the step alone moves from step to prepare.

An expression that is affine in what changes from step to step is rewritten as a sum of those things, each with a
factor bound at prepare; any other keeps its shape, and only the early-bound parts of its sums and products move. A
factor that takes any arithmetic becomes a coefficient of the model, shared wherever the same factor occurs again,
in this routine or another.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache

import sympy as sp

from tmm_gen.program.passes.naming import name_of
from tmm_gen.program.passes.rewrite import map_lines
from tmm_gen.program.statements import Assign, Routine, Section
from tmm_gen.program.variables import Ref, Role, Variable, refs_in


@dataclass
class Hoister:
    """Collects hoisted factors over several routines.

    Parameters
    ----------
    names : dict from sympy.Expr to (name, doc, unit)
        How to call factors that have a physical meaning; others are called after what they do.
    """

    names: dict[sp.Expr, tuple[str, str, str]] = field(default_factory=dict)
    _found: dict[sp.Expr, Variable] = field(default_factory=dict)
    _target: Ref | None = None
    _rewritten: dict[sp.Expr, sp.Expr] = field(default_factory=dict)

    def hoist(self, routine: Routine) -> Routine:
        """Return the routine with factors replaced by coefficients."""

        def hoisted(value: sp.Expr, target: Ref | None) -> sp.Expr:
            if value not in self._rewritten:  # stations that are alike ask again and again
                self._target = target
                self._rewritten[value] = self._rewrite(value)
            return self._rewritten[value]

        return replace(routine, sections=tuple(map_lines(s, hoisted) for s in routine.sections))

    @property
    def coefficients(self) -> tuple[Variable, ...]:
        """The coefficients found, in order of discovery."""
        return tuple(self._found.values())

    def section(self) -> Section:
        """Return the statements that compute them in prepare."""
        return Section(
            "Factors of the step that depend on the time step and parameters alone",
            tuple(Assign(variable.ref, value) for value, variable in self._found.items()),
        )

    def _rewrite(self, value: sp.Expr) -> sp.Expr:
        affine = _taken_apart(value)
        if affine is None:
            return self._inside(value)
        if not affine:
            return value
        by_factor: dict[sp.Expr, list[sp.Expr]] = {}
        for monomial, factor in affine:
            held, sign = self._factor(_factored(factor), monomial if monomial != 1 else None)
            by_factor.setdefault(held, []).append(sign * monomial)
        terms = [
            sp.Mul(factor, sp.Add(*monomials), evaluate=factor.is_Number or len(monomials) == 1)
            if factor != 1
            else sp.Add(*monomials)
            for factor, monomials in by_factor.items()
        ]
        return sp.Add(*terms)

    def _inside(self, value: sp.Expr) -> sp.Expr:
        """Keep the shape of a non-linear expression; hoist what each of its sums and products has bound early."""
        if value.is_Atom:
            return value
        if not (value.is_Add or value.is_Mul):
            return value.func(*(self._inside(a) for a in value.args))
        early = [a for a in value.args if _bound_early(a)]
        late = [self._inside(a) for a in value.args if not _bound_early(a)]
        held, sign = self._factor(_factored(value.func(*early))) if early else (value.func(), 1)
        return value.func(sign * held, *late)

    def _factor(self, factor: sp.Expr, of: sp.Expr | None = None) -> tuple[sp.Expr, int]:
        """Return what stands for a factor, and its sign."""
        sign = -1 if factor.could_extract_minus_sign() else 1
        factor = sign * factor
        if factor.is_Number or isinstance(factor, Ref):
            return factor, sign
        if factor not in self._found:
            if any(ref.offset is not None for ref in refs_in(factor)):
                return factor, sign  # per-station factors are named by whoever builds the sweep
            name, doc, unit = self._name(factor, of)
            self._found[factor] = Variable(name, Role.COEFFICIENT, doc=doc, unit=unit)
        return self._found[factor].ref, sign

    def _name(self, factor: sp.Expr, of: sp.Expr | None) -> tuple[str, str, str]:
        """Return a name that no other factor has, a description and a unit."""
        name, doc, unit = self.names.get(factor) or name_of(factor, self._target, of)
        taken = {v.name for v in self._found.values()} | {n for n, _, _ in self.names.values()} - {name}
        unique, number = name, 2
        while unique in taken or (
            unique in {n for n, _, _ in self.names.values()} and factor not in self.names
        ):
            unique, number = f"{name}_{number}", number + 1
        return unique, doc, unit


@lru_cache(maxsize=1 << 14)  # arms that differ in one thing have the same sums besides
def _taken_apart(value: sp.Expr) -> list[tuple[sp.Expr, sp.Expr]] | None:
    """Return an expression by what changes in it; nothing where all may stay, None where it is not affine."""
    changing = sorted(
        (r for r in refs_in(value) if not r.variable.role.bound_at_prepare), key=lambda r: r.name
    )
    if not changing or _all_late(value, changing):
        return []
    if _plainly_nonlinear(value):
        return None
    return _plainly_affine(value, changing) or _affine(value, tuple(changing))


def _all_late(value: sp.Expr, changing: list[Ref]) -> bool:
    """Whether nothing in an expression can be hoisted: all of it changes from step to step."""
    return len(refs_in(value)) == len(changing) and not value.atoms(sp.Number) - {sp.S.One, sp.S.NegativeOne}


def _plainly_nonlinear(value: sp.Expr) -> bool:
    """Whether an expanded sum has products of two changing things: seen without the algebra of polynomials."""
    nonlinear = False
    for term in sp.Add.make_args(value):
        powers = [factor.as_base_exp() for factor in sp.Mul.make_args(term)]
        if not all(base.is_Atom and exponent.is_Integer and exponent > 0 for base, exponent in powers):
            return False
        nonlinear = nonlinear or sum(int(n) for base, n in powers if not _bound_early(base)) > 1
    return nonlinear


def _affine(value: sp.Expr, changing: tuple[Ref, ...]) -> list[tuple[sp.Expr, sp.Expr]] | None:
    """Return an expression as changing things with their factors, and 1 with the rest; None where it is not affine."""
    polynomial = sp.Poly(value, *changing) if value.is_polynomial(*changing) else None
    if polynomial is None or polynomial.total_degree() > 1:
        return None
    monomials = [sp.Mul(*map(sp.Pow, changing, powers)) for powers in polynomial.monoms()]
    return list(zip(monomials, polynomial.coeffs(), strict=True))


def _plainly_affine(value: sp.Expr, changing: list[Ref]) -> list[tuple[sp.Expr, sp.Expr]] | None:
    """Return the same of an expanded sum, without the algebra of polynomials; None of any other expression."""
    found: dict[sp.Expr, list[sp.Expr]] = {}
    for term in sp.Add.make_args(value):
        late: list[sp.Expr] = []
        early: list[sp.Expr] = []
        for factor in sp.Mul.make_args(term):
            base, exponent = factor.as_base_exp()
            whole = factor.is_Rational or (base.is_Symbol and exponent.is_Integer and exponent > 0)
            if not whole:
                return None
            (early if _bound_early(factor) else late).append(factor)
        if len(late) > 1 or not all(factor.is_Symbol for factor in late):
            return None
        found.setdefault(late[0] if late else sp.S.One, []).append(sp.Mul(*early))
    return [(ref, sp.Add(*found[ref])) for ref in (*changing, sp.S.One) if ref in found]


@lru_cache(maxsize=1 << 12)  # a step's few factors stand in hundreds of sums
def _factored(value: sp.Expr) -> sp.Expr:
    return value if value.is_Atom else sp.factor(value)


def _bound_early(expression: sp.Expr) -> bool:
    return all(ref.variable.role.bound_at_prepare for ref in refs_in(expression))
