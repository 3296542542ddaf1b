"""What a hint is: a quantity, and between which bounds it lies for all arms that anybody builds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from tmm_gen.scene import Scene
from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Path

Measured = Iterator[tuple[Path, float]]
Measure = Callable[[Scene, Document], Measured]


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

    measured: Measure
    low: float
    high: float
    said: str
    look: str


def gyration_hint(measured: Measure, length: str) -> Hint:
    """Return the hint on a radius of gyration as a share of a length."""
    said = f"the radius of gyration is {{value:.3g}} times the {length}"
    look = "Inertia is in kg m^2, about the centre of mass: a slender rod has mass * length^2 / 12."
    return Hint(measured, 0.0, 10.0, said, look)


def rotor_hint(measured: Measure) -> Hint:
    """Return the hint on a rotor's inertia behind its gear as a share of the arm's."""
    said = "behind its gear the rotor has {value:.3g} times the inertia of the arm"
    return Hint(
        measured, 0.0, 1e3, said, "Rotor inertia is in kg m^2, on the motor's side: 200 g cm^2 are 2e-5."
    )


def turns_hint(measured: Measure) -> Hint:
    """Return the hint on an angle, measured in turns."""
    return Hint(measured, 0.0, 1.0, "this is {value:.3g} turns", "Angles are in rad: 30 degrees are 0.5236.")
