"""The step's exact first derivatives in C: files of their own, beside the kernel's, where a scene asks for them."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.c_language.names import declared, macros, signal
from tmm_gen.c_language.wrap import INDENT, WIDTH, comment
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.gathered import Gathered
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.lanes import LaneBody
from tmm_gen.emit.c.structs import described, dimension
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.program.count import count_routine
from tmm_gen.program.statements import Sensitivities
from tmm_gen.program.variables import Variable

LANES = 8
"""Directions side by side, unless the compiler is told otherwise: what the widest vector registers hold."""

LANES_OF_512_BITS = 16
"""The same for arms in a plane where registers are that wide. A sweep waits for its own last result, and two registers'
worth of directions take the time of one (measured: 5 to 20 links, gcc 12, Zen 5). With fewer or narrower registers, and
with the many sums of an arm in space, the numbers no longer fit: there eight are quicker."""


@dataclass(frozen=True)
class Derivatives:
    """What the templates of the sensitivities ask for.

    Parameters
    ----------
    kernel : Kernel
        Of the step itself.
    found : Sensitivities
        Lowered.
    """

    kernel: Kernel
    found: Sensitivities

    @property
    def linearise(self) -> Body:
        """The body of the step that keeps its point."""
        return self.kernel.body(self.found.linearise, "linearise")

    @property
    def tangent(self) -> LaneBody:
        """The body of the tangent."""
        return LaneBody(self.kernel.program, self.found.tangent, "tangent", self.kernel.real)

    @property
    def gathered(self) -> Gathered | None:
        """Slopes by all that the step follows, where tangents are carried by them too."""
        reduced = self.found.reduced
        return None if reduced is None else Gathered(self.kernel, reduced, len(self.found.inputs))

    @property
    def cost(self) -> str:
        """What a direction costs, in words."""
        operations = count_routine(self.found.tangent).total
        return f"{operations} operations, {operations / self.kernel.program.stations:.4g} per station"

    @property
    def lanes(self) -> int:
        """Directions side by side by default."""
        return LANES

    @property
    def lanes_of_512_bits(self) -> int:
        """The same where a register holds 512 bits."""
        return LANES_OF_512_BITS if self.kernel.scene.spatial is None else LANES

    def members(self, which: str) -> list[str]:
        """Return the members of the struct of the point, the state's changes or the inputs' changes."""
        variables: tuple[Variable, ...] = {
            "point": self.found.point,
            "state": self.found.state,
            "inputs": self.found.inputs,
        }[which]
        name = self.kernel.program.name
        lanes = "" if which == "point" else f"[{macros(name)}_LANES]"
        lines: list[str] = []
        for variable in variables:
            head, tail = f"{INDENT}{name}_real ", f"{self._dimension(variable)}{lanes};"
            remark = f" /**< {described(variable)} */"
            if len(head + variable.name + tail + remark) > WIDTH:
                lines += comment(described(variable), 1, "/**")
                remark = ""
            if which == "inputs":
                lines += declared(signal(variable.name, name), head, tail, remark)
            else:
                lines.append(f"{head}{variable.name}{tail}{remark}")
        return lines or [f"{INDENT}{name}_real none; /**< unused: C has no empty structs */"]

    def _dimension(self, variable: Variable) -> str:
        original = next((v for v in self.kernel.program.inputs if v.name == variable.name), variable)
        return dimension(original if variable in self.found.inputs else variable, self.kernel.program)


def emit_sensitivities(kernel: Kernel) -> dict[str, str]:
    """Return ``c/<name>_sensitivities.h`` and ``.c``; nothing where the scene does not ask for them.

    Parameters
    ----------
    kernel : Kernel
        Of the step itself.

    Raises
    ------
    UserError
        If the kernel binds its parameters or has sines of its own: this file would have to share them.
    """
    found = kernel.program.sensitivities
    if found is None:
        return {}
    if kernel.bound or kernel.circle is not None:
        raise UserError(
            f"scene '{kernel.program.name}': emit.sensitivities = true goes with emit.parameters = 'free' and the C "
            "library's sine and cosine; remove emit.parameters and emit.trigonometry, or the sensitivities"
        )
    name = kernel.program.name
    return {
        f"c/{name}_sensitivities.{end}": sealed(
            render(
                f"c/sensitivities.{end}.jinja",
                kernel=kernel,
                derivatives=Derivatives(kernel, found),
                name=name,
                NAME=macros(name),
            )
        )
        for end in ("h", "c")
    }
