"""The cheapest way to compute a scene within bounds on error and time, verified by running it afresh."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from tmm_gen.errors import UserError
from tmm_gen.native.timing import ROUNDS, Cost
from tmm_gen.scene import Scene
from tmm_gen.study.bounds import ErrorBound
from tmm_gen.study.budgets import Allowance
from tmm_gen.study.by_tolerance import ByTolerance, tolerances_within
from tmm_gen.study.chosen_steps import serving
from tmm_gen.study.configuration import Configuration, Family, own
from tmm_gen.study.cost import measure_costs, timed_step
from tmm_gen.study.evaluate import evaluate
from tmm_gen.study.excitation import Excitation, unit
from tmm_gen.study.grid import Axes, families
from tmm_gen.study.link_count import fewest_links
from tmm_gen.study.outcome import Result
from tmm_gen.study.point import Point
from tmm_gen.study.references import References
from tmm_gen.study.search import Searched, longest_step
from tmm_gen.study.verify import Verified, verify
from tmm_gen.study.winner import Winner

Advance = Callable[[float, str], None]

_DEARER = 20.0
"""A family that needs so many times the operations of the best so far is not followed to still shorter steps."""

_SHRINK = 0.95
_TRIES = 8


@dataclass(frozen=True, eq=False)
class Tuning:
    """What a search has found.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What the arm went through.
    travel : float
        How far the output gets from its start, in its unit.
    max_error, max_time : float
        Bounds: relative to the travel, and seconds of computing for a simulated second.
    candidates : tuple of Point
        The longest good step of each family, cheapest first; those within both bounds and the budget come first.
    nearest : tuple of Point
        The most accurate step of each family that never was good, most accurate first.
    over_budget : mapping from Family to str
        Why families do not fit the scene's budget.
    own : Point
        The scene as it was.
    chosen : Point, optional
        The winner.
    verified : Verified, optional
        What the winner does when run afresh.
    beyond : tuple of (Configuration, Result), optional
        The next longer step of the winner, which is not accurate enough.
    by_tolerance : tuple of ByTolerance
        Runs whose steps a tolerance chooses, where any were asked for, cheapest first; all keep the bound on the error.
    """

    scene: Scene
    excitation: Excitation
    travel: float
    max_error: float
    max_time: float
    candidates: tuple[Point, ...]
    nearest: tuple[Point, ...]
    over_budget: Mapping[Family, str]
    own: Point
    chosen: Point | None = None
    verified: Verified | None = None
    beyond: tuple[Configuration, Result] | None = None
    by_tolerance: tuple[ByTolerance, ...] = ()

    @property
    def cheaper(self) -> ByTolerance | None:
        """The run by a tolerance that keeps both bounds and takes less than equal steps; None where these win."""
        equal = 1e9 * self.max_time if self.verified is None else self.verified.ns_per_second
        return next((each for each in self.by_tolerance[:1] if each.ns_per_second <= equal), None)

    @property
    def winner(self) -> Winner | None:
        """What keeps all bounds in the least time; None where nothing keeps them."""
        return self.of_equal_steps if self.cheaper is None else Winner.by_tolerance(self.cheaper)

    @property
    def of_equal_steps(self) -> Winner | None:
        """The same among runs of equal steps."""
        if self.chosen is None or self.verified is None:
            return None
        return Winner.of_equal_steps(self.chosen, self.verified)

    @property
    def found(self) -> bool:
        """Whether anything keeps all bounds."""
        return self.winner is not None

    @property
    def unit(self) -> str:
        """Of the output."""
        return unit(self.scene, self.excitation.output)

    def rows(self) -> Iterator[dict[str, object]]:
        """Yield a row of figures for each family: the good ones, cheapest first, then the others."""
        for point in (*self.candidates, *self.nearest):
            ns, family = point.ns_per_second, point.configuration.family
            good = point.error <= self.max_error and ns is not None and ns <= 1e9 * self.max_time
            yield {
                "configuration": family.label,
                **point.values(),
                "fits": good and family not in self.over_budget,
                "over_budget": self.over_budget.get(family),
            }


def tune(
    scene: Scene,
    excitation: Excitation,
    max_error: ErrorBound,
    max_time: float,
    axes: Axes,
    auto_links: bool = False,
    allowance: Allowance | None = None,
    rounds: int = ROUNDS,
    advance: Advance = lambda count, doing: None,
    *,
    tolerances: bool = False,
) -> Tuning:
    """Search the cheapest configuration within bounds.

    Parameters
    ----------
    scene : Scene
        As the user wrote it.
    excitation : Excitation
        What it goes through.
    max_error : ErrorBound
        On the largest error of the output at any instant: the time error; with `auto_links`, modelling error included.
    max_time : float
        Seconds of computing for a simulated second, on this machine.
    axes : Axes
        What may be chosen; its steps are not looked at.
    auto_links : bool
        Whether the number of links of the beam may be chosen too.
    allowance : Allowance, optional
        Looks whether a family fits the scene's budget.
    rounds : int
        Measurements of each time.
    advance : callable
        Called with the units of work done and what is being done; one unit a family.
    tolerances : bool
        Whether steps that a tolerance chooses are tried too, by each integrator with all else as the scene has it.

    Raises
    ------
    UserError
        If the output does not move, the bound has another unit than it, or links cannot be chosen.
    """
    references = References(scene, excitation)
    mine = own(scene)
    advance(0, "integrating the reference")
    travel = references.travel()
    bound = max_error.relative(travel, unit(scene, excitation.output))
    modelling: dict[int, float] = {}
    if auto_links:
        modelling = fewest_links(scene, excitation, bound, references)
        axes = replace(axes, links=tuple(modelling))

    def run(configuration: Configuration) -> Result:
        truth = references.of(configuration.family.links)
        found = evaluate(scene, excitation, configuration, truth)
        return replace(found, modelling_error=modelling.get(configuration.family.links or 0))

    searched = _search(scene, excitation, axes, bound, modelling, run, advance)
    by: list[ByTolerance] = []
    if tolerances:
        named = serving(scene, [Configuration(each, mine.step) for each in families(scene, axes)])
        truth = references.of(mine.family.links)
        by += tolerances_within(scene, excitation, named, bound, truth, advance)
    original = run(mine)
    # the scene as it was among them, by turns: what is compared is measured at the same time
    tried = {found.configuration: found.result for found in searched}
    points = _priced(scene, excitation, {mine: original, **tried}, rounds)
    own_point = points[mine]
    good = sorted((points[f.configuration] for f in searched if f.good), key=_price)
    far = sorted((points[f.configuration] for f in searched if not f.good), key=lambda p: p.error)
    base = Tuning(scene, excitation, travel, bound, max_time, tuple(good), tuple(far), {}, own_point)
    base = replace(base, by_tolerance=tuple(sorted(by, key=lambda each: each.ns_per_second)))
    over: dict[Family, str] = {}
    for point in good:
        if _price(point) > 1e9 * max_time:
            break
        if allowance is not None and (reason := allowance(point.configuration)) is not None:
            over[point.configuration.family] = reason
            continue
        advance(0, "verifying")
        beyond = next(f.beyond for f in searched if f.configuration == point.configuration)
        chosen, checked = _verified(base, point, references, modelling, rounds)
        if checked is not None and checked.ns_per_second <= 1e9 * max_time:
            return replace(base, over_budget=over, chosen=chosen, verified=checked, beyond=beyond)
    return replace(base, over_budget=over)


def _search(
    scene: Scene,
    excitation: Excitation,
    axes: Axes,
    bound: float,
    modelling: Mapping[int, float],
    run: Callable[[Configuration], Result],
    advance: Advance,
) -> list[Searched]:
    """Return each family's longest good step, or its best, in the order of the families."""
    searched: list[Searched] = []
    least = math.inf
    for family in families(scene, axes):
        advance(1, family.label)
        left = bound - modelling.get(family.links or 0, 0.0)
        shortest = _operations(family, scene, excitation) / (_DEARER * least)
        found = longest_step(family, left, excitation.until, run, shortest)
        if found is None:
            continue
        searched.append(found)
        if found.good:
            least = min(least, (found.result.operations or 0) / found.configuration.step)
    return searched


def _operations(family: Family, scene: Scene, excitation: Excitation) -> float:
    """Return the operations of a step of a family; none where it is refused."""
    from tmm_gen.study.evaluate import family_scene
    from tmm_gen.study.kernels import build

    try:
        return float(build(family_scene(scene, Configuration(family, excitation.until))).operations.total)
    except UserError:
        return 0.0


def _priced(
    scene: Scene, excitation: Excitation, results: Mapping[Configuration, Result], rounds: int
) -> dict[Configuration, Point]:
    finished: dict[Family, Sequence[float]] = {
        c.family: [timed_step(c.step, excitation.until)]
        for c, result in results.items()
        if result.error is not None
    }
    costs: dict[Family, Cost] = measure_costs(scene, excitation, finished, rounds)
    return {c: Point(c, result, costs.get(c.family)) for c, result in results.items()}


def _price(point: Point) -> float:
    return math.inf if point.ns_per_second is None else point.ns_per_second


def _verified(
    base: Tuning, point: Point, references: References, modelling: Mapping[int, float], rounds: int
) -> tuple[Point, Verified | None]:
    """Run a winner afresh; shorten its step a little where the fresh run, looked at more closely, is not good."""
    for _ in range(_TRIES):
        links = point.configuration.family.links
        checked = verify(base.scene, base.excitation, point.configuration, references, rounds)
        total = checked.error + modelling.get(links or 0, 0.0)
        if total <= base.max_error:
            return point, checked
        shorter = replace(point.configuration, step=point.configuration.step * _SHRINK)
        point = replace(point, configuration=shorter, result=replace(point.result, error=checked.error))
    return point, None
