"""What a program costs, as numbers."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Footprint:
    """Costs of a program, or a difference of two.

    Parameters
    ----------
    step, output, prepare : int
        Floating-point operations of one call.
    state_bytes, model_bytes : int
        Of the C structs: motion and history; what prepare leaves for the step.
    """

    step: int
    output: int
    prepare: int
    state_bytes: int
    model_bytes: int

    def __sub__(self, other: Footprint) -> Footprint:
        """Return what this costs more than another."""
        return Footprint(
            self.step - other.step,
            self.output - other.output,
            self.prepare - other.prepare,
            self.state_bytes - other.state_bytes,
            self.model_bytes - other.model_bytes,
        )
