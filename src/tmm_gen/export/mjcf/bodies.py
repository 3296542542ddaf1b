"""Bodies and joints of an arm in MJCF: hinges with springs and dampers, no contact."""

from __future__ import annotations

from dataclasses import dataclass
from xml.etree import ElementTree as Xml

from tmm_gen.scene import Scene
from tmm_gen.scene.model import FloatingBase

_RADIUS = 0.02
"""Of what is drawn, over the length of the arm; nothing collides, nothing drawn has mass."""

_LIGHT = 1e-9
"""Mass of a hub, kg, or of a shaft, and its inertia: MuJoCo wants some, but it is not to weigh on the ground."""


def text_of(*values: float) -> str:
    """Write numbers as they read back."""
    return " ".join(repr(float(value)) for value in values)


@dataclass(frozen=True)
class Bodies:
    """The bodies of a model, by the station they belong to.

    Parameters
    ----------
    ground : Element
        Body fixed to the world on which everything stands.
    base : Element
        The hub's, or the ground where there is none.
    links : tuple of Element, length n
        Body of each link.
    tip : Element
        Body at the outer end of the last link, or the last link itself in a chain.
    joints : tuple of str
        Names of the hinges, base to tip, the hub's first where there is a motor.
    """

    ground: Xml.Element
    base: Xml.Element
    links: tuple[Xml.Element, ...]
    tip: Xml.Element
    joints: tuple[str, ...]


def add_bodies(world: Xml.Element, scene: Scene) -> Bodies:
    """Add the bodies of a scene: a planar arm in the x-y plane, or the discs of a chain along z."""
    planar = scene.model.in_plane
    size = _RADIUS * (sum(link.length for link in scene.links) if planar else float(scene.stations))
    ground = parent = Xml.SubElement(world, "body", name="ground")
    names = joint_names(scene)
    joints = []
    if scene.hub:
        parent = Xml.SubElement(parent, "body", name="hub")
        for name, axis in (("hub_x", "1 0 0"), ("hub_y", "0 1 0")) if scene.floats else ():
            Xml.SubElement(parent, "joint", name=name, type="slide", axis=axis)
        Xml.SubElement(
            parent, "joint", name="hub", type="hinge", axis="0 0 1", damping=text_of(scene.base.damping)
        )
        # about a fixed point its mass does nothing
        mass = scene.base.mass if isinstance(scene.base, FloatingBase) else 0.0
        add_inertial(parent, mass or _LIGHT, 0.0, scene.base.inertia)
        add_disc(parent, 2.0 * size)
        joints.append("hub")
    inmost = parent
    links: list[Xml.Element] = []
    called = link_names(scene)
    for number, (joint, link) in enumerate(zip(scene.joints, scene.links, strict=True), start=1):
        host = scene.host(number)
        along = (scene.links[host - 1].length, 0.0) if planar else (0.0, 1.0)
        parent, place = (links[host - 1], along) if host else (inmost, (0.0, 0.0))
        parent = Xml.SubElement(parent, "body", name=called[number - 1], pos=text_of(place[0], 0.0, place[1]))
        hinge = Xml.SubElement(
            parent,
            "joint",
            name=names[number - 1],
            type="hinge",
            axis="0 0 1",
            stiffness=text_of(joint.stiffness),
            damping=text_of(joint.damping),
        )
        if joint.rotor_inertia:
            hinge.set("armature", text_of(joint.armature))
        if joint.rest:
            hinge.set("springref", text_of(joint.rest))
        joints.append(names[number - 1])
        links.append(parent)
        if planar:
            if link.massless:  # a motor's shaft: MuJoCo wants some mass of everything that moves
                add_inertial(parent, _LIGHT, 0.0, _LIGHT)
                continue
            add_inertial(parent, link.mass, link.center * link.length, link.inertia)
            Xml.SubElement(
                parent, "geom", type="capsule", size=_drawn(size), fromto=text_of(0, 0, 0, link.length, 0, 0)
            )
        else:
            add_inertial(parent, 1.0, 0.0, link.inertia)
            add_disc(parent, 10.0 * size / scene.stations)
    tip = parent
    if planar:
        tip = Xml.SubElement(parent, "body", name=called[-1], pos=text_of(scene.links[-1].length, 0.0, 0.0))
        if scene.tip is not None and (scene.tip.mass or scene.tip.inertia):
            add_inertial(tip, scene.tip.mass, 0.0, scene.tip.inertia)
            Xml.SubElement(tip, "geom", type="sphere", size=_drawn(2.0 * size))
    return Bodies(ground, inmost, tuple(links), tip, tuple(joints))


def link_names(scene: Scene) -> tuple[str, ...]:
    """Return what the bodies of links and tip are called: as the parts they come from, or by number."""
    found = [f"link{number}" for number in range(1, scene.stations + 1)]
    for part in scene.parts:
        if part.kind in ("beam", "link") and not part.fixed:
            count = part.last - part.first + 1
            pieces = [part.name] if count == 1 else [f"{part.name}_{k}" for k in range(1, count + 1)]
            found[part.first - 1 : part.last] = pieces
        elif part.gear > part.joint:
            found[part.joint - 1] = f"{part.name}_shaft"
    taken, names = {"world", "ground", "hub"}, []
    for name in (*found, "tip"):
        free = name
        while free in taken:
            free += "_"
        taken.add(free)
        names.append(free)
    return tuple(names)


def joint_names(scene: Scene) -> tuple[str, ...]:
    """Return what the joints are called: as in the scene, or by their number where it does not name them."""
    named = {part.joint: part.name for part in scene.parts if part.joint}
    named |= {p.gear: f"{p.name}_gear" for p in scene.parts if p.gear > p.joint}
    taken = {"hub", "hub_x", "hub_y", *named.values()}
    found = []
    for number in range(1, scene.stations + 1):
        name = named.get(number, f"joint{number}")
        while number not in named and name in taken:
            name += "_"
        found.append(name)
    return tuple(found)


def add_inertial(parent: Xml.Element, mass: float, along: float, inertia: float) -> None:
    """Give a body its mass, kg, its place along the body, m, and its moment of inertia about the hinges, kg m^2."""
    # the other two moments are out of play; alike, they are always those of a possible body
    Xml.SubElement(
        parent,
        "inertial",
        mass=text_of(mass),
        pos=text_of(along, 0.0, 0.0),
        diaginertia=text_of(inertia, inertia, inertia),
    )


def add_disc(parent: Xml.Element, radius: float) -> None:
    """Draw a disc about the hinge, of some radius, m."""
    Xml.SubElement(parent, "geom", type="cylinder", size=_drawn(radius, 0.1 * radius))


def _drawn(*sizes: float) -> str:
    return " ".join(f"{size:.4g}" for size in sizes)
