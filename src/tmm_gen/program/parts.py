"""Numbers that are vectors: how one is put together of its parts, and one of its parts."""

from __future__ import annotations

import sympy as sp

from tmm_gen.program.variables import Ref


class Vector(sp.Function):  # type: ignore[misc]  # SymPy has no types
    """A vector of parts, in the order of the arguments; those that are left out are zero."""


class Part(sp.Function):  # type: ignore[misc]
    """A part of a vector, the first argument, by its number from 0, the second."""


def is_vector(value: sp.Expr) -> bool:
    """Whether a value is a vector."""
    if isinstance(value, Ref):
        return value.variable.spread is not None
    if isinstance(value, Vector | Part):
        return isinstance(value, Vector)
    return any(map(is_vector, value.args))
