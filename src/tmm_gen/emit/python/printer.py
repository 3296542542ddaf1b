"""Expressions in Python."""

from __future__ import annotations

from collections.abc import Callable

from tmm_gen.emit.expressions import ExpressionPrinter
from tmm_gen.program.variables import Ref


class PythonPrinter(ExpressionPrinter):
    """Writes expressions as formatters of Python want them.

    Parameters
    ----------
    refer : callable
        Writes a reference.
    module : str
        Where ``sin``, ``cos`` and ``sqrt`` come from.
    """

    def __init__(self, refer: Callable[[Ref], str], module: str) -> None:
        self._refer = refer
        self._module = module

    def reference(self, ref: Ref) -> str:
        """Write a scalar or an array element."""
        return self._refer(ref)

    def literal(self, value: float) -> str:
        """Write the shortest decimal that reads back as the same number."""
        return repr(value)

    def function(self, name: str) -> str:
        """Write a function with its module."""
        return f"{self._module}.{name}"
