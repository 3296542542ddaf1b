"""Strain gauges on the beams that motors carry: where they are, and what they show of how an arm is bent.

A gauge is in the middle of the first cell of the first beam that its motor carries, and shows the bending moment there
about the motor's axis. In the model that is the moment of the cell's own spring; an arm of more cells is bent there as
much as its springs on both sides are, by their distances.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.space_motors import motor_ends
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.motor_ends import Bend

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Spring:
    """A spring in a beam of an arm of d angles.

    Parameters
    ----------
    place : float
        From the beam's root, m.
    stiffness, damping : float
        N m/rad and N m s/rad.
    bend : array, (d,)
        Row that gives its angle, about the motor's axis.
    """

    place: float
    stiffness: float
    damping: float
    bend: Array


@dataclass(frozen=True)
class Site:
    """Where a gauge is.

    Parameters
    ----------
    beam : str
        Its name.
    place : float
        From its root, m.
    """

    beam: str
    place: float


@dataclass(frozen=True, eq=False)
class Gauge:
    """A gauge on an arm of d angles: it shows ``angle q + rate q'``, N m.

    Parameters
    ----------
    angle, rate : array, (d,)
        N m/rad and N m s/rad.
    """

    angle: Array
    rate: Array

    @classmethod
    def of(cls, scene: Scene, motors: Motors, motor: int, site: Site) -> Gauge:
        """Return that of a motor, counted from 0, on an arm of perhaps other cells than those its site is told by."""
        springs = list(_springs(scene, motors, motor, site.beam))
        size = len(motors.lengths)
        angle, rate = np.zeros(size), np.zeros(size)
        places = sorted({spring.place for spring in springs})
        shares = dict(zip(places, _shares(np.array(places), site.place), strict=True))
        for spring in springs:
            angle += shares[spring.place] * spring.stiffness * spring.bend
            rate += shares[spring.place] * spring.damping * spring.bend
        return cls(angle, rate)


def site_of(scene: Scene, motors: Motors, motor: int) -> Site:
    """Return where the gauge of a motor is, counted from 0: on the first beam it carries that bends about its axis."""
    beam = _beam(scene, motors, motor)
    return Site(beam, min(spring.place for spring in _springs(scene, motors, motor, beam)))


def _shares(places: Array, place: float) -> Array:
    """Return what each of some places counts for at one between them."""
    return np.array([np.interp(place, places, unit) for unit in np.eye(len(places))])


def _beam(scene: Scene, motors: Motors, motor: int) -> str:
    """Return the name of that beam; the scene's rules see to it that there is one."""
    here = motors.each[motor]
    if scene.spatial is not None:
        return _bends(scene, motors, motor)[0]
    return next(
        part.name
        for part in scene.parts
        if part.kind == "beam" and here.place < part.first <= here.end and part.last > part.first
    )


def _springs(scene: Scene, motors: Motors, motor: int, beam: str) -> Iterator[Spring]:
    """Yield the springs of a beam that a motor carries, from its root."""
    size = len(motors.lengths)
    if scene.spatial is None:
        part = next(part for part in scene.parts if part.name == beam)
        place = 0.0
        for number in range(part.first + 1, part.last + 1):
            place += scene.links[number - 2].length
            bend = np.zeros(size)
            bend[number - 1], bend[number - 2] = 1.0, -1.0
            yield Spring(place, scene.joints[number - 1].stiffness, scene.joints[number - 1].damping, bend)
        return
    name, bends = _bends(scene, motors, motor)
    assert name == beam
    entries: Any = scene.source.data["beam"]
    length = next(float(entry["length"]) for entry in entries if entry["name"] == beam)
    cell = length / max(each.cell for each in bends)
    for each in bends:
        joint = scene.spatial.joints[each.number - 1]
        bend = np.zeros(size)
        bend[each.number - 1] = each.about
        yield Spring((each.cell - 0.5) * cell, joint.stiffness, joint.damping, bend)


def _bends(scene: Scene, motors: Motors, motor: int) -> tuple[str, tuple[Bend, ...]]:
    """Return the beam in space on which the gauge of a motor is, and the joints in which it bends."""
    # how joints that motors turn are told matters not: no other motor is between a motor and its beam
    ends = motor_ends(scene, {each.place + 1: 0.0 for each in motors.each})
    found = ends.bends(motors.each[motor].place + 1)
    assert found is not None  # rules/control_sensors.py sees to it
    return found
