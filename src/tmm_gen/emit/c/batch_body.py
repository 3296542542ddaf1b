"""The body of a step whose numbers are vectors of arms, of one batch or of two at once.

What leaves the ordinary step early clears an arm's lane in a mask here. A recursion waits for itself at each station:
two batches that take their stations by turns fill the time in which each would wait. Their scratch lies side by side,
and every block of statements is done for one batch after the other, which compilers unroll.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.wrap import INDENT, statement
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.circle import Turns
from tmm_gen.emit.c.leaving import Leaving
from tmm_gen.emit.c.printer import CPrinter, element_at
from tmm_gen.emit.c.scalars import Placement, place_scalars
from tmm_gen.program.statements import Assign, Loop
from tmm_gen.program.variables import Role, Variable, refs_in

RIGHT = "right"
"""Mask of the arms that nothing has been found wrong with."""
TOGETHER = 2
"""Batches that go side by side."""
_ALL = "TMM_GEN_ALL"
_CHOSEN = "TMM_GEN_CHOSEN"


@dataclass(frozen=True)
class Masking(Leaving):
    """Writes checks that take arms out of the mask where they fail: no function is left for one arm of many."""

    right: str = RIGHT

    def _unless(self, one: str, other: str, status: str, depth: int) -> list[str]:
        return list(statement(f"{self.right} &= (mask){one} & (mask){other};", depth))

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
    """The body of a function whose numbers are vectors of arms.

    Parameters
    ----------
    together : bool
        Whether it serves several batches at once.
    """

    together: bool = False

    def finite(self) -> str:
        """Return the sum that is finite only in arms whose new state is."""
        sums = self._sums
        assert sums is not None
        printer = self._printer(lambda ref: self._refer(ref, frozenset()))
        terms = [self._sum] if any(sums.inside.values()) else []
        terms += [self._judged(assign, printer) for assign in sums.behind]
        terms += [element_at(self._placed(v), at, self._last) for v, at in sums.ends]
        text = f"const real new_state = {' + '.join(terms) or self._zero};"
        return "\n".join(statement(text, 1 + self._deeper))

    def _stored(self, assign: Assign, printer: CPrinter) -> str:
        value = printer.text(assign.value)
        if not any(refs_in(assign.value)):
            value = f"{_ALL}({value})"
        if self.kind == "step" and assign.target.variable.role is Role.STATE:
            value = f"{_CHOSEN}({self._leaving.right}, {value}, {printer.reference(assign.target)})"
        return value

    @property
    def _zero(self) -> str:
        return f"{_ALL}({super()._zero})"

    @cached_property
    def _leaving(self) -> Masking:
        return Masking(self.program.name, self.real, self.fence, RIGHT + self._which)

    # -- several batches ------------------------------------------------------------------------------

    @property
    def _which(self) -> str:
        """Index of what there is one of for each batch."""
        return "[at]" if self.together else ""

    @property
    def _beside(self) -> str:
        return f"[{TOGETHER}]" if self.together else ""

    @property
    def _zeros(self) -> str:
        return f"{{{', '.join([self._zero] * TOGETHER)}}}" if self.together else self._zero

    @property
    def _deeper(self) -> int:
        return int(self.together)

    @property
    def _sum(self) -> str:
        return super()._sum + self._which

    def _opened(self, depth: int) -> list[str]:
        return [f"{INDENT * depth}TMM_GEN_EACH {{"] if self.together else []

    def _closed(self, depth: int) -> list[str]:
        return [f"{INDENT * depth}}}"] if self.together else []

    def _kept(self, turns: Turns, names: Iterator[str]) -> Turns:
        return Turns(names) if self.together else turns

    def _hoisted(self) -> tuple[Variable, ...]:
        return () if self.together else super()._hoisted()

    def _source(self, variable: Variable) -> str:
        source = super()._source(variable)
        return source.replace("->", "[at]->") if self.together else source

    def _placed(self, variable: Variable) -> str:
        return super()._placed(variable) + (self._which if variable in self._scratch else "")

    @cached_property
    def _placement(self) -> Placement:
        """Let what blocks hand on stand before all of them: one block's own names end with it."""
        found = place_scalars(self.routine)
        if not self.together:
            return found
        inside: dict[int, bool] = {}
        at_top = dict.fromkeys(found.at_top)
        place = 0
        for top in self.routine.statements():
            for inner in top.body if isinstance(top, Loop) else (top,):
                if not isinstance(inner, Assign):
                    continue
                if place in found.constant:
                    if isinstance(top, Loop):
                        inside[place] = found.constant[place]
                    else:
                        at_top[inner.target.variable] = None
                place += 1
        return Placement(tuple(at_top), inside)

    @cached_property
    def _scratch(self) -> frozenset[Variable]:
        """What there is one of for each batch."""
        return frozenset((*self.routine.variables(Role.WORK), *self._placement.at_top))
