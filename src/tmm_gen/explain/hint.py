"""What a hint is: a quantity, and between which bounds it lies for all arms that anybody builds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from tmm_gen.scene import Scene
from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Path

Measured = Iterator[tuple[Path, float]]


@dataclass(frozen=True)
class Hint:
    """A quantity, and between which bounds it lies for all arms that anybody builds.

    Parameters
    ----------
    measured : callable
        Gives the quantity wherever the scene has it, with its place in the file.
    low, high : float
        Bounds; nothing is said of what lies between them.
    said : str
        What is said of a value that does not, with ``{value}``.
    look : str
        What to look at.
    """

    measured: Callable[[Scene, Document], Measured]
    low: float
    high: float
    said: str
    look: str
