"""Bodies of C functions that do the same for several directions at once, side by side in memory.

Every number becomes an array of as many lanes as there are directions, and every statement an inner loop over them:
the last index runs fastest, so that compilers turn the inner loop into vector instructions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from tmm_gen.c_language.names import local_name, macros
from tmm_gen.c_language.wrap import INDENT, comment, statement
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.loops import loop_head
from tmm_gen.emit.c.printer import CPrinter
from tmm_gen.emit.c.reached import Reached
from tmm_gen.emit.c.words import sentence
from tmm_gen.program.passes.accesses import accesses, first_uses
from tmm_gen.program.statements import Assign, Loop, Section, Statement
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable

LANE = "k"
_WIDE = SCRATCH | {Role.TANGENT, Role.INPUT_TANGENT}


@dataclass(frozen=True)
class LaneBody(Body):
    """The body of a function whose state, inputs and scratch have lanes; model and point have none."""

    @property
    def lanes(self) -> str:
        """The macro that says how many directions there are."""
        return f"{macros(self.program.name)}_LANES"

    def _lines(self) -> Iterator[str]:
        hoisted = frozenset(self._hoisted())
        narrow = self._narrow()
        printer = CPrinter(self.real, lambda ref: self._lane(ref, hoisted, narrow))
        for variable in self._hoisted():
            yield f"{INDENT}const real {local_name(variable)} = {self._placed(variable)};"
        for variable in (*self.routine.variables(Role.WORK), *self.routine.variables(Role.LOCAL)):
            if variable not in narrow:
                yield from self._wide_declaration(variable)
        if self.begins_late:
            yield f"{INDENT}int reached; /* whether something that counts has changed at a station so far */"
        for section in self.routine.sections:
            yield ""
            yield from self._section(section, printer, narrow)

    @property
    def begins_late(self) -> bool:
        """Whether stations are left out that no change has reached."""
        return any(isinstance(section, Reached) for section in self.routine.sections)

    def _section(self, section: Section, printer: CPrinter, narrow: frozenset[Variable]) -> Iterator[str]:
        yield from comment(sentence(section.title), 1)
        if isinstance(section, Reached):
            yield f"{INDENT}reached = 0;"
        for is_loop, group in groupby(section.statements, lambda s: isinstance(s, Loop)):
            if not is_loop:
                yield from self._for_lanes(tuple(group), printer, narrow, 1)
                continue
            for loop in group:
                assert isinstance(loop, Loop)
                yield f"{INDENT}{loop_head(loop, self.program)} {{"
                if isinstance(section, Reached):
                    yield from self._asked(section, loop)
                yield from self._for_lanes(loop.body, printer, narrow, 2)
                yield f"{INDENT}}}"

    def _asked(self, section: Reached, loop: Loop) -> Iterator[str]:
        """Yield what leaves out the stations of a visit where nothing has changed so far."""
        places = [
            f"{local_name(v)}[{f'j + {k}' if k else 'j'}]"
            for v in section.follows
            for k in range(loop.stride)
        ]
        yield from statement(f"reached = reached || {' || '.join(f'moves({each})' for each in places)};", 2)
        yield f"{INDENT * 2}if (!reached) {{"
        yield f"{INDENT * 3}continue;"
        yield f"{INDENT * 2}}}"

    def _for_lanes(
        self, statements: tuple[Statement, ...], printer: CPrinter, narrow: frozenset[Variable], depth: int
    ) -> Iterator[str]:
        pad = INDENT * depth
        yield f"{pad}for (int {LANE} = 0; {LANE} < {self.lanes}; ++{LANE}) {{"
        declared: set[Variable] = set()
        targets = [s.target.variable for s in statements if isinstance(s, Assign)]
        for inner in statements:
            if not isinstance(inner, Assign):
                raise ValueError(f"{self.routine.name}: a tangent has no requirements")
            variable = inner.target.variable
            head = ""
            if variable in narrow and variable not in declared:
                declared.add(variable)
                head = "real " if targets.count(variable) > 1 else "const real "
            text = f"{head}{printer.text(inner.target)} = {printer.text(inner.value)};"
            yield from statement(text, depth + 1)
        yield f"{pad}}}"

    def _lane(self, ref: Ref, hoisted: frozenset[Variable], narrow: frozenset[Variable]) -> str:
        text = self._refer(ref, hoisted)
        return f"{text}[{LANE}]" if ref.variable.role in _WIDE and ref.variable not in narrow else text

    def _narrow(self) -> frozenset[Variable]:
        """Return the scratch scalars that every loop sets before it reads them: they need no memory for their lanes."""
        statements = tuple(self.routine.statements())
        return frozenset(
            variable
            for variable in self.routine.variables(Role.LOCAL)
            if all(
                isinstance(s, Loop) and first_uses(s)[variable]
                for s in statements
                if any(a.variable == variable for a in accesses(s))
            )
        )

    def _wide_declaration(self, variable: Variable) -> list[str]:
        (*before, line) = self._declaration(variable)
        head, end, remark = line.partition(";")
        return [*before, f"{head}[{self.lanes}]{end}{remark}"]
