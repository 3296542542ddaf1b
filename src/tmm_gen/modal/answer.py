"""How an output of a scene answers one of its inputs over a band of frequencies, and at the modes within."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.beam.response import beam_response
from tmm_gen.modal.linear import Linear
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes, modes_up_to
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.situation import resting_arm
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.scene import Input, Output, Scene
from tmm_gen.scene.quantity import INPUT_UNITS

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SHOWN = 8
"""Modes that fit into the band where none is asked for."""

_ROUNDING = 1e-12
"""Share of the largest component below which another is nothing but rounding."""


@dataclass(frozen=True, eq=False)
class Swinging:
    """A scene in small motion.

    Parameters
    ----------
    scene : Scene
        What moves.
    linear : Linear
        Its matrices.
    response : callable
        From s to outputs by their components, each for a unit of all inputs.
    straight : bool
        Whether it is a planar arm that rests straight, as the continuous beam does.
    before : int
        Modes in which an arm in space moves as a whole; they are counted before the others.
    """

    scene: Scene
    linear: Linear
    response: Callable[[Complex], dict[str, Complex]]
    straight: bool = False
    before: int = 0


def swinging(scene: Scene, inputs: dict[str, float], start: Array | None) -> Swinging:
    """Return a scene in small motion about where it rests.

    Parameters
    ----------
    inputs : dict from str to float
        Constant inputs that it rests under.
    start : array, optional
        Free angles near which it rests, rad; None for where it comes to rest.
    """
    if scene.spatial is not None:
        resting = resting_in_space(scene, inputs, start)
        return Swinging(
            scene, resting.linear, lambda s: space_response(resting.still, s), before=resting.whole
        )
    arm = resting_arm(scene, inputs, start)
    straight = arm.rest is not None and float(np.max(np.abs(arm.rest.angles))) < 1e-9
    return Swinging(scene, matrices(arm), lambda s: frequency_response(arm, s), straight)


def band_of(arm: Swinging, low: float | None, high: float | None) -> tuple[float, float]:
    """Return the lowest and the highest frequency, Hz: those given, or such that the slowest modes are within."""
    found = [mode.hertz for mode in find_modes(arm.linear, _SHOWN + 1) if mode.frequency > 0.0][:_SHOWN]
    lowest = low or (0.1 * found[0] if found else 0.01)
    return lowest, high or (2.0 * found[-1] if found else 100.0 * lowest)


@dataclass(frozen=True, eq=False)
class Answer:
    """One output for one input.

    Parameters
    ----------
    scene : Scene
        Whose they are.
    given : Input
        What swings.
    read : Output
        What answers.
    hertz : array, (f,)
        Frequencies, Hz.
    parts : dict from str to array, (f,)
        The output's components for a unit of the input.
    beam : array, (f,), or None
        The same of the continuous beam, where there is one.
    rows : list of dict
        The modes within, with magnitude and phase at each.
    """

    scene: Scene
    given: Input
    read: Output
    hertz: Array
    parts: dict[str, Complex]
    beam: Complex | None
    rows: list[dict[str, object]]

    @property
    def unit(self) -> str:
        """Of the magnitude."""
        numerator = self.scene.quantity(self.read).unit.replace("^2", "²")
        return f"{numerator} per {INPUT_UNITS[self.given.acts]}"

    @property
    def told(self) -> list[str]:
        """The components that are more than rounding beside the largest."""
        peaks = {name: float(np.max(np.abs(values))) for name, values in self.parts.items()}
        largest = max(peaks.values())
        return [name for name, peak in peaks.items() if peak >= _ROUNDING * largest]

    @property
    def largest(self) -> str:
        """The component whose peak is the largest."""
        return max(self.parts, key=lambda name: float(np.max(np.abs(self.parts[name]))))

    def csv(self) -> str:
        """Return a table of the answer with 17 significant digits: every bit of a double."""
        header, columns = ["frequency_hz"], [self.hertz]
        for name, values in self.parts.items():
            header += [f"{name}_magnitude", f"{name}_phase_deg", f"{name}_real", f"{name}_imaginary"]
            columns += [np.abs(values), np.degrees(np.angle(values)), values.real, values.imag]
        lines = [",".join(header)]
        lines += [",".join(f"{value:.17g}" for value in row) for row in zip(*columns, strict=True)]
        return "\n".join(lines) + "\n"


_Item = TypeVar("_Item", Input, Output)


def asked(scene: Scene, source: str | None, target: str | None) -> tuple[Input, Output]:
    """Return the input and the output of some names, or the first ones.

    Raises
    ------
    UserError
        If there is none of that name, or none at all.
    """
    # energies go with the square of the motion
    readable = tuple(item for item in scene.outputs if not scene.quantity(item).of_arm)
    chosen = _chosen(scene, scene.inputs, source, "--from", "[[input]]")
    return chosen, _chosen(scene, readable, target, "--to", "[[output]] of a place")


def _chosen(scene: Scene, items: tuple[_Item, ...], name: str | None, option: str, table_name: str) -> _Item:
    if not items:
        raise UserError(
            f"{scene.source.origin}: has no {table_name}, and a frequency response needs one. Add {table_name}."
        )
    if name is None:
        return items[0]
    names = [item.name for item in items]
    if name not in names:
        raise UserError(f"{option} {name}: no such name; choose from {', '.join(names)}.")
    return items[names.index(name)]


def answered(
    scene: Scene,
    about: tuple[Input, Output],
    limits: tuple[float | None, float | None] = (None, None),
    points: int = 1000,
    inputs: Mapping[str, float] | None = None,
    start: Array | None = None,
) -> Answer:
    """Return how an output of a scene answers an input over a band.

    Parameters
    ----------
    scene : Scene
        Of any kind.
    about : tuple of Input and Output
        As of :func:`asked`.
    limits : (float or None, float or None)
        Band, Hz; by default as of :func:`band_of`.
    points : int
        Frequencies, evenly in log.
    inputs : mapping from str to float, optional
        Constant inputs that an arm rests under.
    start : array, optional
        Free angles near which it rests, rad.

    Raises
    ------
    UserError
        If the band is empty, or there is no equilibrium.
    """
    with np.errstate(all="ignore" if scene.spatial else None):  # what overflows in space is refused
        arm = swinging(scene, dict(inputs or {}), start)
        low, high = band_of(arm, *limits)
        if low >= high:
            raise UserError(f"the band from {low:g} to {high:g} Hz is empty. Give both --low and --high.")
        return answer_of(arm, about, np.geomspace(low, high, points))


def answer_of(arm: Swinging, about: tuple[Input, Output], hertz: Array) -> Answer:
    """Return how an output answers an input.

    Parameters
    ----------
    arm : Swinging
        What swings.
    about : tuple of Input and Output
        Of its scene.
    hertz : array, (f,)
        Frequencies, Hz, increasing.
    """
    scene, (given, read) = arm.scene, about
    low, high, points = hertz[0], hertz[-1], len(hertz)
    number = [item.name for item in scene.inputs].index(given.name)
    names = scene.quantity(read).columns(read.name)
    modes = modes_up_to(arm.linear, 2.0 * np.pi * high)
    inside = [(k, mode) for k, mode in enumerate(modes, start=arm.before) if low <= mode.hertz <= high]
    at_modes = np.array([mode.hertz for _, mode in inside])
    with np.errstate(all="ignore"):  # without damping a resonance has no bound
        found = arm.response(2j * np.pi * np.concatenate([hertz, at_modes]))
        parts = {name: found[name][:, number] for name in names}
    beam = None
    if scene.beam is not None and arm.straight:
        beam = beam_response(scene, np.asarray(2j * np.pi * hertz, complex), given, read)
    rows: list[dict[str, object]] = []
    for place, (k, mode) in enumerate(inside, start=points):
        row: dict[str, object] = {
            "mode": k + 1,
            "frequency_hz": mode.hertz,
            "damping_ratio": mode.damping_ratio,
        }
        for name, values in parts.items():
            row[f"magnitude{name.removeprefix(read.name)}"] = (
                float(abs(values[place])) if mode.damping_ratio else math.inf
            )
            row[f"phase{name.removeprefix(read.name)}_deg"] = float(np.degrees(np.angle(values[place])))
        rows.append(row)
    return Answer(
        scene, given, read, hertz, {name: values[:points] for name, values in parts.items()}, beam, rows
    )
