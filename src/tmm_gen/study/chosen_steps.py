"""Runs whose steps a tolerance chooses, held against the reference like runs of equal steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene, SceneError
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.stepping import Stepper
from tmm_gen.study.configuration import Configuration, Family, own
from tmm_gen.study.excitation import Excitation, columns
from tmm_gen.study.truth import Truth


@dataclass(frozen=True)
class ChosenSteps:
    """A run by a tolerance.

    Parameters
    ----------
    family : Family
        What took the steps; how often it iterates is left open where the scene does.
    tolerance : float
        Asked for: a share of the way that any link has come.
    reason : str
        Why there is no run; else empty.
    claimed : float, optional
        What the run says of its own error.
    error : float, optional
        Largest distance of the output from the reference at any row, relative to its travel.
    steps, refused : int, optional
        Taken by the run that counts; of these, taken again shorter.
    smallest, largest : float, optional
        Of them, s.
    """

    family: Family
    tolerance: float
    reason: str = ""
    claimed: float | None = None
    error: float | None = None
    steps: int | None = None
    refused: int | None = None
    smallest: float | None = None
    largest: float | None = None

    def values(self) -> dict[str, object]:
        """Return all figures by key, the integrator in place of the family."""
        return {
            "integrator": self.family.integrator,
            **{k: v for k, v in asdict(self).items() if k != "family"},
        }


def serving(scene: Scene, grid: Sequence[Configuration]) -> tuple[Family, ...]:
    """Return what runs of a grid by a tolerance are taken with: in C, all but the integrator as the scene has it."""
    mine = own(scene).family
    named = dict.fromkeys(each.family.integrator for each in grid)
    return tuple(replace(mine, integrator=name) for name in named)


def runs(
    scene: Scene,
    excitation: Excitation,
    families: Sequence[Family],
    tolerances: Sequence[float],
    truth: Truth,
    advance: Callable[[float, str], None],
) -> Iterator[ChosenSteps]:
    """Yield a run of each family by each tolerance; what is refused is a result too, once where no tolerance would do.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    families : sequence of Family
        As of :func:`serving`.
    tolerances : sequence of float
        Shares of the motion.
    truth : Truth
        The reference of the scene with its own links.
    advance : callable
        Called with 1 for each run, and what it was.
    """
    for family in families:
        for tolerance in tolerances:
            found, _, any_other = run_by(scene, excitation, family, tolerance, truth)
            yield found
            advance(1, f"{family.integrator} by a tolerance of {tolerance:g}")
            if not any_other:
                break


def changes_of(family: Family, tolerance: float) -> dict[str, object]:
    """Return the keys of a scene by which it is run so, as :meth:`Scene.replace` takes them."""
    return {"integrator.name": family.integrator, "integrator.tolerance": tolerance}


def run_by(
    scene: Scene, excitation: Excitation, family: Family, tolerance: float, truth: Truth
) -> tuple[ChosenSteps, Callable[[], ChosenSteps], bool]:
    """Return a run, what takes it once more with the same kernel, and whether others may do where it does not."""
    try:
        chosen = scene.replace(**changes_of(family, tolerance))
    except SceneError as error:
        refused = ChosenSteps(family, tolerance, _flat(error))
        return refused, lambda: refused, False
    try:
        kernel = Stepper.of(chosen, "c").kernel
    except UserError as error:
        refused = ChosenSteps(family, tolerance, _flat(error))
        return refused, lambda: refused, True

    def run() -> ChosenSteps:
        return _run(chosen, excitation, family, tolerance, truth, kernel)

    return run(), run, True


def _run(
    chosen: Scene, excitation: Excitation, family: Family, tolerance: float, truth: Truth, kernel: object
) -> ChosenSteps:
    try:
        found = simulate(chosen, excitation.signals, excitation.until, "c", kernel=kernel)
    except UserError as error:
        return ChosenSteps(family, tolerance, _flat(error))
    inside = found.time <= excitation.until * (1.0 + 1e-9)
    there = np.array([found.outputs[name][inside] for name in columns(chosen, excitation.output)])
    off = np.linalg.norm(there - truth.at(found.time[inside]), axis=0) / truth.travel
    did, accuracy = found.chosen, found.accuracy
    assert did is not None
    assert accuracy is not None
    return ChosenSteps(
        family,
        tolerance,
        claimed=accuracy.error,
        error=float(np.max(off)),
        steps=did.steps,
        refused=did.refused,
        smallest=did.smallest,
        largest=did.largest,
    )


def _flat(error: UserError) -> str:
    return " ".join(str(error).split())
