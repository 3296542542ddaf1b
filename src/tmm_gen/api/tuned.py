"""The cheapest configuration of an arm within bounds on error and time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from tmm_gen.api.acting import excited
from tmm_gen.api.given import required
from tmm_gen.api.html import html_table
from tmm_gen.api.several import Few, axes_given
from tmm_gen.api.wording import in_python
from tmm_gen.api.words import whole
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.study.bounds import ErrorBound, read_error, read_time
from tmm_gen.study.budgets import Allowance, allowance, require_target
from tmm_gen.study.by_tolerance import require_desktop
from tmm_gen.study.explain import bounds_of, explained, under
from tmm_gen.study.tune import Tuning
from tmm_gen.study.tune import tune as search

if TYPE_CHECKING:
    from tmm_gen.api.arm import Arm

__all__ = ["Tuned", "searched"]

_COLUMNS = {
    "configuration": "configuration",
    "step": "step (s)",
    "error": "time error",
    "total_error": "total error",
    "us_per_simulated_second": "µs per simulated s",
    "fits": "within bounds",
}


@dataclass(frozen=True, eq=False, repr=False)
class Tuned:
    """What a search has found; true if something keeps all bounds.

    Parameters
    ----------
    tuning : Tuning
        What was measured.
    allowed : Allowance, optional
        What looked after the scene's budget.
    arm : Arm, optional
        With the configuration that was chosen; None if nothing keeps the bounds.
    """

    tuning: Tuning
    allowed: Allowance | None
    arm: Arm | None

    @property
    def found(self) -> bool:
        """Whether something keeps all bounds."""
        return self.arm is not None

    @property
    def integrator(self) -> str | None:
        """The one that was chosen."""
        winner = self.tuning.winner
        return None if winner is None else winner.integrator

    @property
    def tolerance(self) -> float | None:
        """The one that was chosen to choose steps by; None where these are all alike."""
        winner = self.tuning.winner
        return None if winner is None else winner.tolerance

    @property
    def step(self) -> float | None:
        """s; the one that was chosen. None where a tolerance chooses steps."""
        winner = self.tuning.winner
        return None if winner is None else winner.step

    @property
    def error(self) -> float | None:
        """Largest error of the chosen one, run afresh, relative to how far the output travels."""
        winner = self.tuning.winner
        return None if winner is None else winner.error

    @property
    def seconds(self) -> float | None:
        """Seconds of computing for a simulated second, of the chosen one, on this machine."""
        winner = self.tuning.winner
        return None if winner is None else 1e-9 * winner.ns_per_second

    @property
    def rows(self) -> list[dict[str, object]]:
        """What ``tmm-gen tune --json`` has of each family."""
        return list(self.tuning.rows())

    @property
    def statement(self) -> str:
        """What was chosen and why, or why nothing could be, in sentences."""
        return in_python("\n".join([*explained(self.tuning, self.allowed), under(self.tuning)]))

    def __bool__(self) -> bool:
        """Return whether something keeps all bounds."""
        return self.found

    def __repr__(self) -> str:
        """Say what was chosen."""
        chosen = self.tuning.chosen
        said = f"nothing keeps {bounds_of(self.tuning)}"
        if self.tolerance is not None:
            said = f"{self.integrator} by a tolerance of {self.tolerance:g}"
        elif chosen is not None:
            said = f"{chosen.configuration.family.label} at {self.step:.4g} s"
        return f"<Tuning of {self.tuning.scene.name}: {said}>"

    def _repr_html_(self) -> str:
        rows = self.rows
        for row in rows:
            ns = row["ns_per_simulated_second"]
            row["us_per_simulated_second"] = 1e-3 * ns if isinstance(ns, float) else None
        title = f"{self.tuning.scene.title}: {bounds_of(self.tuning)}"
        return html_table(title, _COLUMNS, rows, self.statement.splitlines())


def searched(
    scene: Scene,
    max_error: object,
    max_time: object,
    links: Few,
    options: Mapping[str, Few],
    until: float | None,
    output: str | None,
    target: str | None,
    rounds: int,
    acting: Mapping[str, object],
    *,
    tolerances: bool = False,
) -> tuple[Tuning, Allowance | None]:
    """Search; arguments as of :meth:`tmm_gen.Arm.tune`, what else is varied in `options`."""
    bounds = _error(max_error), _time(max_time)
    auto = isinstance(links, str) and links == "auto"
    axes = axes_given(scene, {**options, "links": None if auto else links, "backends": "c"})
    if target is not None and not isinstance(target, str):
        raise UserError(f"target: {target!r} is no name of a microcontroller. Name one.")
    require_target(target)
    if tolerances:
        require_desktop(scene, target, auto_links=auto)
    measured = whole("rounds", rounds, 1)
    went = excited(scene, until, output, acting)
    allowed = allowance(scene, target)
    found = search(scene, went, *bounds, axes, auto, allowed, measured, tolerances=tolerances)
    return found, allowed


def _error(bound: object) -> ErrorBound:
    if isinstance(bound, str):
        return read_error(bound)
    return ErrorBound(required("max_error", bound, ""), "")


def _time(bound: object) -> float:
    return read_time(bound) if isinstance(bound, str) else required("max_time", bound, "seconds")
