"""A scene as linear elements from the base outward: what all frequency-domain sweeps run over."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.elements import torsion
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.small_motion import LOAD, rest_elements
from tmm_gen.derive.transfer import laplace_matrix
from tmm_gen.modal.blocks import ElementFunctions, element_functions
from tmm_gen.modal.rest import Rest, rest_at, straight
from tmm_gen.scene import Scene, station_of
from tmm_gen.scene.flat import require_flat
from tmm_gen.scene.model import FloatingBase

Array = NDArray[np.float64]
_Loads = tuple[tuple[int, tuple[float, ...]], ...]


PIVOT = "pivot"
"""A joint that may turn freely, with a rotor in it or a torque: its law is given by numbers, not by a compliance."""

GEARED = "geared joint"

JOINTS = ("joint", GEARED, PIVOT)
"""Names of the elements that stand on the outer end of a link, or on the base."""


@dataclass(frozen=True)
class Placed:
    """An element at its place.

    Parameters
    ----------
    name : str
        "joint", "geared joint", "pivot", "link", "hub", "friction" or "tip".
    element : Element
        Its declaration, linear in its motions.
    station : int
        0 for the hub, i for joint and link i, counted from 1.
    values : tuple of float
        Of its parameters.
    loads : tuple of (int, tuple of float)
        External loads at its outboard side: number of the input and force for a unit of it.
    """

    name: str
    element: Element
    station: int
    values: tuple[float, ...] = ()
    loads: tuple[tuple[int, tuple[float, ...]], ...] = ()


@dataclass(frozen=True)
class LinearArm:
    """A chain, or a planar arm in small motion about rest.

    Parameters
    ----------
    scene : Scene
        What it came from.
    width : int
        Motions of a station: ``theta``, or ``x, y, theta``.
    elements : tuple of Placed
        From the base outward, branch by branch.
    free : tuple of bool
        Which motions of the inner end are free; their forces are zero there.
    prescribed : int or None
        Number of the input that is the base's angle.
    sign : float
        1 where forces are those of the outer on the inner side (chain), -1 where it is the other way round.
    rest : Rest or None
        Where a planar arm rests.
    """

    scene: Scene
    width: int
    elements: tuple[Placed, ...]
    free: tuple[bool, ...]
    prescribed: int | None
    sign: float
    rest: Rest | None

    def functions(self, placed: Placed) -> ElementFunctions:
        """Return the functions of an element's type."""
        return element_functions(placed.element)

    @cached_property
    def inner(self) -> tuple[int, ...]:
        """Where each element begins: 0 for the base, k + 1 behind element k."""
        found, behind = [], {0: 0}
        for k, placed in enumerate(self.elements):
            joint = placed.name in JOINTS
            found.append(behind[self.scene.host(placed.station)] if joint else k)
            behind[placed.station] = k + 1
        return tuple(found)

    @property
    def hub(self) -> bool:
        """Whether the base turns freely."""
        return self.free[-1]


def linear_arm(scene: Scene, rest: Rest | None = None) -> LinearArm:
    """Return the elements of a scene.

    Parameters
    ----------
    scene : Scene
        Chain or planar.
    rest : Rest, optional
        About which a planar arm moves; by default straight along x and weightless.
    """
    require_flat(scene, "transfer matrices about rest do not")
    if scene.model.linear:
        return _chain(scene)
    return _planar(scene, rest if rest is not None else rest_at(scene, straight(scene), gravity=0.0))


def _chain(scene: Scene) -> LinearArm:
    loads = _loads(scene, torsion.TORQUE, {"torque": torsion.LOAD})
    placed: list[Placed] = []
    if scene.hub:
        placed.append(Placed("friction", torsion.GROUND_DAMPER, 0, (scene.base.damping,)))
        placed.append(Placed("hub", torsion.LINK, 0, (scene.base.inertia,), loads[0]))
    for i, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True), start=1):
        law = (joint.stiffness, joint.damping)
        if joint.ratio == 1.0:
            placed.append(Placed("joint", torsion.JOINT, i, law))
        else:
            placed.append(Placed(GEARED, torsion.GEARED_JOINT, i, (*law, joint.ratio)))
        placed.append(Placed("link", torsion.LINK, i, (link.inertia,), loads[i]))
    return LinearArm(scene, 1, tuple(placed), (bool(scene.hub),), _prescribed(scene), 1.0, None)


def _planar(scene: Scene, rest: Rest) -> LinearArm:
    at_rest = rest_elements()
    symbols = dict(zip(("force_x", "force_y", "torque"), LOAD, strict=True))
    loads = _loads(scene, at_rest["load"], symbols)
    drives = _drives(scene, _unit_load(at_rest["load"], symbols["torque"]))
    still = (0.0,) * 7
    placed: list[Placed] = []

    def add(name: str, station: int, *values: float, loads: _Loads = ()) -> None:
        placed.append(Placed(name, at_rest[name], station, values, loads))

    if isinstance(scene.base, FloatingBase):
        placed.append(
            Placed("hub", at_rest["tip"], 0, (scene.base.mass, scene.base.inertia, *still), loads[0])
        )
    elif scene.hub:
        add("hub", 0, scene.base.inertia, scene.base.damping, *still, loads=loads[0])
    for i, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True)):
        if joint.stiffness > 0.0 and not joint.rotor_inertia and not drives[i]:
            add("joint", i + 1, joint.stiffness, joint.damping, *still)
        else:
            law = (joint.stiffness, joint.damping, joint.armature)
            placed.append(Placed(PIVOT, at_rest["joint"], i + 1, law, drives[i]))
        own = (link.length, link.mass, link.inertia, link.center)
        state = (float(rest.angles[i]), *map(float, rest.inner[i]), *map(float, rest.outer[i]))
        add("link", i + 1, *own, *state, loads=loads[i + 1])
    if scene.tip and (scene.tip.mass or scene.tip.inertia):
        add("tip", scene.stations, scene.tip.mass, scene.tip.inertia, *still)
    free = (scene.floats, scene.floats, bool(scene.hub))
    return LinearArm(scene, 3, tuple(placed), free, _prescribed(scene), -1.0, rest)


def _prescribed(scene: Scene) -> int | None:
    return None if scene.prescribed is None else scene.inputs.index(scene.prescribed)


def _drives(scene: Scene, torque: tuple[float, ...]) -> list[_Loads]:
    """Return the torques in each joint, 1 to n, that act on its outer side for a unit of an input."""
    found: list[list[tuple[int, tuple[float, ...]]]] = [[] for _ in scene.joints]
    for number, item in enumerate(scene.inputs):
        if item.acts == "drive" and isinstance(item.at, int):
            unit = scene.joints[item.at - 1].gear * np.array(torque)
            found[item.at - 1].append((number, tuple(unit.tolist())))
    return [tuple(each) for each in found]


def _loads(scene: Scene, load: Element, symbols: dict[str, sp.Symbol]) -> list[_Loads]:
    """Return the loads at each station, 0 to n: what a unit of an input adds to the outboard forces."""
    found: list[list[tuple[int, tuple[float, ...]]]] = [[] for _ in range(scene.stations + 1)]
    for number, item in enumerate(scene.inputs):
        if item.acts == "drive":  # what acts on the outer side of a joint, the inner one feels reversed
            if isinstance(item.at, int) and (scene.host(item.at) or scene.hub):
                torque = np.array(_unit_load(load, symbols["torque"]))
                unit = -scene.joints[item.at - 1].gear * torque
                found[scene.host(item.at)].append((number, tuple(unit.tolist())))
        elif item is not scene.prescribed:
            unit_load = tuple(item.factor * each for each in _unit_load(load, symbols[item.acts]))
            found[station_of(item.at, scene.stations)].append((number, unit_load))
    return [tuple(each) for each in found]


@cache
def _unit_load(load: Element, unit: sp.Symbol) -> tuple[float, ...]:
    """Return ``u2`` of a load element for a unit of an input, derived from its equations."""
    values = {symbol: int(symbol == unit) for symbol in load.inputs}
    return tuple(float(entry) for entry in laplace_matrix(load).u2.subs(values))
