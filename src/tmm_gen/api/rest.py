"""Where an arm comes to rest, or would balance."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture
from tmm_gen.modal.equilibria import equilibria
from tmm_gen.modal.near import FROM_START
from tmm_gen.modal.situation import require_weight
from tmm_gen.modal.space.equilibria import equilibria_in_space
from tmm_gen.modal.space.situation import arm_numbers
from tmm_gen.report.rest_rows import named_ends, rest_row, space_rest_row
from tmm_gen.scene import Scene
from tmm_gen.simulate.skeleton import Skeleton

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Equilibria", "Equilibrium", "equilibria_of"]

Array = NDArray[np.float64]

_NEAR = "the angles given"


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """An arm at rest.

    Parameters
    ----------
    state : str
        "stable", "falls over" or "stays anywhere"; and whether it is where the arm ends from its start.
    stable : bool
        Whether it comes back from a small push.
    angles, torques : dict from str to float
        Of joints by name: of the outer side against the inner one, rad, and what the inner side exerts, N m.
    ends : dict from str to array
        Where what carries nothing is, m: (2,) in a plane, (3,) in space.
    free_angles : array, (d,)
        All that rest decides, rad: what ``linearise(at=...)`` goes by.
    inputs : dict from str to float
        Constant inputs under which it rests.
    """

    state: str
    stable: bool
    angles: dict[str, float]
    torques: dict[str, float]
    ends: dict[str, Array]
    free_angles: Array = field(repr=False)
    inputs: dict[str, float] = field(repr=False)

    def __repr__(self) -> str:
        """Say where the ends are."""
        ends = ", ".join(f"{name} at {np.round(place, 4).tolist()} m" for name, place in self.ends.items())
        return f"<Equilibrium: {self.state}; {ends}>"


@dataclass(frozen=True, eq=False, repr=False)
class Equilibria:
    """All equilibria that were found; the first is where the arm ends from its start, or near the angles given.

    Parameters
    ----------
    name : str
        Of the scene.
    found : tuple of Equilibrium
        At least one.
    starts : int
        From how many configurations they were looked for: there may be more.
    figure : callable
        Draws them.
    """

    name: str
    found: tuple[Equilibrium, ...]
    starts: int
    figure: Callable[[], Figure]

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw the arm in each; write the picture if a file is named."""
        return Picture(self.figure(), f"{self.name} at rest", file)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.found)

    def __getitem__(self, number: int) -> Equilibrium:
        """Return an equilibrium, counted from 0."""
        return self.found[number]

    def __iter__(self) -> Iterator[Equilibrium]:
        """Yield them."""
        return iter(self.found)

    def __repr__(self) -> str:
        """Say which states there are, that of the first one first."""
        word = "equilibria" if len(self) > 1 else "equilibrium"
        states = Counter(each.state for each in self)
        said = (f"{count} x {state}" if count > 1 else state for state, count in states.items())
        return f"<{len(self)} {word} of {self.name}: {'; '.join(said)}>"

    def _repr_html_(self) -> str:
        rows: list[dict[str, object]] = []
        columns = {"equilibrium": "equilibrium", "state": "state"}
        for number, each in enumerate(self, start=1):
            row: dict[str, object] = {"equilibrium": number, "state": each.state}
            for name, place in each.ends.items():
                for axis, value in zip("xyz", place.tolist(), strict=False):
                    columns[f"{name} {axis}"] = f"{name} {axis} (m)"
                    row[f"{name} {axis}"] = round(value, 9)
            rows.append(row)
        note = f"looked for from {self.starts} start{'s' * (self.starts > 1)}: there may be more"
        return html_table(f"{self.name} at rest", columns, rows, [note])


def equilibria_of(scene: Scene, inputs: Mapping[str, float], start: Array | None) -> Equilibria:
    """Return the static equilibria of a scene's arm.

    Parameters
    ----------
    scene : Scene
        A planar arm, or one in space.
    inputs : mapping from str to float
        Constant inputs that it rests under.
    start : array, optional
        Free angles near which one is looked for first, rad.
    """
    require_weight(scene)
    origin = FROM_START if start is None else _NEAR
    return (
        _in_space(scene, inputs, start, origin) if scene.spatial else _in_plane(scene, inputs, start, origin)
    )


def _in_plane(scene: Scene, inputs: Mapping[str, float], start: Array | None, origin: str) -> Equilibria:
    held = equilibria(scene, inputs, start=start)
    found = []
    for number, each in enumerate(held.found, start=1):
        row = rest_row(scene, number, each, origin)
        ends = {name: np.array(row["nodes"][end]) for end, name in named_ends(scene)}
        found.append(_equilibrium(row, ends, each.rest.free_angles, inputs))

    def figure() -> Figure:
        from tmm_gen.report.rest_picture import rest_figure

        return rest_figure(scene, held)

    return Equilibria(scene.name, tuple(found), held.starts, figure)


def _in_space(scene: Scene, inputs: Mapping[str, float], start: Array | None, origin: str) -> Equilibria:
    with np.errstate(all="ignore"):  # what overflows is refused
        numbers = arm_numbers(scene, inputs)
        held = equilibria_in_space(numbers, inputs, scene.name, start=start)
        tips = [tip.name for tip in Skeleton(numbers.arm).tips]
        found = []
        for number, each in enumerate(held.found, start=1):
            row = space_rest_row(numbers.arm, number, each, origin)
            places = {frame["name"]: np.array([frame[axis] for axis in "xyz"]) for frame in row["frames"]}
            found.append(_equilibrium(row, {name: places[name] for name in tips}, each.rest.angles, inputs))

    def figure() -> Figure:
        from tmm_gen.report.space_rest import space_rest_figure

        return space_rest_figure(numbers.arm, scene.title, held)

    return Equilibria(scene.name, tuple(found), held.starts, figure)


def _equilibrium(
    row: dict[str, Any], ends: dict[str, Array], free_angles: Array, inputs: Mapping[str, float]
) -> Equilibrium:
    joints = row["joints"]
    return Equilibrium(
        state=row["state"],
        stable=row["stable"],
        angles={joint["name"]: joint["angle"] for joint in joints},
        torques={joint["name"]: joint["torque"] for joint in joints},
        ends=ends,
        free_angles=free_angles,
        inputs=dict(inputs),
    )
