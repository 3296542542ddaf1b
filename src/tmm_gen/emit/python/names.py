"""Names of variables inside the generated functions."""

from __future__ import annotations

from collections.abc import Iterable

from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Role, Variable

_CHOSEN_BY_USERS = frozenset({Role.INPUT, Role.OUTPUT, Role.INPUT_TANGENT})


class Names:
    """Gives every variable a name inside functions, whatever users call their inputs and outputs.

    Attributes of the generated classes keep the scene's names; only local names may differ, by underscores
    behind.

    Parameters
    ----------
    program : Program
        Whose variables are named.
    reserved : iterable of str
        Names that the templates use.
    """

    def __init__(self, program: Program, reserved: Iterable[str]) -> None:
        self._names: dict[Variable, str] = {}
        taken = set(reserved) | {v.name for v in _variables(program) if v.role not in _CHOSEN_BY_USERS}
        for variable in (*program.inputs, *program.outputs):
            name = variable.name
            while name in taken:
                name += "_"
            taken.add(name)
            self._names[variable] = name
        self._taken = frozenset(taken)
        if program.sensitivities is not None:
            for variable, change in zip(program.inputs, program.sensitivities.inputs, strict=True):
                self._names[change] = self._names[variable]
            for variable in program.sensitivities.point:  # called like the scratch they are copies of
                self._names[variable] = f"kept_{variable.name}"

    def __getitem__(self, variable: Variable) -> str:
        """Return the name of a variable."""
        return self._names.get(variable, variable.name)

    def in_order(self, variables: Iterable[Variable]) -> list[Variable]:
        """Return variables by name; what is kept of another is called like it, and stands behind it."""
        return sorted(variables, key=lambda v: (v.name, self[v] != v.name))

    def beside(self, variable: Variable, word: str) -> str:
        """Return a name for something of a variable that no variable has."""
        name = f"{self[variable]}_{word}"
        while name in self._taken:
            name += "_"
        return name


def _variables(program: Program) -> set[Variable]:
    routines = [program.prepare, program.initialise, *program.steps, program.output]
    if program.sensitivities is not None:
        routines += [program.sensitivities.linearise, program.sensitivities.tangent]
    declared = {program.step, *program.parameters, *program.coefficients, *program.state, *program.given}
    return declared.union(*(routine.read() | routine.written() for routine in routines))
