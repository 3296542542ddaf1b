"""Where an arm stands against the limits of stability, and whether its kernel agrees."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture
from tmm_gen.api.several import Few, texts
from tmm_gen.api.words import whole
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.stability.limits import Standing, scene_integrators, standings
from tmm_gen.stability.map import GrowthMap, growth_map, sensible_columns
from tmm_gen.stability.motion import SmallMotion, small_motion
from tmm_gen.stability.rows import mapped_integrators, notes_of, standing_row

__all__ = ["Stability", "stability_of"]

_COLUMNS = {
    "own": "the scene's",
    "integrator": "integrator",
    "order": "order",
    "limit": "limit of Ω",
    "limit_damped": "damped",
    "growth_per_step": "growth in a step",
    "largest_step": "largest stable step (s)",
    "margin": "margin",
    "verdict": "verdict",
}


@dataclass(frozen=True, eq=False, repr=False)
class Stability:
    """Where an arm stands; true if it is stable and its kernel grows as derived.

    Parameters
    ----------
    motion : SmallMotion
        The arm about rest.
    standings : tuple of Standing
        With each integrator: ``limit``, ``largest_step``, ``stable``.
    maps : tuple of GrowthMap
        Growth over step and stiffness, ``measured`` by the kernel beside ``derived``.
    """

    motion: SmallMotion
    standings: tuple[Standing, ...]
    maps: tuple[GrowthMap, ...]

    @property
    def own(self) -> Standing:
        """With the scene's own integrator."""
        return next(each for each in self.standings if each.chosen)

    @property
    def stable(self) -> bool:
        """Whether nothing grows with the scene's integrator at its step."""
        return self.own.stable

    @property
    def largest_step(self) -> float:
        """s; largest stable one of the scene's integrator, infinite where none is too large."""
        return self.own.largest_step

    @property
    def agrees(self) -> bool:
        """Whether kernels grow as derived wherever that was measured."""
        return not any(each.differs.any() for each in self.maps)

    @property
    def rows(self) -> list[dict[str, Any]]:
        """What ``tmm-gen stability --json`` has of each integrator."""
        return [standing_row(each, self.motion.scene.integrator.step) for each in self.standings]

    @property
    def statement(self) -> str:
        """Of what the growth is, and whether kernels grow like that, in sentences."""
        return "\n".join(self.notes[1:])

    @property
    def notes(self) -> list[str]:
        """What ``tmm-gen stability`` says below its table."""
        return notes_of(self.motion, self.standings, self.maps)

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw the maps, measured beside derived; write the picture if a file is named."""
        from tmm_gen.stability.picture import map_figure

        if not self.maps:
            raise UserError("plot: draws maps, and cells=0 leaves them out. Ask for stability() without it.")
        return Picture(map_figure(self.maps), f"growth of {self.motion.scene.name}", file)

    def __bool__(self) -> bool:
        """Return whether it is stable and its kernel grows as derived."""
        return self.stable and self.agrees

    def __repr__(self) -> str:
        """Say whether it is stable, and how large a step may be."""
        method = self.motion.scene.integrator
        limit = f"up to {self.largest_step:.4g} s" if np.isfinite(self.largest_step) else "at any step"
        stands = f"stable {limit}" if self.largest_step > 0.0 else "grows at any step"
        differs = "" if self.agrees else "; its kernel DIFFERS"
        grows = "" if self.stable or self.largest_step == 0.0 else f", GROWS at {method.step:g} s"
        return f"<Stability of {self.motion.scene.name}: {method.name} is {stands}{grows}{differs}>"

    def _repr_html_(self) -> str:
        highest = self.motion.highest
        title = (
            f"{self.motion.scene.title}: highest natural frequency {highest.frequency:.6g} rad/s, times the step Ω = "
            f"{highest.frequency * self.motion.scene.integrator.step:.4g}"
        )
        return html_table(title, _COLUMNS, self.rows, self.statement.splitlines())


def stability_of(scene: Scene, maps: Few, cells: int | None, start: NDArray[np.float64] | None) -> Stability:
    """Return where a scene stands; arguments as of :meth:`tmm_gen.Arm.stability`, `start` the free angles near rest."""
    names = mapped_integrators(texts("maps", maps) or (scene.integrator.name,))
    columns = None if cells is None else whole("cells", cells, 0)
    motion = small_motion(scene, start)
    return Stability(motion, stands(motion), measured(motion, names, columns))


def stands(motion: SmallMotion, advance: Callable[[str], None] = lambda name: None) -> tuple[Standing, ...]:
    """Return where an arm stands with every integrator; ``advance`` hears of each."""
    return tuple(standings(motion, scene_integrators(motion.scene), advance))


def measured(
    motion: SmallMotion,
    names: list[str],
    cells: int | None,
    advance: Callable[[int], None] = lambda cells: None,
) -> tuple[GrowthMap, ...]:
    """Return maps of growth, none for no cells; ``advance`` hears of parts."""
    if cells == 0:
        return ()
    columns = cells or sensible_columns(motion.scene)
    methods = scene_integrators(motion.scene, names)
    return tuple(growth_map(motion, method, columns, advance) for method in methods)
