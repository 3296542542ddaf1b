"""Steps in C whose stages, and systems of eigenvalues, are the parts of vectors.

Nothing leaves such a step on its way: what must hold of vectors is gathered in masks, which are asked before the state
changes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.wrap import INDENT, comment, statement
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.printer import CPrinter
from tmm_gen.emit.c.vector_printer import VectorPrinter
from tmm_gen.program.parts import is_vector
from tmm_gen.program.statements import Assign, Loop, Require, Statement
from tmm_gen.program.variables import Ref, Role, Spread, Variable

_IN_RANGE, _PASSIVE = "in_range", "passive"


@dataclass(frozen=True)
class VectorBody(Body):
    """The body of a step in vectors."""

    def _lines(self) -> Iterator[str]:
        yield from comment("What all angles and all pivots are, as far as they have been seen.", 1)
        for mask in self._masks:
            yield f"{INDENT}mask {mask} = ~(mask){{0}};"
        yield from super()._lines()

    @cached_property
    def _masks(self) -> dict[str, str]:
        """Names of masks, and what is returned where they do not hold."""
        values = list(self.routine.values())
        angles = [a for v in values for a in v.atoms(sp.sin, sp.cos) if is_vector(a)]
        asked = {_IN_RANGE: "OUT_OF_RANGE"} if self.own_circle and angles else {}
        return asked | {_PASSIVE: "VANISHING_PIVOT"}

    @cached_property
    def _first(self) -> tuple[Statement, Assign]:
        """What first changes the state, and the statement that it is in."""
        return next(
            (top, inner)
            for top in self.routine.statements()
            for inner in (top.body if isinstance(top, Loop) else (top,))
            if isinstance(inner, Assign) and inner.target.variable.role is Role.STATE
        )

    def _ahead(self, statement: Statement, depth: int) -> Iterator[str]:
        """Ask the masks before the state changes; within a loop, where that adds to them."""
        top, inner = self._first
        within = isinstance(top, Loop) and any(self._asks(s) for s in top.body)
        if statement is not (inner if within else top):
            return
        for mask, status in self._masks.items():
            yield f"{INDENT * depth}if (!all_of(&{mask})) {{"
            yield f"{INDENT * (depth + 1)}return {macros(self.program.name)}_{status};"
            yield f"{INDENT * depth}}}"

    def _asks(self, inner: Assign | Require) -> bool:
        turns = self.own_circle and any(map(is_vector, inner.value.atoms(sp.sin, sp.cos)))
        return turns or (isinstance(inner, Require) and is_vector(inner.value))

    def _type(self, variable: Variable) -> str:
        return "vector" if variable.spread is not None else super()._type(variable)

    def _printer(self, refer: Callable[[Ref], str]) -> VectorPrinter:
        return VectorPrinter(self.real, refer)

    def _stored(self, assign: Assign, printer: CPrinter) -> str:
        assert isinstance(printer, VectorPrinter)
        return printer.written(assign.value, assign.target.variable.spread)

    def _turned(
        self, angle: sp.Expr, printer: CPrinter, name: str, depth: int, *, refused: bool
    ) -> Iterator[str]:
        if not is_vector(angle):
            yield from super()._turned(angle, printer, name, depth, refused=refused)
            return
        assert isinstance(printer, VectorPrinter)
        text = printer.written(angle, Spread.STAGES)
        yield from statement(f"const vector {name}_angle = {text};", depth)
        yield from statement(
            f"{_IN_RANGE} &= within({name}_angle, {macros(self.program.name)}_LARGEST_ANGLE);", depth
        )
        yield f"{INDENT * depth}circles {name};"
        yield f"{INDENT * depth}circles_of(&{name}_angle, &{name});"

    def _required(self, required: Require, printer: CPrinter, depth: int) -> Iterator[str]:
        if not is_vector(required.value):
            yield from super()._required(required, printer, depth)
            return
        assert isinstance(printer, VectorPrinter)
        text = printer.written(required.value, Spread.SYSTEMS)
        yield from statement(f"{_PASSIVE} &= positive({text});", depth)
