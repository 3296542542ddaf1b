"""A study: every configuration of a grid evaluated, then what each family costs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from tmm_gen.native.timing import ROUNDS, Cost
from tmm_gen.scene import Scene, SceneError
from tmm_gen.study.chosen_steps import ChosenSteps, runs, serving
from tmm_gen.study.configuration import Configuration, Family, own
from tmm_gen.study.cost import measure_costs
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.modelling import Modelling, depends_on_links, modelling_errors
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.pareto import pareto_front
from tmm_gen.study.point import Point
from tmm_gen.study.references import References
from tmm_gen.study.serial import Serial
from tmm_gen.study.store import Store
from tmm_gen.study.tasks import Executor, Task, make_tasks
from tmm_gen.study.truth import Truth

Advance = Callable[[float, str], None]


@dataclass(frozen=True, eq=False)
class Study:
    """What a study has found.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What the arm went through.
    travel : float
        How far the output gets from its start, in its unit: what relative errors are relative to.
    points : tuple of Point
        In the order of the grid.
    modelling : mapping from int to Modelling
        Of a beam: what its number of links costs in accuracy, by number.
    chosen : tuple of ChosenSteps
        Runs by tolerances, where any were asked for.
    stored : int
        How many of the points were in the store already.
    """

    scene: Scene
    excitation: Excitation
    travel: float
    points: tuple[Point, ...]
    modelling: Mapping[int, Modelling] = field(default_factory=dict)
    chosen: tuple[ChosenSteps, ...] = ()
    stored: int = 0

    @property
    def varies_links(self) -> bool:
        """Whether the grid has more than one number of links."""
        return len({point.configuration.family.links for point in self.points}) > 1

    def error(self, point: Point) -> float:
        """Return the error a point is judged by: with modelling error where links vary, else the time error."""
        found = point.result.total_error if self.varies_links else point.result.error
        return float("inf") if found is None else found

    @property
    def timed(self) -> bool:
        """Whether times were measured."""
        return any(point.cost for point in self.points)

    def price(self, point: Point) -> float | None:
        """Return what a simulated second costs: nanoseconds, or operations where no times were measured."""
        return point.ns_per_second if self.timed else point.operations_per_second

    def front(self, price: Callable[[Point], float | None] | None = None) -> list[Point]:
        """Return the points that no other beats in both error and price, cheapest first."""
        cost = price or self.price
        shown = [(p, c) for p in self.points if p.finished and (c := cost(p)) is not None]
        chosen = pareto_front([(self.error(point), value) for point, value in shown])
        return [shown[k][0] for k in chosen]

    def rows(self, points: Sequence[Point]) -> list[dict[str, object]]:
        """Return figures of some points by key, and whether no other beats them."""
        best = set(self.front())
        return [
            {"configuration": each.configuration.family.label, **each.values(), "pareto": each in best}
            for each in points
        ]

    def count(self, outcome: Outcome) -> int:
        """Return how many points have an outcome."""
        return sum(point.result.outcome is outcome for point in self.points)


def run_study(
    scene: Scene,
    excitation: Excitation,
    grid: Sequence[Configuration],
    executor: Executor | None = None,
    store: Path | None = None,
    rounds: int = ROUNDS,
    advance: Advance = lambda count, doing: None,
    tolerances: Sequence[float] = (),
) -> Study:
    """Evaluate a grid of configurations, then measure what they cost.

    Errors and counts are computed first, by the executor; they do not depend on how busy the machine is. Times are
    measured afterwards, here, with nothing else of the study running.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    grid : sequence of Configuration
        What is tried.
    executor : Executor, optional
        By default one task after the other in this process.
    store : Path, optional
        SQLite file that keeps results; what it has already is not computed again.
    rounds : int
        Measurements of each time; none with 0.
    advance : callable
        Called with the units of work done and what is being done: one unit a configuration, one a round, one for
        the references, one a run by a tolerance.
    tolerances : sequence of float
        By each of which every integrator of the grid chooses steps too, beside the grid.

    Raises
    ------
    ReferenceError
        If a reference motion cannot be integrated.
    UserError
        If the output does not move, there is no C compiler, or the store cannot be used.
    """
    if store is not None:
        with Store(store) as kept:
            kept.inspect()
    references = References(scene, excitation, store)
    advance(0, "integrating the reference")
    travel = references.travel()
    possible, truths, refused = _truths(grid, references)
    modelling: dict[int, Modelling] = {}
    links = {n for each in grid if (n := each.family.links) is not None and n in truths}
    # in space the references of more cells take minutes, so that only who varies them waits for it
    if depends_on_links(scene, excitation) and (scene.spatial is None or len(links) > 1):
        modelling = modelling_errors(links | {own(scene).family.links or 1}, references.of)
    advance(1, "computing")
    results: dict[Configuration, Result] = dict(refused)
    tasks = make_tasks(scene, excitation, possible)
    stored = 0 if store is None else _stored(tasks, store)
    for task, result in (executor or Serial()).results(tasks, truths, store):
        results[task.configuration] = _modelled(result, task.configuration, modelling)
        advance(1, task.configuration.family.label)
    chosen: tuple[ChosenSteps, ...] = ()
    if tolerances:
        truth = references.of(own(scene).family.links)
        chosen = tuple(runs(scene, excitation, serving(scene, grid), tolerances, truth, advance))
    costs = _costs(scene, excitation, results, rounds, advance) if rounds else {}
    points = tuple(Point(each, results[each], costs.get(each.family)) for each in grid)
    return Study(scene, excitation, travel, points, modelling, chosen, stored)


def _stored(tasks: Sequence[Task], store: Path) -> int:
    """Return how many results a store has already."""
    with Store(store) as kept:
        return sum(kept.result(task.key) is not None for task in tasks)


def _truths(
    grid: Sequence[Configuration], references: References
) -> tuple[list[Configuration], dict[int | None, Truth], dict[Configuration, Result]]:
    """Return what can be computed, references by number of links, and refusals of numbers of links."""
    truths: dict[int | None, Truth] = {}
    wrong: dict[int | None, str] = {}
    for links in dict.fromkeys(each.family.links for each in grid):
        try:
            truths[links] = references.of(links)
        except SceneError as error:
            wrong[links] = " ".join(str(error).split())
    possible = [each for each in grid if each.family.links in truths]
    refused = {
        each: Result(Outcome.REFUSED, wrong[each.family.links]) for each in grid if each.family.links in wrong
    }
    return possible, truths, refused


def _modelled(result: Result, configuration: Configuration, modelling: Mapping[int, Modelling]) -> Result:
    links = configuration.family.links
    if links is None or links not in modelling:
        return result
    return replace(result, modelling_error=modelling[links].error)


def _costs(
    scene: Scene,
    excitation: Excitation,
    results: Mapping[Configuration, Result],
    rounds: int,
    advance: Advance,
) -> dict[Family, Cost]:
    finished: dict[Family, list[float]] = {}
    for configuration, result in results.items():
        if result.outcome is Outcome.FINISHED:
            finished.setdefault(configuration.family, []).append(configuration.step)
    return measure_costs(scene, excitation, finished, rounds, lambda count: advance(count, "measuring times"))
