"""A scene's budget held against what was measured."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.scene.emit import Budget
from tmm_gen.target.measurement import Measurement


@dataclass(frozen=True)
class BudgetRow:
    """One figure and its bound.

    Parameters
    ----------
    figure : str
        Key: that of :class:`~tmm_gen.target.measurement.Measurement`.
    value : int
        Measured.
    bound : int or None
        What the scene allows.
    meaning : str
        In a few words.
    """

    figure: str
    value: int
    bound: int | None
    meaning: str

    @property
    def passed(self) -> bool:
        """Whether the figure is within its bound; what has none is."""
        return self.bound is None or self.value <= self.bound

    @property
    def excess(self) -> str:
        """By how much the bound is exceeded, in words."""
        assert self.bound is not None
        over = self.value - self.bound
        return f"{self.figure} is {self.value}, {over} ({100.0 * over / self.bound:.1f} %) more than {self.bound}"


def against_budget(found: Measurement, budget: Budget | None) -> tuple[BudgetRow, ...]:
    """Compare a measurement with a budget.

    Parameters
    ----------
    found : Measurement
        Of a scene on a target.
    budget : Budget or None
        ``scene.emit.budget``.
    """
    allowed = budget or Budget()
    proved = "proved from the call graph" if found.stack_proved else "as used by a run"
    return (
        BudgetRow(
            "instructions_per_step",
            found.instructions_per_step,
            allowed.instructions,
            "longest step of the run",
        ),
        BudgetRow(
            "code_bytes", found.code_bytes, allowed.flash, "all functions, with those of the C library"
        ),
        BudgetRow("ram_bytes", found.ram_bytes, allowed.ram, "what the caller keeps"),
        BudgetRow("stack_bytes", found.stack_bytes, allowed.stack, f"deepest stack of a step, {proved}"),
    )
