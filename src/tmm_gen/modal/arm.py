"""A scene as a row of linear elements, base to tip: what all frequency-domain sweeps run over."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.blocks import ElementFunctions, Kind, element_functions
from tmm_gen.modal.rest import Rest, rest_at, straight
from tmm_gen.scene import Scene, station_of

Array = NDArray[np.float64]


PIVOT = "pivot"
"""A joint that may turn freely, with a rotor in it or a torque: its law is given by numbers, not by a compliance."""


@dataclass(frozen=True)
class Placed:
    """An element at its place.

    Parameters
    ----------
    name : str
        Type, see :func:`~tmm_gen.modal.blocks.element_functions`.
    station : int
        0 for the hub, i for joint and link i, counted from 1.
    values : tuple of float
        Of its parameters.
    loads : tuple of (int, tuple of float)
        External loads at its outboard side: number of the input and force for a unit of it.
    """

    name: str
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
    kind : {"chain", "planar"}
        Family.
    width : int
        Motions of a station: ``theta``, or ``x, y, theta``.
    elements : tuple of Placed
        Base to tip.
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
    kind: Kind
    width: int
    elements: tuple[Placed, ...]
    free: tuple[bool, ...]
    prescribed: int | None
    sign: float
    rest: Rest | None

    def functions(self, placed: Placed) -> ElementFunctions:
        """Return the functions of an element's type."""
        return element_functions(self.kind, placed.name)

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
    if scene.model.kind == "chain":
        return _chain(scene)
    return _planar(scene, rest if rest is not None else rest_at(scene, straight(scene), gravity=0.0))


def _chain(scene: Scene) -> LinearArm:
    loads = _loads(scene, "chain")
    placed: list[Placed] = []
    if scene.base.kind == "motor":
        placed.append(Placed("friction", 0, (scene.base.damping,)))
        placed.append(Placed("hub", 0, (scene.base.inertia,), loads[0]))
    for i, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True), start=1):
        placed.append(Placed("joint", i, (joint.stiffness, joint.damping)))
        placed.append(Placed("link", i, (link.inertia,), loads[i]))
    return LinearArm(
        scene, "chain", 1, tuple(placed), (scene.base.kind == "motor",), _prescribed(scene), 1.0, None
    )


def _planar(scene: Scene, rest: Rest) -> LinearArm:
    loads = _loads(scene, "planar")
    drives = _drives(scene)
    still = (0.0,) * 7
    placed: list[Placed] = []
    if scene.base.kind == "motor":
        placed.append(Placed("hub", 0, (scene.base.inertia, scene.base.damping, *still), loads[0]))
    for i, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True)):
        law = (joint.stiffness, joint.damping)
        if joint.stiffness > 0.0 and not joint.rotor_inertia and not drives[i]:
            placed.append(Placed("joint", i + 1, (*law, *still)))
        else:
            placed.append(Placed(PIVOT, i + 1, (*law, joint.armature), drives[i]))
        own = (link.length, link.mass, link.inertia, link.center)
        state = (float(rest.angles[i]), *map(float, rest.inner[i]), *map(float, rest.outer[i]))
        placed.append(Placed("link", i + 1, (*own, *state), loads[i + 1]))
    if scene.tip and (scene.tip.mass or scene.tip.inertia):
        placed.append(Placed("tip", scene.stations, (scene.tip.mass, scene.tip.inertia, *still)))
    free = (False, False, scene.base.kind == "motor")
    return LinearArm(scene, "planar", 3, tuple(placed), free, _prescribed(scene), -1.0, rest)


def _prescribed(scene: Scene) -> int | None:
    return next((k for k, item in enumerate(scene.inputs) if item.acts == "angle"), None)


def _drives(scene: Scene) -> list[tuple[tuple[int, tuple[float, ...]], ...]]:
    """Return the torques in each joint, 1 to n, that act on its outer side for a unit of an input."""
    found: list[list[tuple[int, tuple[float, ...]]]] = [[] for _ in scene.joints]
    for number, item in enumerate(scene.inputs):
        if item.acts == "drive" and isinstance(item.at, int):
            unit = scene.joints[item.at - 1].gear * np.array(_unit_load("planar", "torque"))
            found[item.at - 1].append((number, tuple(unit.tolist())))
    return [tuple(each) for each in found]


def _loads(scene: Scene, kind: Kind) -> list[tuple[tuple[int, tuple[float, ...]], ...]]:
    """Return the loads at each station, 0 to n: what a unit of an input adds to the outboard forces."""
    found: list[list[tuple[int, tuple[float, ...]]]] = [[] for _ in range(scene.stations + 1)]
    for number, item in enumerate(scene.inputs):
        if (
            item.acts == "drive"
        ):  # what acts on the outer side of a joint, the inner one feels the other way round
            if isinstance(item.at, int) and (item.at > 1 or scene.base.kind == "motor"):
                unit = -scene.joints[item.at - 1].gear * np.array(_unit_load(kind, "torque"))
                found[item.at - 1].append((number, tuple(unit.tolist())))
        elif item.acts != "angle":
            found[station_of(item.at, scene.stations)].append((number, _unit_load(kind, item.acts)))
    return [tuple(each) for each in found]


@cache
def _unit_load(kind: Kind, acts: str) -> tuple[float, ...]:
    """Return ``u2`` of a load element for a unit of an input, derived from its equations."""
    from tmm_gen.derive.elements.torsion import LOAD as TORQUE_SYMBOL
    from tmm_gen.derive.elements.torsion import TORQUE
    from tmm_gen.derive.laplace.planar import LOAD, rest_elements
    from tmm_gen.derive.transfer import laplace_matrix

    if kind == "chain":
        return (float(laplace_matrix(TORQUE).u2[0].subs(TORQUE_SYMBOL, 1)),)
    chosen = ("force_x", "force_y", "torque").index(acts)
    values = {symbol: int(k == chosen) for k, symbol in enumerate(LOAD)}
    return tuple(float(entry) for entry in laplace_matrix(rest_elements()["load"]).u2.subs(values))
