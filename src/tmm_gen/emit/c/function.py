"""A routine as a function of C: where its variables are, how they are declared, written and referred to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from tmm_gen.c_language.names import local_name, member
from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, WIDTH, comment
from tmm_gen.emit.c.fence import Fence
from tmm_gen.emit.c.given import given_element
from tmm_gen.emit.c.pair import PairPrinter, is_pair
from tmm_gen.emit.c.printer import CPrinter
from tmm_gen.emit.c.scalars import Placement, place_scalars
from tmm_gen.emit.c.sources import SOURCES
from tmm_gen.emit.c.structs import described, dimension
from tmm_gen.emit.expressions import element
from tmm_gen.program.statements import Loop, Program, Routine
from tmm_gen.program.variables import SCRATCH, Ref, Role, Variable, refs_in


@dataclass(frozen=True)
class Function:
    """One function, whose statements :mod:`tmm_gen.emit.c.body` writes.

    Parameters
    ----------
    program : Program
        Lowered.
    routine : Routine
        One of its routines.
    kind : str
        Key of :data:`~tmm_gen.emit.c.sources.SOURCES`.
    real : Real
        Number type.
    own_circle : bool
        Whether sine and cosine are the kernel's own instead of the C library's.
    fence : Fence
        What must stay within bounds.
    bound : bool
        Whether parameters and all that follows from them are constants of the file.
    """

    program: Program
    routine: Routine
    kind: str
    real: Real
    own_circle: bool = False
    fence: Fence = field(default_factory=Fence)
    bound: bool = False
    judged: bool = False
    """Whether the new state is added up, for :meth:`verdict` to see whether all of it is finite."""
    apart: bool = False
    """Whether loops over independent stations are to stay free of anything that leaves them early."""

    def reads(self, name: str) -> bool:
        """Whether the function uses one of its pointers."""
        return any(self._source(v) == f"{name}->" for v in self.routine.read() | self.routine.written())

    def _source(self, variable: Variable) -> str:
        if variable.role in SCRATCH:
            return ""
        if variable.role is Role.COEFFICIENT and variable not in self.program.model:
            return ""  # an intermediate result of prepare
        if self.bound and variable.role.bound_at_prepare:
            return ""
        try:
            return SOURCES[self.kind][variable.role]
        except KeyError:
            raise ValueError(f"{self.routine.name} has no access to {variable.name}") from None

    def _placed(self, variable: Variable) -> str:
        """Return where a variable is: a local one, or a member behind its pointer."""
        return f"{self._source(variable)}{member(variable, self.program.name)}"

    def _refer(self, ref: Ref, local: frozenset[Variable]) -> str:
        if ref.variable.role is Role.GIVEN:
            return given_element(ref, self.real)
        return element(local_name(ref.variable) if ref.variable in local else self._placed(ref.variable), ref)

    def _type(self, variable: Variable) -> str:
        return "pair" if self.real.pair and is_pair(variable) else "real"

    @property
    def _high(self) -> str:
        """What stands behind a number to compare it."""
        return ".high" if self.real.pair else ""

    def _hoisted(self) -> tuple[Variable, ...]:
        """Return the scalars read inside loops that never change: they go into locals before the first."""
        inside = {
            ref.variable
            for loop in self.routine.statements()
            if isinstance(loop, Loop)
            for inner in loop.body
            for ref in refs_in(inner.value)
        }
        constant = inside - self.routine.written()
        return tuple(
            v
            for v in (
                self.program.step,
                *self.program.parameters,
                *self.program.coefficients,
                *self.program.inputs,
            )
            if v in constant and v.length is None and self._source(v)
        )

    def _intermediate(self) -> tuple[Variable, ...]:
        if self.bound:
            return ()
        return tuple(v for v in self.routine.variables(Role.COEFFICIENT) if not self._source(v))

    def _declaration(self, variable: Variable) -> list[str]:
        lengths = self._beside + dimension(variable, self.program)
        line = f"{INDENT}{self._type(variable)} {local_name(variable)}{lengths};"
        remark = f" /* {described(variable)} */"
        if variable.doc and len(line) + len(remark) <= WIDTH:
            return [line + remark]
        return [*(comment(described(variable), 1) if variable.doc else ()), line]

    @property
    def _beside(self) -> str:
        """The dimension of scratch that there is more than once."""
        return ""

    @cached_property
    def _placement(self) -> Placement:
        return place_scalars(self.routine)

    def _printer(self, refer: Callable[[Ref], str]) -> CPrinter:
        return PairPrinter(refer) if self.real.pair else CPrinter(self.real, refer)
