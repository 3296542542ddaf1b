"""Runs whose step is too long for the motion, taken in a power of four of shorter ones per step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeVar

from tmm_gen.scene import Scene
from tmm_gen.simulate.stepping import Backend
from tmm_gen.simulate.too_long import TooLongError

Found = TypeVar("Found")

SUBSTEPS = (4, 16, 64, 256)
"""Into how many a step may be divided."""

MOST_TO_TAKE: dict[Backend, int] = {"numpy": 1_000_000, "c": 20_000_000}
"""Substeps times links: minutes in NumPy; in C as many as whose motion can be kept, from which the error is found."""


class Progress(Protocol):
    """Is told how many steps were taken since the last call, fewer than none where they are taken again."""

    def __call__(self, count: float, doing: str | None = None) -> None:
        """Count them, and say what is being done from now on."""


@dataclass(frozen=True)
class Substeps:
    """How a step was divided.

    Parameters
    ----------
    count : int
        Substeps per step; 1 where it was taken whole.
    because : str
        What the step itself, or too few substeps, would have been refused for, in a clause; empty where nothing was.
    """

    count: int = 1
    because: str = ""


def divided(
    scene: Scene,
    steps: int,
    backend: Backend,
    attempt: Callable[[Scene, int], Found],
    about_to: Callable[[int], None],
) -> tuple[Found, Substeps]:
    """Run a scene at its step, and if that is too long in as few substeps as will do.

    Parameters
    ----------
    scene : Scene
        With its step.
    steps : int
        How many.
    backend : {"numpy", "c"}
        What takes them.
    attempt : callable
        Runs the scene in so many substeps per step, at the step of the scene that it is given.
    about_to : callable
        Told before each further attempt how many substeps that will have.

    Raises
    ------
    TooLongError
        As the last attempt raised it; if there was more than one it is said.
    """
    step, because, refused = scene.integrator.step, "", [1]
    while True:
        count = refused[-1]
        used = scene if count == 1 else scene.replace(**{"integrator.step": step / count})
        try:
            return attempt(used, count), Substeps(count, because)
        except TooLongError as error:
            because = because or error.reason
            wanted = min(error.times, SUBSTEPS[-1] / count)
            further = next((k for k in SUBSTEPS if k >= wanted * count and k > count), None)
            most = MOST_TO_TAKE[backend] // (steps * scene.stations)
            if further is not None and further > most:
                further = max((k for k in SUBSTEPS if count < k <= most), default=None)
            if further is None:
                error.args = (f"{error}{_in_vain(step, refused, most, backend)}",)
                raise
        refused.append(further)
        about_to(further)


def _in_vain(step: float, refused: list[int], most: int, backend: Backend) -> str:
    """Say what was tried, and why no more."""
    faster = "; --backend c takes more" if backend == "numpy" else ""
    more = (
        f", and more than {most} substeps per step are too many to take{faster}"
        if most < SUBSTEPS[-1]
        else ""
    )
    if len(refused) == 1:
        return (
            f"\nSubsteps might do, but even {SUBSTEPS[0]} per step are too many to take{faster}."
            if more
            else ""
        )
    counts = [str(count) for count in refused[1:]]
    said = " and ".join([", ".join(counts[:-1]), counts[-1]] if len(counts) > 1 else counts)
    return (
        f"\nSo it is with {said} substeps per step of {step:g} s, the last of which this was said of{more}."
    )
