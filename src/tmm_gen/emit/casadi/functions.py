"""Bodies of the generated functions: take columns of symbols apart, compute, put columns together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from tmm_gen.emit.casadi.statements import RoutineText
from tmm_gen.emit.python.lines import call
from tmm_gen.emit.python.names import Names
from tmm_gen.program.passes.prune import without_requirements
from tmm_gen.program.statements import Program, Routine, Sensitivities
from tmm_gen.program.variables import Role, Variable

_INDENT = "    "

RESERVED = frozenset(
    {
        "STATIONS",
        "ca",
        "causes",
        "changes",
        "given",
        "j",
        "model",
        "p",
        "point",
        "range",
        "reversed",
        "stages",
    }
    | {"u", "x"}
)
"""Names that generated functions use beside those of variables."""


@dataclass(frozen=True)
class Functions:
    """Writes the bodies of a program's functions on symbols, which have no sign: nothing is required of pivots.

    Parameters
    ----------
    program : Program
        What to write.
    names : Names
        Names of variables inside functions.
    """

    program: Program
    names: Names

    def prepare(self) -> list[str]:
        """Return the body of ``_prepare(p)``."""
        program, routine = self.program, without_requirements(self.program.prepare)
        model = [f'"{v.name}": {v.name}' for v in program.model]
        return [
            *self._split("p", self._bound(), routine.read() | set(program.model)),
            *self._body(routine),
            f"{_INDENT}return {{",
            *(f"{2 * _INDENT}{entry}," for entry in model),
            f"{_INDENT}}}",
        ]

    def initialise(self) -> list[str]:
        """Return the body of ``_initialise(given, stages, p)``."""
        program, routine = self.program, without_requirements(self.program.initialise)
        given = [v for v in program.given if v in routine.read()]
        absent = tuple(v for v in program.state if v not in routine.written() or v.length is not None)
        return [
            *self._split("p", self._bound(), routine.read()),
            *(f'{_INDENT}{v.name} = ca.vertsplit(given["{v.name}"])' for v in given),
            *self._inputs(routine),
            *self._body(routine, absent),
            *self._column(program.state),
        ]

    def step(self, routine: Routine) -> list[str]:
        """Return the body of a step ``_step(model, x, stages)``."""
        routine = without_requirements(routine)
        return [
            *self._model(routine),
            *self._split("x", self.program.state, set(self.program.state)),
            *self._inputs(routine),
            *self._body(routine),
            *self._column(self.program.state),
        ]

    def output(self) -> list[str]:
        """Return the body of ``_output(model, x, stages)``."""
        routine = without_requirements(self.program.output)
        return [
            *self._model(routine),
            *self._split("x", self.program.state, routine.read()),
            *self._inputs(routine),
            *self._body(routine),
            *self._column(self.program.outputs),
        ]

    def linearise(self, found: Sensitivities) -> list[str]:
        """Return the body of ``_linearise(model, x, stages)``."""
        routine = without_requirements(found.linearise, frozenset(found.point))
        point = [f'"{v.name}": {self.names[v]}' for v in found.point]
        return [
            *self._model(routine),
            *self._split("x", self.program.state, set(self.program.state)),
            *self._inputs(routine),
            *self._body(routine),
            *call("return", [_column_text(self.program.state), f"{{{', '.join(point)}}}"], _INDENT),
        ]

    def tangent(self, found: Sensitivities) -> list[str]:
        """Return the body of ``_tangent(model, point, changes, causes)``: a row of directions for each number."""
        routine = without_requirements(found.tangent)
        read = routine.read()
        lines, start = [], 0
        for variable in found.state:
            stop = start + (variable.length or 1)
            part = f"changes[{start}:{stop}, :]"
            lines.append(
                f"{_INDENT}{variable.name} = "
                + (part if variable.length is None else f"ca.vertsplit({part})")
            )
            start = stop
        for place, variable in enumerate(found.inputs):
            if variable in read:
                every = f"[cause[{place}, :] for cause in causes]"
                part = f"causes[0][{place}, :]" if variable.length is None else every
                lines.append(f"{_INDENT}{self.names[variable]} = {part}")
        items = [f"*{v.name}" if v.length is not None else v.name for v in found.state]
        return [
            *self._model(routine),
            *(f'{_INDENT}{self.names[v]} = point["{v.name}"]' for v in found.point if v in read),
            *lines,
            *self._body(routine),
            *call("return _rows", ["changes.shape[1]", *items], _INDENT),
        ]

    def _body(self, routine: Routine, absent: tuple[Variable, ...] = ()) -> list[str]:
        return RoutineText(routine, self.names, self.program.stations).lines(absent)

    def _model(self, routine: Routine) -> list[str]:
        return [f'{_INDENT}{v.name} = model["{v.name}"]' for v in self.program.model if v in routine.read()]

    def _bound(self) -> tuple[Variable, ...]:
        """Return what the column ``p`` holds."""
        return (self.program.step, *self.program.parameters)

    def _split(self, column: str, variables: Iterable[Variable], wanted: Iterable[Variable]) -> list[str]:
        """Take the wanted variables out of a column that holds all."""
        lines, start, needed = [], 0, set(wanted)
        for variable in variables:
            stop = start + (variable.length or 1)
            if variable in needed:
                many = f"ca.vertsplit({column}[{start}:{stop}])"
                part = f"{column}[{start}]" if variable.length is None else many
                lines.append(f"{_INDENT}{self.names[variable]} = {part}")
            start = stop
        return lines

    def _inputs(self, routine: Routine) -> list[str]:
        """Take the inputs out of the columns of the stages."""
        lines = []
        for place, variable in enumerate(self.program.inputs):
            if variable not in routine.read():
                continue
            part = f"stages[0][{place}]" if variable.length is None else f"[u[{place}] for u in stages]"
            lines.append(f"{_INDENT}{self.names[variable]} = {part}")
        return lines

    def _column(self, variables: Sequence[Variable]) -> list[str]:
        items = [f"*{self.names[v]}" if v.length is not None else self.names[v] for v in variables]
        return call("return _column", items, _INDENT)


def _column_text(variables: Sequence[Variable]) -> str:
    """Return a call that puts numbers in a column."""
    return f"_column({', '.join(f'*{v.name}' if v.length is not None else v.name for v in variables)})"


def flat_names(variables: Sequence[Variable]) -> list[str]:
    """Return items of a tuple of the names of all numbers of variables, stations counted from 1."""
    items: list[str] = []
    for variable in variables:
        several = variable.length is not None and variable.role is not Role.INPUT
        items.append(f'*_numbered("{variable.name}", {variable.length})' if several else f'"{variable.name}"')
    return items
