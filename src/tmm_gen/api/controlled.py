"""Controllers of an arm beside each other, on a finer arm."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from tmm_gen.api.given import required
from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture, target_of
from tmm_gen.api.several import Few, texts
from tmm_gen.api.words import whole
from tmm_gen.closed_loop.chosen import chosen
from tmm_gen.closed_loop.compare import Trial, compare
from tmm_gen.closed_loop.figures import BAND
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import CONTROLLERS, require_solvers
from tmm_gen.control.plant.differing import conditions_of
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.scene import Scene

__all__ = ["Control", "controlled"]

_COLUMNS = {
    "controller": "controller",
    "condition": "condition",
    "settling_s": f"settles to {100 * BAND:g} % (s)",
    "overshoot_percent": "overshoot (%)",
    "residual_mrad": "residual (mrad)",
    "offset_mrad": "offset (mrad)",
    "solve_us_median": "solve (µs)",
    "solve_us_max": "at most (µs)",
    "fallbacks": "fallbacks",
}


@dataclass(frozen=True, eq=False, repr=False)
class Control:
    """Closed loops, condition by condition.

    Parameters
    ----------
    bench : Bench
        Of the scene: its control problem and models.
    trials : tuple of Trial
        Each with ``kind``, ``condition``, ``figures``, and ``loop``: ``time``, ``tip``, ``hub``, ``torque`` as arrays.
    """

    bench: Bench
    trials: tuple[Trial, ...]

    @property
    def rows(self) -> list[dict[str, object]]:
        """What ``tmm-gen mpc --json`` has of each trial."""
        return [trial.row() for trial in self.trials]

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw tip angles and torques; write the picture if a file is named."""
        from tmm_gen.closed_loop.pictures import comparison_figure

        return Picture(comparison_figure(self.trials, self.bench.problem), self._title, file)

    @guarded
    def animate(self, file: str | PathLike[str], number: int = -1) -> Path:
        """Write the arm of a trial, by default the last, in motion as a GIF or as an HTML page; return where."""
        from tmm_gen.closed_loop.motion import motion
        from tmm_gen.report.animate import animation

        target = target_of(file, (".gif", ".html"))
        if not -len(self) <= whole("number", number, -len(self)) < len(self):
            raise UserError(f"number: there are {len(self)} trials, counted from 0, not {number}.")
        moved = motion(self.bench.scene, self.trials[number])
        write_whole(target, animation(moved, target.suffix[1:].lower()))
        return target

    @property
    def _title(self) -> str:
        return f"control of {self.bench.scene.name}"

    def __len__(self) -> int:
        """Return how many trials there are."""
        return len(self.trials)

    def __getitem__(self, number: int) -> Trial:
        """Return a trial, counted from 0."""
        return self.trials[number]

    def __iter__(self) -> Iterator[Trial]:
        """Yield the trials."""
        return iter(self.trials)

    def __repr__(self) -> str:
        """Say who controls under what."""
        kinds = dict.fromkeys(trial.kind.name for trial in self)
        conditions = dict.fromkeys(trial.condition.name for trial in self)
        return f"<Control of {self.bench.scene.name}: {', '.join(kinds)}; {', '.join(conditions)}>"

    def _repr_html_(self) -> str:
        rows = self.rows
        told = {
            key: head for key, head in _COLUMNS.items() if key != "fallbacks" or any(r[key] for r in rows)
        }
        return html_table(self.bench.scene.title, told, rows)


def controlled(
    scene: Scene, controllers: Few, conditions: Few, until: float, seed: int, compiled: bool
) -> Control:
    """Compare controllers; arguments as of :meth:`tmm_gen.Arm.mpc`."""
    kinds = chosen(
        "--controller", texts("controllers", controllers), {each.name: each for each in CONTROLLERS}
    )
    cases = chosen("--condition", texts("conditions", conditions), {each.name: each for each in CONDITIONS})
    duration, noise = required("until", until, "seconds"), whole("seed", seed, 0)
    bench = Bench.of(scene)
    kinds = kinds or [kind for kind in CONTROLLERS if kind.compared(bench)]
    require_solvers(kinds)
    return Control(
        bench, tuple(compare(bench, kinds, cases or conditions_of(scene), duration, noise, bool(compiled)))
    )
