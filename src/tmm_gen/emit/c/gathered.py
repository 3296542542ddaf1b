"""Slopes of a step by all it follows, gathered once, and changes carried over the step by products with them, in C."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from tmm_gen.c_language.names import local_name
from tmm_gen.c_language.wrap import INDENT
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.lanes import LaneBody
from tmm_gen.emit.c.printer import CPrinter
from tmm_gen.program.count import count_routine
from tmm_gen.program.sensitivities.reduced import Reduced


@dataclass(frozen=True)
class Gathered:
    """What the templates of the sensitivities ask for.

    Parameters
    ----------
    kernel : Kernel
        Of the step itself.
    reduced : Reduced
        What the step follows.
    inputs : int
        How many there are.
    """

    kernel: Kernel
    reduced: Reduced
    inputs: int

    @property
    def predicted(self) -> list[str]:
        """Local variables that what is predicted changes by."""
        return [local_name(v) for v in self.reduced.predicted]

    @property
    def answer(self) -> str:
        """The member that what the step finds changes."""
        return self.reduced.answer.name

    @property
    def followed(self) -> str:
        """What a step follows, in words."""
        told = [v.doc.removeprefix("change of ") for v in self.reduced.predicted]
        return f"{', '.join(told)}, and inputs"

    @property
    def carry(self) -> CarryBody:
        """The body of what carries changes over."""
        return CarryBody(self.kernel.program, self.reduced.carry, "tangent", self.kernel.real)

    @property
    def cost(self) -> int:
        """Operations of a direction that is carried so."""
        stations = self.kernel.program.stations
        follows = len(self.reduced.predicted) * stations + self.inputs
        return count_routine(self.reduced.carry).total + 2 * stations * follows

    def seeds(self, which: int) -> list[str]:
        """Write the changes of the state by which one of what is predicted changes by one, at station j in lane k."""
        printer = CPrinter(self.kernel.real, lambda ref: f"model->{ref.variable.name}")
        return [f"changes.{v.name}[j][k] = {printer.text(value)};" for v, value in self.reduced.seeds[which]]


@dataclass(frozen=True)
class CarryBody(LaneBody):
    """The body of what carries changes over: ahead of what the step finds, and behind it."""

    @property
    def head(self) -> str:
        """Locals that hold scalars of the model."""
        lines = [f"{INDENT}const real {local_name(v)} = {self._placed(v)};" for v in self._hoisted()]
        return "\n".join(lines)

    @property
    def ahead(self) -> str:
        """What is predicted."""
        return "\n".join(self._part(0))

    @property
    def behind(self) -> str:
        """The motion at the end of the step."""
        return "\n".join(self._part(1))

    def _part(self, number: int) -> Iterator[str]:
        hoisted, narrow = frozenset(self._hoisted()), self._narrow()
        printer = CPrinter(self.real, lambda ref: self._lane(ref, hoisted, narrow))
        yield from self._section(self.routine.sections[number], printer, narrow)
