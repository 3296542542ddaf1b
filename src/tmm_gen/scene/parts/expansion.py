"""From parts that hang together to the joints and links of a row, and what each stands on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from tmm_gen.scene.beam import CLAMPED, Tip, beam_joints, beam_links, by_numbers, finite_segments
from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.model import FloatingBase
from tmm_gen.scene.parts.order import BASE, Entry, Hanging, hanging
from tmm_gen.scene.parts.placed import Expansion, PlacedPart
from tmm_gen.scene.parts.tables import BeamPart, BodyPart, JointPart, LinkPart, MotorPart
from tmm_gen.scene.station import Joint, Link

if TYPE_CHECKING:
    from tmm_gen.scene.parts.document import PartsDocument

_SHAFT = Link.model_construct(inertia=0.0, mass=0.0, length=0.0, center=0.0)
"""What turns between a motor and its elastic gear; the rotor's inertia is in the motor's joint."""


def expanded(document: PartsDocument) -> Expansion:
    """Expand parts that keep all rules."""
    hung = hanging(document.parts_by_table())
    row = hung.outward()
    branched = any(len(hung.carried(name)) > 1 for name in (BASE, *(entry.name for entry in row)))
    joints: list[Joint] = []
    links: list[Link] = []
    hosts: list[int] = []
    floating = hung.bodies(BASE)
    parts = [PlacedPart(entry.name, entry.table) for entry in floating]
    outer = {BASE: 0}
    pending: Joint | None = None
    for entry in row:
        part, host = entry.part, outer[hung.host(entry)]
        if isinstance(part, MotorPart | JointPart):
            number, pending = len(joints) + 1, _joint(part)
            if elastic(part):  # the motor turns a shaft, whose twist against the outer side is the gear's
                joints.append(pending)
                links.append(_SHAFT)
                hosts.append(host)
                host, pending = number, _gear(part)
            outer[entry.name] = host
            parts.append(PlacedPart(entry.name, entry.table, joint=number, gear=len(joints) + 1))
            continue
        first = len(links) + 1
        if isinstance(part, LinkPart):
            link = _link(part)
            if pending is None:  # rigidly on the part before it
                first = len(links)
                links[-1] = joined(links[-1], link)
            else:
                joints.append(pending)
                links.append(link)
                hosts.append(host)
        else:
            assert isinstance(part, BeamPart)
            springs, pieces = _cut(part, turned=pending is not None)
            joints += springs if pending is None else (pending, *springs)
            links += pieces
            hosts += (host, *range(first, len(links)))
        pending, outer[entry.name] = None, len(links)
        bodies = hung.bodies(entry.name)
        if branched or entry is not row[-1]:
            for body in bodies:
                links[-1] = joined(links[-1], _weight(body))
        placed = PlacedPart(entry.name, entry.table, first=first, last=len(links), fixed=_fixed(hung, entry))
        parts += [placed, *(_placed_body(body, placed) for body in bodies)]
    tip = None if branched else _tip(hung.bodies(row[-1].name))
    base = _floating(floating) if document.base.kind == "free" else None
    return Expansion(tuple(joints), tuple(links), tip, tuple(parts), tuple(hosts), base)


def joined(inner: Link, outer: Link) -> Link:
    """Return two rigid links, one fixed straight to the other's outer end, as one.

    What is out of the range of numbers stays so, for the rules to tell.
    """
    numbers = [
        getattr(link, key) for link in (inner, outer) for key in ("mass", "center", "length", "inertia")
    ]
    if not all(map(math.isfinite, numbers)):
        return Link.model_construct(inertia=math.inf, mass=math.inf, length=math.inf, center=0.5)
    m, more = exact(inner.mass), exact(outer.mass)
    here, length = exact(inner.center) * exact(inner.length), exact(inner.length)
    there = length + exact(outer.center) * exact(outer.length)
    whole, end = m + more, length + exact(outer.length)
    if not whole:  # rounded away
        m = more = whole = exact(1.0)
    inertia = exact(inner.inertia) + exact(outer.inertia) + m * more / whole * (there - here) ** 2
    return Link.model_construct(
        inertia=nearest(inertia),
        mass=nearest(whole),
        length=nearest(end),
        # lengths of next to nothing may be rounded to it
        center=nearest((m * here + more * there) / whole / end) if end else 0.5,
    )


def _joint(part: MotorPart | JointPart) -> Joint:
    if isinstance(part, JointPart):
        return Joint.model_construct(stiffness=part.stiffness, damping=part.damping, rest=part.rest)
    at_joint = exact(part.damping) + exact(part.gear) ** 2 * exact(part.motor_damping)
    return Joint.model_construct(
        stiffness=0.0, damping=nearest(at_joint), rotor_inertia=part.rotor_inertia, gear=part.gear
    )


def elastic(part: object) -> bool:
    """Return whether a part is a motor with an elastic gear."""
    return isinstance(part, MotorPart) and part.stiffness is not None


def _gear(part: MotorPart | JointPart) -> Joint:
    """Return the joint between the shaft of a motor and the outer side of its elastic gear."""
    assert isinstance(part, MotorPart)
    assert part.stiffness is not None
    damping = nearest(exact(part.stiffness) * exact(part.damping_time))
    return Joint.model_construct(stiffness=part.stiffness, damping=damping)


def _link(part: LinkPart) -> Link:
    return Link.model_construct(inertia=part.inertia, mass=part.mass, length=part.length, center=part.center)


def _weight(entry: Entry) -> Link:
    """Return a body as a link without length."""
    assert isinstance(entry.part, BodyPart)
    return Link.model_construct(inertia=entry.part.inertia, mass=entry.part.mass, length=0.0, center=0.0)


def _cut(part: BeamPart, *, turned: bool) -> tuple[tuple[Joint, ...], tuple[Link, ...]]:
    """Return springs and pieces of a beam; one on a motor or a joint that turns it has a piece more than springs."""
    rule = part.springs
    if rule is None or rule == "finite-segment":  # whose root turns: it has no rule of a held one
        rule = CLAMPED
    beam = by_numbers(part, part.links, rule, part.damping_time)
    return finite_segments(beam) if turned else (beam_joints(beam), beam_links(beam))


def _fixed(hung: Hanging, entry: Entry) -> str:
    return next((e.name for e in hung.carried(entry.name) if e.table == "link"), "")


def _placed_body(entry: Entry, on: PlacedPart) -> PlacedPart:
    return PlacedPart(entry.name, entry.table, first=on.last, last=on.last, fixed=on.fixed)


def _tip(bodies: Sequence[Entry]) -> Tip | None:
    mass, inertia = _summed(bodies)
    return Tip.model_construct(mass=mass, inertia=inertia) if bodies else None


def _floating(bodies: Sequence[Entry]) -> FloatingBase:
    mass, inertia = _summed(bodies)
    return FloatingBase.model_construct(kind="free", damping=0.0, mass=mass, inertia=inertia)


def _summed(bodies: Sequence[Entry]) -> tuple[float, float]:
    """Return mass and inertia of bodies at one place."""
    weights = [_weight(body) for body in bodies]
    mass, inertia = (
        nearest(sum((exact(getattr(w, key)) for w in weights), Fraction(0))) for key in ("mass", "inertia")
    )
    return mass, inertia
