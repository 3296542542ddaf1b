"""Type annotations of scratch scalars, so that checkers of types accept what a loop makes of them."""

from __future__ import annotations

from tmm_gen.program.statements import Assign
from tmm_gen.program.variables import Role, Variable


class ScratchTypes:
    """Says at which assignments of a function a scratch scalar needs an annotation."""

    def __init__(self) -> None:
        self._declared: set[Variable] = set()

    def annotation(self, statement: Assign) -> str:
        """Return what follows the target: a number now may be an array or a symbol at the next station."""
        variable = statement.target.variable
        if variable.role not in (Role.LOCAL, Role.OUTPUT) or variable in self._declared:
            return ""
        self._declared.add(variable)
        return ": Any" if statement.value.is_number else ""
