"""Natural frequencies, damping ratios and mode shapes of an arm."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture
from tmm_gen.modal.modes import Mode
from tmm_gen.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Modes", "modes_of"]

Array = NDArray[np.float64]

_COLUMNS = {
    "mode": "mode",
    "frequency_hz": "frequency (Hz)",
    "damping_ratio": "damping ratio",
    "mostly": "what moves, by energy",
    "exact_hz": "continuous beam (Hz)",
    "error_percent": "error (%)",
    "motion": "motion",
}


@dataclass(frozen=True, eq=False, repr=False)
class Modes:
    """The modes of the lowest natural frequencies, in ascending order; ``modes[0]`` is the slowest.

    Parameters
    ----------
    name : str
        Of the scene.
    found : tuple of Mode
        Each with ``hertz``, ``damping_ratio``, ``poles``, ``shape`` and ``motion``.
    rows : list of dict
        What ``tmm-gen modes --json`` has of each.
    figure : callable
        Draws them.
    """

    name: str
    found: tuple[Mode, ...]
    rows: list[dict[str, Any]]
    figure: Callable[[], Figure]

    @property
    def frequencies(self) -> Array:
        """Natural frequencies, Hz; zero where an arm turns freely or falls over."""
        return np.array([mode.hertz for mode in self.found])

    @property
    def damping_ratios(self) -> Array:
        """Shares of critical damping; NaN where an arm turns freely or falls over."""
        return np.array([np.nan if mode.damping_ratio is None else mode.damping_ratio for mode in self.found])

    @property
    def poles(self) -> NDArray[np.complex128]:
        """Both poles of each, 1/s, (k, 2)."""
        return np.array([mode.poles for mode in self.found], complex).reshape(-1, 2)

    @property
    def stable(self) -> bool:
        """Whether no mode falls over."""
        return not any(mode.unstable for mode in self.found)

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw the mode shapes; write the picture if a file is named."""
        return Picture(self.figure(), f"modes of {self.name}", file)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.found)

    def __getitem__(self, number: int) -> Mode:
        """Return a mode, counted from 0."""
        return self.found[number]

    def __iter__(self) -> Iterator[Mode]:
        """Yield the modes, the slowest first."""
        return iter(self.found)

    def __repr__(self) -> str:
        """List the frequencies."""
        return f"<Modes of {self.name}: {', '.join(f'{mode.hertz:.4g}' for mode in self.found)} Hz>"

    def _repr_html_(self) -> str:
        swinging = all(row["motion"] == "swings" for row in self.rows)
        told = {
            key: head
            for key, head in _COLUMNS.items()
            if any(row.get(key) is not None for row in self.rows) and not (key == "motion" and swinging)
        }
        return html_table(f"Modes of {self.name}", told, self.rows)


def modes_of(scene: Scene, count: int, inputs: Mapping[str, float], start: Array | None) -> Modes:
    """Return the lowest modes of a scene's arm where it rests.

    Parameters
    ----------
    scene : Scene
        Of any kind.
    count : int
        How many; those of a base that floats in space come besides.
    inputs : mapping from str to float
        Constant inputs that it rests under.
    start : array, optional
        Free angles near which it rests, rad.
    """
    if scene.spatial is not None:
        return _in_space(scene, count, inputs, start)
    from tmm_gen.modal.beside import Beside
    from tmm_gen.modal.matrices import matrices
    from tmm_gen.modal.mode_rows import mode_row
    from tmm_gen.modal.modes import find_modes
    from tmm_gen.modal.situation import resting_arm

    arm = resting_arm(scene, inputs, start)
    found = find_modes(matrices(arm), count)
    beside = Beside.of(arm, found)
    rows = [mode_row(number, mode) | beside.row(mode) for number, mode in enumerate(found)]

    def figure() -> Figure:
        from tmm_gen.modal.picture import mode_figure

        return mode_figure(arm, found, None if beside.beam is None else (beside.beam, beside.exact))

    return Modes(scene.name, found, rows, figure)


def _in_space(scene: Scene, count: int, inputs: Mapping[str, float], start: Array | None) -> Modes:
    from tmm_gen.modal.mode_rows import space_mode_row
    from tmm_gen.modal.space.situation import resting_in_space

    with np.errstate(all="ignore"):  # what overflows is refused
        resting = resting_in_space(scene, inputs, start)
        found = resting.modes(count)
        rows = [space_mode_row(resting, number, mode) for number, mode in enumerate(found)]

    def figure() -> Figure:
        from tmm_gen.report.space_modes import space_mode_figure

        return space_mode_figure(resting, found)

    return Modes(scene.name, found, rows, figure)
