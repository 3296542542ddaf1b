"""Statements of routines as those of C functions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count

import sympy as sp

from tmm_gen.c_language.names import local_name, macros
from tmm_gen.c_language.wrap import INDENT, comment, statement
from tmm_gen.emit.c.circle import Turns, angles_in
from tmm_gen.emit.c.finite import TOTAL, check
from tmm_gen.emit.c.function import Function
from tmm_gen.emit.c.guard import Sums, sums_of
from tmm_gen.emit.c.handed import handed_at
from tmm_gen.emit.c.leaving import Leaving
from tmm_gen.emit.c.loops import ends_of_straight, loop_head, station_index
from tmm_gen.emit.c.pair import is_pair
from tmm_gen.emit.c.printer import CPrinter, element_at
from tmm_gen.emit.c.words import sentence
from tmm_gen.program.statements import Assign, Loop, Mark, Repeat, Require, Statement
from tmm_gen.program.variables import Ref, Role, refs_in


@dataclass(frozen=True)
class Body(Function):
    """The body of one function: its statements, checks, and the verdict on the new state."""

    def text(self) -> str:
        """Return the statements, indented by one level."""
        return "\n".join(self._lines()).removeprefix("\n")

    def _lines(self) -> Iterator[str]:
        hoisted = self._hoisted()
        placement = self._placement
        local = frozenset(hoisted)
        printer = self._printer(lambda ref: self._refer(ref, local))
        for variable in hoisted:
            yield (f"{INDENT}const {self._type(variable)} {local_name(variable)} = {self._placed(variable)};")
        for variable in (*self._intermediate(), *self.routine.variables(Role.WORK), *placement.at_top):
            yield from self._declaration(variable)
        sums = self._sums
        if sums is not None and any(sums.inside.values()):
            yield f"{INDENT}real {TOTAL}{self._beside} = {self._zeros}; /* of the new motion: is all of it finite? */"
        positions = iter(range(len(tuple(self.routine.assignments()))))
        names = (f"turn_{number}" for number in count(1))

        def simple(
            inner: Assign | Require, depth: int, turns: Turns, checked: Sequence[sp.Expr] = ()
        ) -> Iterator[str]:
            if self.own_circle:
                for angle, name in turns.new_in(inner.value):
                    refused = self.kind != "output" and angle not in checked
                    yield from self._turned(angle, printer, name, depth, refused=refused)
                printer.turns = dict(turns.known)
            if isinstance(inner, Require):
                yield from self._required(inner, printer, depth)
                return
            yield from self._ahead(inner, depth)
            constant = placement.constant.get(next(positions))
            variable = inner.target.variable
            kind = self._type(variable)
            head = "" if constant is None else f"const {kind} " if constant else f"{kind} "
            target = printer.text(inner.target) if kind == "pair" else printer.reference(inner.target)
            value = self._stored(inner, printer)
            yield from statement(f"{head}{target} = {value};", depth)
            if variable.name in self.fence.largest:
                yield from self._leaving.fenced(target, self.fence.largest[variable.name], depth)
            turns.forget(inner.target)

        straight = Turns(names)
        depth = 1

        for section in self.routine.sections:
            yield ""
            yield from comment(sentence(section.title), depth)
            for top, first, last in ends_of_straight(section.statements):
                if first:
                    yield from self._opened(depth)
                    straight = self._kept(straight, names)
                if isinstance(top, Mark):
                    yield from self._marked(top, printer)
                    straight = Turns(names)
                    depth = 2 if isinstance(top, Repeat) else 1
                elif isinstance(top, Loop):
                    yield from self._ahead(top, depth)
                    checked = self._checked_ahead(top)
                    if checked:
                        yield f"{INDENT * depth}{loop_head(top, self.program)} {{"
                        for angle in checked:
                            yield from self._leaving.in_range(printer.text(angle), depth + 1)
                        yield f"{INDENT * depth}}}"
                    yield f"{INDENT * depth}{loop_head(top, self.program)} {{"
                    yield from self._opened(depth + 1)
                    inside = depth + 1 + self._deeper
                    turns = Turns(names)
                    handed = handed_at(top, self.fence.handed)
                    for place, inner in enumerate(top.body):
                        yield from simple(inner, inside, turns, checked)
                        if place in handed:
                            numbers = [printer.text(ref) for ref in handed[place]]
                            yield from self._leaving.fenced_together(numbers, inside)
                        straight.forget(inner.target) if isinstance(inner, Assign) else None
                    if sums is not None and (terms := sums.inside.get(top, ())):
                        text = " + ".join(self._judged(assign, printer) for assign in terms)
                        yield from statement(f"{self._sum} += {text};", inside)
                    yield from self._closed(depth + 1)
                    yield f"{INDENT * depth}}}"
                else:
                    yield from simple(top, depth + self._deeper, straight)
                if last:
                    yield from self._closed(depth)

    def _ahead(self, statement: Statement, depth: int) -> Iterator[str]:
        """Yield what stands before a statement, also one inside a loop."""
        yield from ()

    def _turned(
        self, angle: sp.Expr, printer: CPrinter, name: str, depth: int, *, refused: bool
    ) -> Iterator[str]:
        """Yield sine and cosine of an angle, and whether it is in range."""
        told = self.kind != "output"
        yield from self._leaving.turned(printer.text(angle), name, depth, refused=refused, told=told)

    def _required(self, required: Require, printer: CPrinter, depth: int) -> Iterator[str]:
        """Yield the check of a pivot."""
        yield from self._leaving.required(required, printer.text(required.value), depth)

    def _stored(self, assign: Assign, printer: CPrinter) -> str:
        """Return what an assignment sets its target to."""
        rounded = self.real.pair and self._type(assign.target.variable) == "real"
        return printer.text(assign.value) + (".high" if rounded else "")

    @property
    def _zero(self) -> str:
        return self.real.literal(0)

    # -- what arms side by side do otherwise ----------------------------------------------------------

    @property
    def _zeros(self) -> str:
        """What the sum of the new state begins with."""
        return self._zero

    @property
    def _deeper(self) -> int:
        """By how many levels statements stand deeper than their loop, or the function."""
        return 0

    @property
    def _sum(self) -> str:
        """The sum of the new state."""
        return TOTAL

    def _opened(self, depth: int) -> list[str]:
        """Return what opens a block of statements."""
        return []

    def _closed(self, depth: int) -> list[str]:
        """Return what closes it."""
        return []

    def _kept(self, turns: Turns, names: Iterator[str]) -> Turns:
        """Return the sines that the next block of straight statements knows."""
        return turns

    def _marked(self, mark: Mark, printer: CPrinter) -> Iterator[str]:
        """Yield where something repeated begins or ends."""
        if isinstance(mark, Repeat):
            yield f"{INDENT}for (int round = 0; round < {mark.most}; ++round) {{"
            return
        left = f"({printer.text(mark.value)}){self._high}"
        yield from statement(f"if (!({left} > {self.real.literal(0.0)})) {{", 2)
        yield f"{INDENT * 3}break;"
        yield f"{INDENT * 2}}}"
        yield f"{INDENT}}}"

    def verdict(self) -> str:
        """Return the check that leaves the function unless the new state is finite."""
        sums = self._sums
        if sums is None:
            raise ValueError(f"{self.routine.name} does not add up its state")
        printer = self._printer(lambda ref: self._refer(ref, frozenset()))
        terms = [self._sum] if any(sums.inside.values()) else []
        terms += [self._judged(assign, printer) for assign in sums.behind]
        terms += [element_at(self._placed(v), at, self._last) + self._high for v, at in sums.ends]
        if not terms:
            return ""
        return "\n".join(check([" + ".join(terms)], f"{macros(self.program.name)}_NON_FINITE_STATE", 1))

    @cached_property
    def _leaving(self) -> Leaving:
        return Leaving(self.program.name, self.real, self.fence)

    @cached_property
    def _sums(self) -> Sums | None:
        return sums_of(self.routine) if self.judged else None

    def _last(self, entry: int) -> str:
        return station_index(entry, self.program)

    def _judged(self, assign: Assign, printer: CPrinter) -> str:
        """Return a number that is finite only if what an assignment has set is, whose parts may be two."""
        target = printer.reference(assign.target)
        if not self.real.pair or not is_pair(assign.target.variable):
            return target
        return f"({target}.high + {target}.low)" if isinstance(assign.value, Ref) else f"{target}.high"

    def _checked_ahead(self, loop: Loop) -> list[sp.Expr]:
        """Return the angles of a loop that are checked in one of their own before it.

        A compiler does several stations at once only in loops that nothing leaves early.
        """
        if not (self.apart and self.own_circle and loop.parallel) or self.kind == "output":
            return []
        written = {inner.target.variable for inner in loop.body if isinstance(inner, Assign)}
        angles = dict.fromkeys(angle for inner in loop.body for angle in angles_in(inner.value))
        return [angle for angle in angles if not {ref.variable for ref in refs_in(angle)} & written]
