"""A planar arm as a row: pins, massless rods, point masses at the nodes between them, loads."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.elements import nodes as element
from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.planar import LENGTH, MASS
from tmm_gen.derive.station.lets import Coordinate
from tmm_gen.row.pins import armature_of, at_the_joint, bent_at_rest, drives_of, pin_of
from tmm_gen.row.row import Combination, Elements, Load, Parameter, Row, Signal
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
from tmm_gen.scene import Scene, station_of
from tmm_gen.scene.model import FloatingBase
from tmm_gen.scene.quantity import INPUT_UNITS

ALONG_X = Coordinate("x", "force_x", False, "m/s^2", "N")
ALONG_Y = Coordinate("y", "force_y", False, "m/s^2", "N")
ANGLE = Coordinate("u", "torque", True, "rad/s^2", "N m")

COMPONENTS = ("force_x", "force_y", "torque")
_LOADS = dict(zip(COMPONENTS, (element.LOAD_X, element.LOAD_Y, element.LOAD_TORQUE), strict=True))


def planar_row(scene: Scene, integrator: str) -> Row:
    """Return a planar arm's row.

    Parameters
    ----------
    integrator : str
        Title of the integrator, for headers.
    """
    named = _parameters(scene)
    loads = loads_of(scene, COMPONENTS)
    length, mass, inertia, center = (symbol(named[k]) for k in ("length", "mass", "inertia", "center"))
    left_over = inertia - mass * center * (1 - center) * length**2
    drives = drives_of(scene)
    pins, pins_in_detail = (
        tuple(pin_of(scene, named, index, drives, armature) for index in range(scene.stations))
        for armature in (sp.Symbol("armature"), at_the_joint(scene))
    )
    hub = _body(named["hub_inertia"])
    if named["hub_damping"] is not None:
        hub += (element.BEARING.with_values({element.FRICTION: symbol(named["hub_damping"])}),)
    floating, base_mass = _floating(scene, symbol(named["hub_mass"]), (1 - center) * mass)
    hub_mass = (_mass(symbol(named["hub_mass"])),) if named["hub_mass"] is not None else ()
    inner, outer = _mass(mass * (1 - center)), _mass(mass * center)
    on_link, at_tip = _load(loads["station"]), _load(loads["tail"])
    tip_mass, tip_body = symbol(named["tip_mass"]), _body(named["tip_inertia"])
    detail = (inner, _rod(length, left_over), outer, *on_link)
    combinations: tuple[Combination, ...] = ()
    if scene.model.linearisation == "newton":
        rest = Combination(
            "rod_inertia", "inertia of a link that masses at its ends leave over", "kg m^2", left_over
        )
        alike = len({(link.mass, link.center) for link in scene.links}) == 1
        if alike and not scene.hosts:
            # neighbours at a node make up one link's mass; what that is too much, the tip takes off again
            end_mass = Combination(
                "end_mass",
                "mass at the tip less the share of a link beyond it",
                "kg",
                tip_mass - (1 - center) * mass,
            )
            combinations, node_mass, beyond = (end_mass, rest), mass, sp.Symbol(end_mass.name)
        else:
            joined = Combination(
                "node_mass",
                "mass at the outer end of each link",
                "kg",
                center * mass,
                (1 - center) * mass,
                tip_mass,
            )
            combinations, node_mass, beyond = (joined, rest), sp.Symbol(joined.name), sp.Integer(0)
        rod_inertia = sp.Symbol(rest.name)
        station: Elements = (_rod(length, rod_inertia), _mass(node_mass), *on_link)
        tail: Elements = (*((_mass(beyond),) if beyond != 0 else ()), *tip_body, *at_tip)
    else:
        combinations = (
            Combination("carried_mass", "mass acting at a link's outer end", "kg", center * mass),
            Combination(
                "pin_inertia",
                "inertia of a link about its inner end",
                "kg m^2",
                inertia + center**2 * length**2 * mass,
            ),
        )
        carried_mass, pin_inertia = (sp.Symbol(c.name) for c in combinations)
        link = element.RIGID_LINK.with_values(
            {
                LENGTH: length,
                MASS: mass,
                element.CARRIED_MASS: carried_mass,
                element.PIN_INERTIA: pin_inertia,
            }
        )
        station = (link, *on_link)
        tail = (*((_mass(tip_mass),) if tip_mass != 0 else ()), *tip_body, *at_tip)
    gravity = symbol(named["gravity"])
    model = "planar arm, large rotations"
    model += ", gravity" if named["gravity"] else ""
    model += ", tip mass" if named["tip_mass"] else ""
    rounds = f", {scene.sweeps} iterations" if scene.sweeps > 1 else ""
    if corrections := scene.model.corrections:
        rounds += f", {corrections} correction{'s' if corrections > 1 else ''}"
    return Row(
        name=scene.name,
        title=scene.title,
        coordinates=(ALONG_X, ALONG_Y, ANGLE),
        about="prediction",
        sign=1,
        base=(*floating, *hub, *_load(loads["base"])),
        boundary=boundary_of(scene),
        stations=_behind(scene, pins, station),
        tail=tail,
        detail=_behind(scene, pins_in_detail, detail),
        detail_tail=(*((_mass(tip_mass),) if tip_mass != 0 else ()), *tip_body, *at_tip),
        detail_base=(*hub_mass, *hub, *_load(loads["base"])),
        parameters=tuple(p for p in named.values() if p is not None),
        combinations=(*combinations, *base_mass, *armature_of(scene)),
        inputs=signals_of(scene),
        loads=(*(load for group in loads.values() for load in group.values()), *drives),
        prescribed=prescribed_of(scene),
        readings=tuple(
            reading_of(scene, o, f"output {o.name}: {o.of.replace('_', ' ')}", -1) for o in scene.outputs
        ),
        held=_held(scene),
        fall=gravity,
        counts_heat=_counts_heat(scene),
        facts=facts_of(scene, model, integrator, linearisation=scene.model.linearisation + rounds),
        angles=tuple(scene.initial.angles),
        rates=tuple(scene.initial.rates),
        hosts=tuple(host - 1 for host in scene.hosts),
        floats=scene.floats,
    )


def _floating(scene: Scene, own: sp.Expr, of_link: sp.Expr) -> tuple[Elements, tuple[Combination, ...]]:
    """Return what moves with a base that floats: its own mass, and the shares of links that hang there."""
    if not scene.floats:
        return (), ()
    doc = "mass at the base, its own and the shares of the links there"
    joined = Combination("base_mass", doc, "kg", own, of_link, at_base=True)
    return (_mass(sp.Symbol(joined.name)),), (joined,)


def _parameters(scene: Scene) -> dict[str, Parameter | None]:
    links, joints, base, tip = scene.links, scene.joints, scene.base, scene.tip
    moved = scene.hub
    found = (
        parameter("length", "link length", "m", [link.length for link in links]),
        parameter("mass", "link mass", "kg", [link.mass for link in links]),
        parameter("inertia", "link inertia about its centre of mass", "kg m^2", [x.inertia for x in links]),
        parameter("center", "centre of mass along the link, 0 to 1", "1", [link.center for link in links]),
        parameter("stiffness", "joint stiffness", "N m/rad", [j.stiffness for j in joints])
        if any(j.stiffness for j in joints)
        else None,
        parameter("damping", "joint damping", "N m s/rad", [j.damping for j in joints])
        if any(j.damping for j in joints)
        else None,
        parameter("rest", "angle at which a joint's spring is slack", "rad", [j.rest for j in joints])
        if any(map(bent_at_rest, joints))
        else None,
        parameter(
            "rotor_inertia",
            "inertia of a joint's motor, on its own side",
            "kg m^2",
            [j.rotor_inertia for j in joints],
        )
        if any(j.rotor_inertia for j in joints)
        else None,
        parameter("gear", "turns of a joint's motor per turn of the joint", "1", [j.gear for j in joints])
        if any(j.gear != 1.0 for j in joints)
        else None,
        optional("gravity", "gravity along -y", "m/s^2", scene.model.gravity),
        optional("hub_inertia", "hub inertia", "kg m^2", base.inertia if moved else None),
        optional("hub_mass", "mass of the bodies at the base", "kg", scene.base.mass)
        if isinstance(scene.base, FloatingBase)
        else None,
        optional(
            "hub_damping",
            "viscous damping of the hub to ground",
            "N m s/rad",
            base.damping if moved else None,
        ),
        optional("tip_mass", "mass at the tip", "kg", tip.mass if tip else None),
        optional("tip_inertia", "inertia at the tip", "kg m^2", tip.inertia if tip else None),
    )
    names = (
        *("length", "mass", "inertia", "center", "stiffness", "damping", "rest", "rotor_inertia", "gear"),
        *("gravity", "hub_inertia", "hub_mass", "hub_damping", "tip_mass", "tip_inertia"),
    )
    return dict(zip(names, found, strict=True))


def _behind(scene: Scene, pins: Elements, station: Elements) -> tuple[Elements, ...]:
    """Return each pin with what stands behind it; a shaft has neither length nor mass of its own."""
    return tuple(
        (pin, *(() if link.massless else station)) for pin, link in zip(pins, scene.links, strict=True)
    )


def _mass(value: sp.Expr) -> Element:
    return element.MASS_AT_NODE.with_values(
        {element.POINT_MASS: value, element.GRAVITY: sp.Symbol("gravity")}
    )


def _rod(length: sp.Expr, inertia: sp.Expr) -> Element:
    return element.ROD.with_values({LENGTH: length, element.BODY_INERTIA: inertia})


def _body(inertia: Parameter | None) -> Elements:
    if inertia is None:
        return ()
    return (element.BODY.with_values({element.BODY_INERTIA: inertia.symbol}),)


def _load(loads: dict[str, Load]) -> Elements:
    if not loads:
        return ()
    values = {_LOADS[c]: loads[c].symbol if c in loads else sp.Integer(0) for c in COMPONENTS}
    return (element.LOAD.with_values(values),)


def _held(scene: Scene) -> dict[str, Signal]:
    """Return each load beyond a joint, or on the tip's body, whose force or torque is an output."""
    n = scene.stations
    inmost = min(
        (max(station_of(o.at, n), 1) for o in scene.outputs if scene.quantity(o).read == "force"),
        default=n + 1,
    )
    held = [i for i in scene.inputs if i.acts in ("force_x", "force_y") and station_of(i.at, n) >= inmost]
    if any(scene.quantity(o).read == "own" and o.at == "tip" for o in scene.outputs):
        held += [i for i in scene.inputs if i.acts == "torque" and station_of(i.at, n) == n]
    felt = {k for o in scene.outputs if scene.quantity(o).read == "through" for k in scene.joints_of(o)}
    held += [i for i in scene.inputs if i.acts == "drive" and i.at in felt]
    return {i.name: Signal(f"held_{i.name}", f"{i.name} as it last acted", INPUT_UNITS[i.acts]) for i in held}


def _counts_heat(scene: Scene) -> bool:
    damped = any(j.damping for j in scene.joints) or (scene.hub > 0 and scene.base.damping > 0.0)
    return damped and any(scene.quantity(o).accumulates for o in scene.outputs)
