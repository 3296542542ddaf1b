"""Many arms in C: the step once more, each of its numbers a vector that holds those of several arms.

The same operations in the same order, so that every arm gets the bits that its own kernel would give it. What leaves
the ordinary step early clears an arm's lane in a mask here; at the end those arms alone take the ordinary step, which
says what is wrong with them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from tmm_gen.c_language.names import macros, member
from tmm_gen.c_language.wrap import INDENT, statement
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.fence import Fence
from tmm_gen.emit.c.finite import TOTAL
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.leaving import Leaving
from tmm_gen.emit.c.printer import CPrinter, element_at
from tmm_gen.emit.c.structs import Struct, dimension
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.statements import Assign, Repeat, Routine
from tmm_gen.program.variables import Role, refs_in

RIGHT = "right"
"""Mask of the arms that nothing has been found wrong with."""
_ALL = "TMM_GEN_ALL"
_CHOSEN = "TMM_GEN_CHOSEN"


@dataclass(frozen=True)
class Masking(Leaving):
    """Writes checks that take arms out of the mask where they fail: no function is left for one arm of many."""

    def _unless(self, one: str, other: str, status: str, depth: int) -> list[str]:
        return list(statement(f"{RIGHT} &= (mask){one} & (mask){other};", depth))

    def _within(self, value: str, bound: str, relation: str, depth: int) -> list[str]:
        return self._unless(f"({value} {relation} {bound})", f"(-{value} {relation} {bound})", "", depth)

    def fenced(self, value: str, largest: float, depth: int) -> list[str]:
        """Return the check of a number's size."""
        return self._within(value, self.real.literal(largest), "<", depth)

    def fenced_together(self, values: Sequence[str], depth: int) -> Iterator[str]:
        """Yield checks that each number is below its share: so is then the sum; other arms are asked alone."""
        share = self.fence.sum / 2.0 ** math.ceil(math.log2(len(values)))
        for value in values:
            yield from self._within(value, self.real.literal(share), "<", depth)

    def turned(self, angle: str, name: str, depth: int, *, refused: bool, told: bool) -> Iterator[str]:
        """Yield sines and cosines of the angles of all arms; nothing is told to a prover."""
        yield from statement(f"const real {name}_angle = {angle};", depth)
        if refused:
            yield from self._within(f"{name}_angle", f"{macros(self.name)}_LARGEST_ANGLE", "<=", depth)
        yield f"{INDENT * depth}circle {name};"
        yield f"{INDENT * depth}circles_of(&{name}_angle, &{name});"


@dataclass(frozen=True)
class BatchBody(Body):
    """The body of a function whose numbers are vectors of arms."""

    def finite(self) -> str:
        """Return the sum that is finite only in arms whose new state is."""
        sums = self._sums
        assert sums is not None
        printer = self._printer(lambda ref: self._refer(ref, frozenset()))
        terms = [TOTAL] if any(sums.inside.values()) else []
        terms += [self._judged(assign, printer) for assign in sums.behind]
        terms += [element_at(self._placed(v), at, self._last) for v, at in sums.ends]
        return "\n".join(statement(f"const real new_state = {' + '.join(terms) or self._zero};", 1))

    def _stored(self, assign: Assign, printer: CPrinter) -> str:
        value = printer.text(assign.value)
        if not any(refs_in(assign.value)):
            value = f"{_ALL}({value})"
        if self.kind == "step" and assign.target.variable.role is Role.STATE:
            value = f"{_CHOSEN}({RIGHT}, {value}, {printer.reference(assign.target)})"
        return value

    @property
    def _zero(self) -> str:
        return f"{_ALL}({super()._zero})"

    @cached_property
    def _leaving(self) -> Masking:
        return Masking(self.program.name, self.real, self.fence)


@dataclass(frozen=True)
class Batch:
    """What the templates of a kernel for many arms ask for.

    Parameters
    ----------
    kernel : Kernel
        Of one arm.
    arms : int
        Side by side.
    """

    kernel: Kernel
    arms: int

    @property
    def bytes(self) -> int:
        """Of a vector."""
        return self.arms * self.kernel.real.size

    @property
    def integer(self) -> str:
        """Signed integer of the size of a number."""
        return f"int{8 * self.kernel.real.size}_t"

    @property
    def sign_shift(self) -> int:
        """How far the second bit of an integer is from its sign."""
        return 8 * self.kernel.real.size - 2

    @property
    def main(self) -> BatchBody:
        """The body of the step."""
        return self._body(self.kernel.program.main, "step")

    @property
    def startup(self) -> list[BatchBody]:
        """The bodies of the integrator's first steps."""
        return [self._body(routine, "step") for routine in self.kernel.program.startup]

    @property
    def output(self) -> BatchBody:
        """The body of output."""
        return self._body(self.kernel.program.output, "output")

    def _body(self, routine: Routine, kind: str) -> BatchBody:
        kernel = self.kernel
        if any(isinstance(mark, Repeat) for mark in routine.statements()):
            raise ValueError(f"{routine.name}: arms side by side cannot each repeat as often as they need")
        own = kernel.circle is not None
        fence = kernel.fences.get(routine.name, Fence())
        return BatchBody(kernel.program, routine, kind, kernel.real, own, fence, judged=kind == "step")

    def fields(self, which: str) -> list[tuple[str, str]]:
        """Return the members of a struct as the sources call them, and the length of arrays, "" for scalars."""
        name = self.kernel.program.name
        return [
            (member(v, name), dimension(v, self.kernel.program)[1:-1]) for v in self._struct(which).variables
        ]

    @property
    def counted(self) -> bool:
        """Whether the state counts start-up steps."""
        return self._struct("state").counter

    def _struct(self, which: str) -> Struct:
        return self.kernel.structs[which]


def emit_batch(kernel: Kernel) -> dict[str, str]:
    """Return ``c/<name>_batch.h`` and ``.c``; nothing where the scene does not ask for them.

    Parameters
    ----------
    kernel : Kernel
        Of one arm.
    """
    arms = kernel.scene.emit.batch
    if arms is None:
        return {}
    name = kernel.program.name
    words = {"kernel": kernel, "batch": Batch(kernel, arms), "name": name, "NAME": macros(name)}
    return {f"c/{name}_batch.{end}": sealed(render(f"c/batch.{end}.jinja", **words)) for end in ("h", "c")}
