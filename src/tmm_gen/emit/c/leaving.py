"""What leaves a function of C, and what a prover is told where it went on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, statement
from tmm_gen.emit.c.circle import error_of
from tmm_gen.emit.c.fence import Fence
from tmm_gen.program.statements import Require


@dataclass(frozen=True)
class Leaving:
    """Writes checks of numbers, given as texts, that return a status where they fail.

    Parameters
    ----------
    name : str
        Of the kernel.
    real : Real
        Number type.
    fence : Fence
        Bounds of intermediate results.
    """

    name: str
    real: Real
    fence: Fence

    def required(self, required: Require, value: str, depth: int) -> list[str]:
        """Return the check of a pivot."""
        least, number = self.real.literal(self.fence.least_of(required)), value + self._high
        largest = self.real.largest_name
        return self._unless(f"({number} > {least})", f"({number} <= {largest})", "VANISHING_PIVOT", depth)

    def fenced(self, value: str, largest: float, depth: int) -> list[str]:
        """Return the check of a number's size."""
        number, pad = value + self._high, INDENT * depth
        size = f"{self.real.function('fabs')}({number})"
        lines = self._leave(f"!({size} < {self.real.literal(largest)})", "OUT_OF_RANGE", depth)
        # one comparison is faster than two, but a prover does not conclude from a size to its number
        lines.append(f"{pad}/*@ admit -{largest!r} < {number} < {largest!r}; */")
        if self.real.pair:  # to a prover, the lower part is still that of a number not looked at
            small = f"0x1p-24 * {largest!r}"
            lines.append(f"{pad}/*@ admit -{small} <= {value}.low <= {small}; */")
        return lines

    def fenced_together(self, values: Sequence[str], depth: int) -> Iterator[str]:
        """Yield one check of the sizes of numbers: rounding is monotone, so none exceeds their sum."""
        largest = self.fence.sum
        numbers = [value + self._high for value in values]
        sizes = " + ".join(f"{self.real.function('fabs')}({number})" for number in numbers)
        yield from self._leave(f"!({sizes} < {self.real.literal(largest)})", "OUT_OF_RANGE", depth)
        # a prover does not conclude from a sum of sizes to its terms
        for number in numbers:
            yield f"{INDENT * depth}/*@ admit -{largest!r} < {number} < {largest!r}; */"

    def in_range(self, angle: str, depth: int) -> list[str]:
        """Return the check of an angle."""
        largest = f"{macros(self.name)}_LARGEST_ANGLE"
        size = f"{self.real.function('fabs')}({angle}{self._high})"
        return self._leave(f"!({size} <= {largest})", "OUT_OF_RANGE", depth)

    def turned(self, angle: str, name: str, depth: int, *, refused: bool, told: bool) -> Iterator[str]:
        """Yield sine and cosine of an angle.

        Parameters
        ----------
        angle, name : str
            The angle, and what both are called.
        depth : int
            Of indentation.
        refused : bool
            Whether the function leaves here where the angle is out of range.
        told : bool
            Whether a prover is told their bounds, where it needs them.
        """
        if refused:
            yield from self.in_range(angle, depth)
        yield from statement(f"const circle {name} = circle_of({angle});", depth)
        if self.fence.handed and told:
            # the circle is right to its error up to the largest angle; a prover sees polynomials of any angle
            most = 1.0 + error_of(self.real)
            for which in ("sine", "cosine"):
                number = f"{name}.{which}{self._high}"
                yield f"{INDENT * depth}/*@ admit {-most!r} <= {number} <= {most!r}; */"

    @property
    def _high(self) -> str:
        """What stands behind a number to compare it."""
        return ".high" if self.real.pair else ""

    def _unless(self, one: str, other: str, status: str, depth: int) -> list[str]:
        return self._leave(f"!{one} || !{other}", status, depth)

    def _leave(self, condition: str, status: str, depth: int) -> list[str]:
        pad = INDENT * depth
        return [
            *statement(f"if ({condition}) {{", depth),
            f"{pad}{INDENT}return {macros(self.name)}_{status};",
            f"{pad}}}",
        ]
