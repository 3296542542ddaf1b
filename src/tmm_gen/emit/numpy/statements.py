"""Statements of a program in NumPy: loops over stations become whole-array statements where they can."""

from __future__ import annotations

from tmm_gen.emit.expressions import element
from tmm_gen.emit.python.lines import assignment, call, comment
from tmm_gen.emit.python.names import Names
from tmm_gen.emit.python.printer import PythonPrinter
from tmm_gen.emit.python.routine import PythonRoutine
from tmm_gen.emit.python.storage import rebound, vectorised, written_later
from tmm_gen.program.passes.join import join
from tmm_gen.program.statements import Assign, Loop, Repeat, Require, Routine, Statement, Until
from tmm_gen.program.variables import Ref, Variable, refs_in

_INDENT = "    "
_TOLD = 60
"""Characters of a pivot that a message names; of a longer one it names what it is made of."""


class RoutineText(PythonRoutine):
    """The body of one generated function, see :class:`~tmm_gen.emit.python.routine.PythonRoutine`."""

    def __init__(self, routine: Routine, names: Names, stations: int) -> None:
        routine = join(routine)
        super().__init__(routine, names, stations)
        self._whole = vectorised(routine)
        self.rebound = rebound(routine, self._whole)
        self._elements = PythonPrinter(lambda ref: element(names[ref.variable], ref), "np")

    @property
    def filled(self) -> frozenset[Variable]:
        """Arrays that are written element by element, so that they must exist before."""
        return frozenset(v for v in self._routine.written() if v.length is not None) - self.rebound

    def lines(self) -> list[str]:
        """Return the statements, indented once, with the sections' titles as comments."""
        lines: list[str] = []
        place = 0
        inside = ""  # what is repeated
        for section in self._routine.sections:
            if lines:
                lines.append("")
            lines += comment(section.title, _INDENT + inside)
            for statement in section.statements:
                if isinstance(statement, Until):
                    value = self._elements.text(statement.value)
                    lines += [
                        f"{_INDENT}{inside}if not np.any({value} > 0.0):",
                        f"{_INDENT}{2 * inside}break",
                    ]
                    inside = ""
                elif isinstance(statement, Repeat):
                    inside = _INDENT
                    lines.append(f"{_INDENT}for _ in range({statement.most}):")
                else:
                    lines += [inside + line for line in self._statement(statement, place)]
                place += 1
        return lines

    def _statement(self, statement: Statement, place: int) -> list[str]:
        if not isinstance(statement, Loop):
            assert isinstance(statement, Assign | Require)
            return self._single(statement, self._elements, place, _INDENT)
        lines: list[str] = []
        if place in self._whole:
            printer = PythonPrinter(lambda ref: self._slice(ref, statement), "np")
            for inner in statement.body:
                lines += self._single(inner, printer, place, _INDENT)
            return lines
        lines.append(f"{_INDENT}for j in {self._range(statement)}:")
        for inner in statement.body:
            lines += self._single(inner, self._elements, place, 2 * _INDENT)
        return lines

    def _single(
        self, statement: Assign | Require, printer: PythonPrinter, place: int, indent: str
    ) -> list[str]:
        value = printer.text(statement.value)
        if isinstance(statement, Require):
            at = "j" if indent != _INDENT else "None"
            if place in self._whole:
                at += ", batch"
            told = (
                value
                if len(value) <= _TOLD
                else ", ".join(sorted(map(printer.text, refs_in(statement.value))))
            )
            return call("good = _positive_pivot", ["good", value, f'"{told}"', at], indent)
        target = statement.target
        if self._would_alias(statement, place):
            value = f"np.copy({value})"
        if target.variable in self.rebound:
            return assignment(self._names[target.variable], value, indent)
        where = printer.reference(target)
        if target.offset is not None and where == self._names[target.variable]:
            where += "[:]"
        return assignment(where + self._types.annotation(statement), value, indent)

    def _would_alias(self, statement: Assign, place: int) -> bool:
        """Whether a bare element or slice would be a view of what is written in place later."""
        target, value = statement.target, statement.value
        keeps = target.variable.length is None or target.variable in self.rebound
        if not keeps or not isinstance(value, Ref) or value.variable.length is None:
            return False
        return value.variable not in self.rebound and value.variable in written_later(self._routine, place)

    def _slice(self, ref: Ref, loop: Loop) -> str:
        """Write all of a loop's elements of an array."""
        name = self._names[ref.variable]
        length = ref.variable.length
        if length is None or ref.offset is None:
            return element(name, ref)
        start, stop = loop.start + ref.offset, loop.stop + ref.offset
        if start == 0 and stop == length:
            return name
        return f"{name}[{start or ''}:{stop if stop != length else ''}]"
