"""What a mass at the end of an arm in space makes of the parameters of its kernel, as C can compute it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.payload import changed_parameters, laden
from tmm_gen.derive.space.declaration import AXES, PAIRS
from tmm_gen.program.space.kernel_parameters import parameter_values
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SpacePayload:
    """What moves with the joint that carries the payload, without it; in the joint's axes.

    Parameters
    ----------
    place : int
        Of the joint, from 0.
    mass : float
        kg.
    center : array, (3,)
        Its centre of mass, m.
    inertia : array, (3, 3)
        About that, the payload's own included, kg m^2.
    at : array, (3,)
        Where the payload is, m.
    names : tuple of str
        Of the parameters that change.
    """

    place: int
    mass: float
    center: Array
    inertia: Array
    at: Array
    names: tuple[str, ...]

    @classmethod
    def of(cls, scene: Scene, payload: float) -> SpacePayload:
        """Return it of an arm with a payload, kg: first and second moments grow evenly with the mass."""
        heavier = laden(scene, payload + 1.0)
        changed = [name.rpartition("_") for name in changed_parameters(scene, heavier)]
        place = int(changed[0][2]) - 1
        mass, first, second = _moments(scene, place)
        _, first_more, second_more = (
            after - before
            for after, before in zip(_moments(heavier, place), (mass, first, second), strict=True)
        )
        mass, first, second = mass - payload, first - payload * first_more, second - payload * second_more
        center = first / mass if mass > 0.0 else first_more
        return cls(
            place,
            float(mass),
            center,
            second - mass * _lever(center),
            first_more,
            tuple(name for name, _, _ in changed),
        )

    @property
    def axes(self) -> list[tuple[str, int]]:
        """Parameters that are places of the centre of mass, and their axis."""
        named = ((f"center_{axis}", k) for k, axis in enumerate(AXES))
        return [each for each in named if each[0] in self.names]

    @property
    def pairs(self) -> list[tuple[str, int, int]]:
        """Parameters that are moments of inertia, and their axes."""
        named = ((f"center_inertia_{pair}", AXES.index(pair[0]), AXES.index(pair[1])) for pair in PAIRS)
        return [each for each in named if each[0] in self.names]


def _moments(scene: Scene, place: int) -> tuple[Array, Array, Array]:
    """Return mass, first and second moments of what moves with a joint, about the joint."""
    assert scene.spatial is not None
    values = parameter_values(scene.spatial)
    mass = np.array(values["mass"][place])
    center = np.array([values[f"center_{axis}"][place] for axis in AXES])
    inertia = np.zeros((3, 3))
    for pair in PAIRS:
        i, j = (AXES.index(axis) for axis in pair)
        inertia[i, j] = inertia[j, i] = values[f"center_inertia_{pair}"][place]
    return mass, mass * center, inertia + mass * _lever(center)


def _lever(place: Array) -> Array:
    """Return what a kilogram there has as moments of inertia, m^2."""
    return np.asarray(place @ place * np.eye(3) - np.outer(place, place), float)
