"""Operation counts of programs, by the conventions in which backends print them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import sympy as sp

from tmm_gen.program.parts import Part, Vector
from tmm_gen.program.statements import Loop, Routine, Statement


@dataclass(frozen=True)
class Operations:
    """Floating-point operations; a change of sign is none.

    Parameters
    ----------
    additions, multiplications, divisions, functions : int
        Subtractions count as additions; functions are sines, cosines and square roots.
    """

    additions: int = 0
    multiplications: int = 0
    divisions: int = 0
    functions: int = 0

    @property
    def total(self) -> int:
        """All of them, each counted as one."""
        return self.additions + self.multiplications + self.divisions + self.functions

    def __add__(self, other: Operations) -> Operations:
        """Add counts."""
        return Operations(
            self.additions + other.additions,
            self.multiplications + other.multiplications,
            self.divisions + other.divisions,
            self.functions + other.functions,
        )

    def __mul__(self, times: int) -> Operations:
        """Repeat."""
        return Operations(
            self.additions * times,
            self.multiplications * times,
            self.divisions * times,
            self.functions * times,
        )


@lru_cache(maxsize=1 << 16)  # every backend asks again for its header
def count_expression(e: sp.Expr) -> Operations:
    """Count the operations of one expression as printed, one of vectors as one."""
    e = sp.sympify(e)
    if e.is_Atom:
        return Operations()
    if e.is_Add:
        return sum((count_expression(t) for t in e.args), Operations(additions=len(e.args) - 1))
    if e.is_Mul:
        return _count_product(e)
    if e.is_Pow:
        return _count_power(e)
    if isinstance(e, Part | Vector):
        return Operations()
    return sum((count_expression(a) for a in e.args), Operations(functions=1))


def count_routine(routine: Routine) -> Operations:
    """Count the operations of one call of a routine; of what it repeats, one round."""
    total = Operations()
    for statement in routine.statements():
        if isinstance(statement, Loop):
            body = sum((count_expression(s.value) for s in statement.body), Operations())
            total += body * len(statement.visits)
        else:
            total += count_expression(statement.value)
    return total


def count_by_station(statements: Iterable[Statement]) -> Counter[int | None]:
    """Count the operations of statements by the station, from 0, that they are of; None where of no single one.

    Where a loop goes over several stations at a time, what its body costs is shared out among them.
    """
    found: Counter[int | None] = Counter()
    for statement in statements:
        if not isinstance(statement, Loop):
            found[None] += count_expression(statement.value).total
            continue
        body = sum(count_expression(s.value).total for s in statement.body)
        each, left = divmod(body, statement.stride)
        for first in statement.visits:
            for slot in range(statement.stride):
                found[first + slot] += each + (slot < left)
    return found


def _count_product(e: sp.Expr) -> Operations:
    above = below = 0
    inner = Operations()
    for factor in e.args:
        if factor in (1, -1):
            continue
        base, exponent = factor.as_base_exp()
        if exponent.is_Integer and not factor.is_Number:
            count = abs(int(exponent))
            above, below = (above + count, below) if exponent > 0 else (above, below + count)
            inner += count_expression(base) * count
        else:
            above += 1
            inner += count_expression(factor)
    multiplications = max(above - 1, 0) + max(below - 1, 0)
    return inner + Operations(multiplications=multiplications, divisions=1 if below else 0)


def _count_power(e: sp.Expr) -> Operations:
    base, exponent = e.as_base_exp()
    inner = count_expression(base)
    if exponent.is_Integer:
        count = abs(int(exponent))
        return inner * count + Operations(multiplications=count - 1, divisions=1 if exponent < 0 else 0)
    return inner + Operations(functions=1, divisions=1 if exponent.is_negative else 0)
