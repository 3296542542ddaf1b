"""Statements of a program on Python lists of symbols: loops over stations stay loops, of Python."""

from __future__ import annotations

from tmm_gen.emit.expressions import element
from tmm_gen.emit.python.lines import assignment, comment
from tmm_gen.emit.python.names import Names
from tmm_gen.emit.python.printer import PythonPrinter
from tmm_gen.emit.python.routine import PythonRoutine
from tmm_gen.program.statements import Assign, Loop, Routine, Statement
from tmm_gen.program.variables import Role, Variable

_INDENT = "    "
_GIVEN = frozenset({Role.STATE, Role.TANGENT})
"""Arrays of these roles are there before the function begins."""


class RoutineText(PythonRoutine):
    """The body of one generated function, see :class:`~tmm_gen.emit.python.routine.PythonRoutine`."""

    def __init__(self, routine: Routine, names: Names, stations: int) -> None:
        super().__init__(routine, names, stations)
        self._printer = PythonPrinter(lambda ref: element(names[ref.variable], ref), "ca")

    def lines(self, absent: tuple[Variable, ...] = ()) -> list[str]:
        """Return the statements, indented once, after lists for arrays they fill and what is absent."""
        filled = {v for v in self._routine.written() if v.length is not None and v.role not in _GIVEN}
        lines = [self._zeros(variable) for variable in self._names.in_order(filled | set(absent))]
        for section in self._routine.sections:
            lines += ["", *comment(section.title, _INDENT)]
            for statement in section.statements:
                if isinstance(statement, Loop):
                    lines.append(f"{_INDENT}for j in {self._range(statement)}:")
                    for inner in statement.body:
                        lines += self._single(inner, 2 * _INDENT)
                else:
                    lines += self._single(statement, _INDENT)
        return lines

    def _single(self, statement: Statement, indent: str) -> list[str]:
        if not isinstance(statement, Assign):
            raise NotImplementedError(
                "symbols have no sign: they require nothing, nor tell whether to sweep again"
            )
        target = self._printer.text(statement.target) + self._types.annotation(statement)
        return assignment(target, self._printer.text(statement.value), indent)

    def _zeros(self, variable: Variable) -> str:
        name = f"{_INDENT}{self._names[variable]}"
        if variable.length is None:
            return f"{name} = 0.0"
        count = self.count(variable.length)
        return f"{name}: list[Any] = [0.0] * {f'({count})' if ' ' in count else count}"
