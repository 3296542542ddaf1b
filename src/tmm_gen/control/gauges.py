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

from tmm_gen.control.motor_rows import Motors
from tmm_gen.control.sensor_key import where
from tmm_gen.errors import UserError
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.beam import CellName

Array = NDArray[np.float64]

_ASKEW = 0.1
"""A beam of whose bending so small a part is about its motor's axis shows nothing of what the motor does."""


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
    """Return where the gauge of a motor is, counted from 0.

    Raises
    ------
    UserError
        If it carries no beam that bends about its axis.
    """
    for beam in _carried(scene, motors, motor):
        springs = list(_springs(scene, motors, motor, beam))
        if springs:
            return Site(beam, min(spring.place for spring in springs))
    name = motors.names[motor]
    others = [each for k, each in enumerate(motors.names) if k != motor]
    raise UserError(
        f"{where(scene, 'strain')}: the motor '{name}' carries no beam that bends about its axis, "
        "on which a gauge could be. "
        + (f"Name others that do, such as {{ {others[-1]} = 0.01 }}." if others else "Remove the key.")
    )


def _shares(places: Array, place: float) -> Array:
    """Return what each of some places counts for at one between them."""
    return np.array([np.interp(place, places, unit) for unit in np.eye(len(places))])


def _carried(scene: Scene, motors: Motors, motor: int) -> list[str]:
    """Return the beams that a motor carries and no motor behind it does, the innermost first."""
    here = motors.each[motor]
    if scene.spatial is None:
        return [
            part.name for part in scene.parts if part.kind == "beam" and here.place < part.first <= here.end
        ]
    driven = {each.place for each in motors.each}
    joints, found = scene.spatial.joints, []
    for name in _beams(scene):
        number = min(number for number, _ in _bends(scene, name))
        while number and number - 1 not in driven:
            number = joints[number - 1].host
        if number - 1 == here.place:
            found.append(name)
    return found


def _springs(scene: Scene, motors: Motors, motor: int, beam: str) -> Iterator[Spring]:
    """Yield the springs of a beam that a motor carries."""
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
    axes = Still(ArmNumbers(scene.spatial), np.zeros(size), {}).axes
    bends = list(_bends(scene, beam))
    piece = _beams(scene)[beam] / max(cell.number for _, cell in bends)
    about = {cell.way: float(axes[motors.each[motor].place] @ axes[number - 1]) for number, cell in bends}
    if max(map(abs, about.values())) < _ASKEW:
        return
    for number, cell in bends:
        joint = scene.spatial.joints[number - 1]
        bend = np.zeros(size)
        bend[number - 1] = about[cell.way]
        yield Spring((cell.number - 0.5) * piece, joint.stiffness, joint.damping, bend)


def _beams(scene: Scene) -> dict[str, float]:
    """Return the lengths of the beams of an arm in space that bend, m."""
    entries: Any = scene.source.data.get("beam", [])
    return {entry["name"]: float(entry["length"]) for entry in entries if list(_bends(scene, entry["name"]))}


def _bends(scene: Scene, beam: str) -> Iterator[tuple[int, CellName]]:
    """Yield the joints in which a beam in space bends: number, and name."""
    assert scene.spatial is not None
    for number, joint in enumerate(scene.spatial.joints, start=1):
        cell = CellName.of(joint.name)
        if cell is not None and cell.beam == beam and cell.way != "twist":
            yield number, cell
