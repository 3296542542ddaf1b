"""A torsional chain as a row: springs with dampers, inertias, torques."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements import torsion as element
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.lets import Coordinate
from tmm_gen.row.row import Combination, Load, Row
from tmm_gen.row.words import (
    boundary_of,
    facts_of,
    loads_of,
    optional,
    parameter,
    prescribed_of,
    reading_of,
    signals_of,
    symbol,
)
from tmm_gen.scene import Scene

ANGLE = Coordinate("", "torque", True, "rad/s^2", "N m")


def chain_row(scene: Scene, integrator: str) -> Row:
    """Return a chain's row.

    Parameters
    ----------
    integrator : str
        Title of the integrator, for headers.
    """
    stiffness = parameter("stiffness", "joint stiffness", "N m/rad", [j.stiffness for j in scene.joints])
    damping = (
        parameter("damping", "joint damping", "N m s/rad", [j.damping for j in scene.joints])
        if any(j.damping for j in scene.joints)
        else None
    )
    ratios = [j.ratio for j in scene.joints]
    ratio = parameter("ratio", "turns of a joint's inner side per turn of its outer one", "1", ratios)
    geared = any(each != 1.0 for each in ratios)
    inertia = parameter("inertia", "link inertia", "kg m^2", [link.inertia for link in scene.links])
    moved = scene.hub
    hub_inertia = parameter("hub_inertia", "hub inertia", "kg m^2", [scene.base.inertia]) if moved else None
    hub_damping = optional(
        "hub_damping",
        "viscous damping of the hub to ground",
        "N m s/rad",
        scene.base.damping if moved else None,
    )
    loads = loads_of(scene, ("torque",))
    values = {element.STIFFNESS: stiffness.symbol, element.DAMPING: symbol(damping)}
    doc = "turns of a joint's outer side per turn of its inner one"
    turn = Combination("turn", doc, "1", 1 / ratio.symbol)
    joints, in_detail = (
        {True: element.JOINT.with_values(values), False: element.GEARED_JOINT.with_values(values | of_gear)}
        for of_gear in ({element.RATIO: 1 / sp.Symbol(turn.name)}, {element.RATIO: ratio.symbol})
    )
    link = element.LINK.with_values({element.INERTIA: inertia.symbol})
    base: tuple[Element, ...] = ()
    if hub_inertia is not None:
        base = (element.LINK.with_values({element.INERTIA: hub_inertia.symbol}),)
        if hub_damping is not None:
            base += (element.GROUND_DAMPER.with_values({element.GROUND_DAMPING: hub_damping.symbol}),)
    base += _torque(loads["base"])
    beyond = (link, *_torque(loads["station"]))
    stations, detail = (
        tuple((kinds[each == 1.0], *beyond) for each in ratios) for kinds in (joints, in_detail)
    )
    tail = _torque(loads["tail"])
    found = (stiffness, damping, ratio if geared else None, inertia, hub_inertia, hub_damping)
    return Row(
        name=scene.name,
        title=scene.title,
        coordinates=(ANGLE,),
        about="known",
        sign=-1,
        base=base,
        boundary=boundary_of(scene),
        stations=stations,
        tail=tail,
        detail=detail,
        detail_tail=tail,
        detail_base=base,
        parameters=tuple(p for p in found if p is not None),
        combinations=(turn,) if geared else (),
        inputs=signals_of(scene),
        loads=tuple(load for group in loads.values() for load in group.values()),
        prescribed=prescribed_of(scene),
        readings=tuple(reading_of(scene, output, "outputs", 1) for output in scene.outputs),
        facts=facts_of(scene, "torsional chain (linear)", integrator),
        angles=tuple(scene.initial.angles),
        rates=tuple(scene.initial.rates),
        hosts=tuple(host - 1 for host in scene.hosts),
    )


def _torque(loads: dict[str, Load]) -> tuple[Element, ...]:
    return tuple(element.TORQUE.with_values({element.LOAD: load.symbol}) for load in loads.values())
