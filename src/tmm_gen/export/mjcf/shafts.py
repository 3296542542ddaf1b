"""Shafts of a drivetrain in MJCF: each turns on a hinge of its own, and springs between two are tendons over both.

A tendon's length is what the spring between two shafts is twisted by, ``theta_out - theta_in/ratio``: gears are in it.
"""

from __future__ import annotations

from xml.etree import ElementTree as Xml

from tmm_gen.export.mjcf.bodies import Bodies, add_disc, add_inertial, joint_names, link_names, text_of
from tmm_gen.scene import Scene

_SIZE = 0.1
"""Radius of what is drawn, m; shafts stand a metre apart along z."""


def add_shafts(root: Xml.Element, world: Xml.Element, scene: Scene) -> Bodies:
    """Add the shafts of a drivetrain, and what gives way between them.

    Parameters
    ----------
    root, world : Element
        The model, and its bodies.
    scene : Scene
        A chain of parts by name.
    """
    ground = Xml.SubElement(world, "body", name="ground")
    names = (*(["hub"] * scene.hub), *link_names(scene)[: scene.stations])
    inertias = (*([scene.base.inertia] * scene.hub), *(link.inertia for link in scene.links))
    bodies: list[Xml.Element] = []
    for place, (name, inertia) in enumerate(zip(names, inertias, strict=True)):
        body = Xml.SubElement(ground, "body", name=name, pos=text_of(0.0, 0.0, place))
        hinge = Xml.SubElement(body, "joint", name=name, type="hinge", axis="0 0 1")
        if name == "hub":
            hinge.set("damping", text_of(scene.base.damping))
        add_inertial(body, 1.0, 0.0, inertia)
        add_disc(body, _SIZE)
        bodies.append(body)
    tendons = Xml.SubElement(root, "tendon")
    for number, (joint, name) in enumerate(zip(scene.joints, joint_names(scene), strict=True), start=1):
        spring = {
            "stiffness": text_of(joint.stiffness),
            "damping": text_of(joint.damping),
            "springlength": "0",
        }
        tendon = Xml.SubElement(tendons, "fixed", spring, name=name)
        Xml.SubElement(tendon, "joint", joint=names[number - 1 + scene.hub], coef="1")
        if (inner := scene.host(number) - 1 + scene.hub) >= 0:
            Xml.SubElement(tendon, "joint", joint=names[inner], coef=text_of(-1.0 / joint.ratio))
    base = bodies[0] if scene.hub else ground
    return Bodies(ground, base, tuple(bodies[scene.hub :]), bodies[-1], names)
