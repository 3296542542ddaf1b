"""Many arms in C: the step once more, each of its numbers a vector that holds those of several arms.

The same operations in the same order, so that every arm gets the bits that its own kernel would give it. At
the end of a step arms whose lane a mask has lost take the ordinary step alone, which says what is wrong with them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from tmm_gen.c_language.names import macros, member
from tmm_gen.emit.c.batch_body import TOGETHER, BatchBody
from tmm_gen.emit.c.fence import Fence
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.structs import Struct, dimension
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.passes.contract import contract
from tmm_gen.program.passes.fuse import fuse
from tmm_gen.program.passes.join import join
from tmm_gen.program.statements import Loop, Repeat, Routine

_LOOKED_AHEAD = 64
"""Statements of a station up to which two batches at once are faster: with 31 by a tenth to a seventh, with 89 they are
slower by a twentieth, with 109 by a third."""


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
    def together(self) -> int:
        """How many batches are stepped at once.

        Where a station alone has more to do than a processor looks ahead (in space; stages solved at once), two only
        took registers from each other.
        """
        loops = [s for s in self.kernel.program.main.statements() if isinstance(s, Loop)]
        return 1 if any(len(loop.body) > _LOOKED_AHEAD for loop in loops) else TOGETHER

    @property
    def main(self) -> BatchBody:
        """The body of the step."""
        return replace(self._body(self.kernel.program.main, "step"), together=self.together > 1)

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
        routine = contract(
            join(fuse(routine))
        )  # nothing of one arm is to be done for several stations at once
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
