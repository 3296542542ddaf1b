"""Expressions in C."""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from tmm_gen.c_language.real import Real
from tmm_gen.emit.expressions import ExpressionPrinter
from tmm_gen.program.variables import Ref


class CPrinter(ExpressionPrinter):
    """Writes expressions in one number type, without a trace of any other.

    Parameters
    ----------
    real : Real
        The type.
    refer : callable
        Writes a reference.
    """

    def __init__(self, real: Real, refer: Callable[[Ref], str]) -> None:
        self._real = real
        self._refer = refer
        self.turns: dict[sp.Expr, str] = {}
        """Variables that hold sine and cosine, by angle; others are functions of the C library."""

    def reference(self, ref: Ref) -> str:
        """Write a scalar or an array element."""
        return self._refer(ref)

    def literal(self, value: float) -> str:
        """Write a number."""
        return self._real.literal(value)

    def call(self, e: sp.Function) -> str:
        """Write a call, or the member of a variable that holds its result."""
        if isinstance(e, sp.sin | sp.cos) and e.args[0] in self.turns:
            return f"{self.turns[e.args[0]]}.{'sine' if isinstance(e, sp.sin) else 'cosine'}"
        return super().call(e)

    def function(self, name: str) -> str:
        """Write the name of a function of ``<math.h>``."""
        return self._real.function(name)


def element_at(name: str, entry: int | None, index: Callable[[int], str]) -> str:
    """Write an element with a fixed index, or the scalar itself."""
    return name if entry is None else f"{name}[{index(entry)}]"
