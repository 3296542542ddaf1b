"""The largest tolerance within a bound that keeps it, for each integrator, and what a run by it takes.

A tolerance is no larger than the bound, whatever one run shows: it is a promise for other loads too.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.integrator import COARSEST, FINEST
from tmm_gen.study.chosen_steps import ChosenSteps, run_by
from tmm_gen.study.configuration import Family
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.truth import Truth

_RUNGS = [float(f"{digit}e{power}") for power in range(-10, 1) for digit in (1, 3)]
_LADDER = [rung for rung in _RUNGS if FINEST <= rung <= COARSEST]
"""Tolerances that are tried."""

_MOST = 6
"""So many are, at most, from the bound down: a tolerance is a share of another way than that of the output."""


@dataclass(frozen=True)
class ByTolerance:
    """A run by the largest tolerance that keeps the bound.

    Parameters
    ----------
    run : ChosenSteps
        What it did.
    ns_per_second : float
        Nanoseconds of this machine for a simulated second of a further run of the compiled kernel: all of it, with what
        chooses and measures.
    """

    run: ChosenSteps
    ns_per_second: float

    def values(self) -> dict[str, object]:
        """Return all figures by key."""
        return {**self.run.values(), "ns_per_simulated_second": self.ns_per_second}


def require_desktop(scene: Scene, target: str | None, *, auto_links: bool) -> None:
    """Refuse to look for tolerances where steps have to be all alike, or links are chosen.

    Raises
    ------
    UserError
        If there is a microcontroller to keep a budget on, or the number of links is open.
    """
    what = "--tolerances: steps of chosen length are for runs on a computer"
    if target is not None:
        raise UserError(f"{what}, and a controller's are all alike. Leave out --target, or --tolerances.")
    if scene.emit.budget is not None:
        raise UserError(
            f"{what}, and [emit.budget] is for a controller, whose steps are all alike. Remove it, or --tolerances."
        )
    if auto_links:
        raise UserError(
            "--tolerances: are looked for with the scene's own links, not where these are open. "
            "Write their number into the scene, and leave out --links."
        )


def tolerances_within(
    scene: Scene,
    excitation: Excitation,
    families: Sequence[Family],
    bound: float,
    truth: Truth,
    advance: Callable[[float, str], None],
) -> Iterator[ByTolerance]:
    """Yield, of each family that has one, the run by the largest tolerance that keeps a bound.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    families : sequence of Family
        As of :func:`tmm_gen.study.chosen_steps.serving`.
    bound : float
        On the error of the output, relative to its travel.
    truth : Truth
        The reference of the scene with its own links.
    advance : callable
        Called with 1 for each family, and which it is.
    """
    for family in families:
        advance(1, f"{family.integrator} by a tolerance")
        found = _largest(scene, excitation, family, bound, truth)
        if found is None:
            continue
        # once more, with its kernel at hand: how long a user waits for it
        began = time.thread_time_ns()
        again = found[1]()
        taken = time.thread_time_ns() - began
        if again.error is not None and again.error <= bound:
            yield ByTolerance(again, taken / excitation.until)


def _largest(
    scene: Scene, excitation: Excitation, family: Family, bound: float, truth: Truth
) -> tuple[ChosenSteps, Callable[[], ChosenSteps]] | None:
    """Return the run by the largest tolerance that keeps a bound, and what takes it again."""
    within = [rung for rung in reversed(_LADDER) if rung <= bound]
    for tolerance in within[:_MOST]:
        found, again, any_other = run_by(scene, excitation, family, tolerance, truth)
        if found.error is not None and found.error <= bound:
            return found, again
        if not any_other:
            break
    return None
