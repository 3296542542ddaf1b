"""What the template of a kernel asks for whose step is in vectors."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.c_language.real import Real


@dataclass(frozen=True)
class VectorType:
    """A type of vectors.

    Parameters
    ----------
    real : Real
        Number type.
    parts : int
        How many numbers it holds: an even one.
    """

    real: Real
    parts: int

    @property
    def bytes(self) -> int:
        """Of a vector."""
        return self.parts * self.real.size

    @property
    def integer(self) -> str:
        """Signed integer of the size of a number."""
        return f"int{8 * self.real.size}_t"

    @property
    def real_parts(self) -> str:
        """Where the real part of each part's complex number is."""
        return ", ".join(str(k - k % 2) for k in range(self.parts))

    @property
    def imaginary_parts(self) -> str:
        """Where its imaginary part is."""
        return ", ".join(str(k - k % 2 + 1) for k in range(self.parts))

    @property
    def turned(self) -> str:
        """Where the other part of each part's complex number is."""
        return ", ".join(str(k + 1 - 2 * (k % 2)) for k in range(self.parts))

    def alternating(self, even: float | int, odd: float | int, *, integers: bool = False) -> str:
        """Return the parts of a vector with two values by turns."""
        one, other = (str(v) if integers else self.real.literal(v) for v in (even, odd))
        return ", ".join([one, other] * (self.parts // 2))

    def each(self, function: str) -> str:
        """Return the parts of what a function makes of a vector x."""
        return ", ".join(f"{function}((x)[{k}])" for k in range(self.parts))

    @property
    def all_of(self) -> str:
        """Whether all parts of a mask are set."""
        return " & ".join(f"which[{k}]" for k in range(self.parts))
