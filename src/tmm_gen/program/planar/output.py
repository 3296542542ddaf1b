"""Outputs of a planar arm, read off angles, rates and accelerations by walking out from the base."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive.elements import planar as element
from tmm_gen.derive.integrators.declaration import Kind, Past
from tmm_gen.program.planar.energy import energy_statements
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import Ref, local
from tmm_gen.scene import Output, Scene, station_of
from tmm_gen.scene.quantity import PLANAR


def output_routine(scene: Scene, layout: PlanarLayout) -> Routine:
    """Build the outputs from the state."""
    remaining = list(layout.outputs)
    sections = []
    for described in scene.outputs:
        link = station_of(described.at, scene.stations)
        statements: list[Statement]
        if described.of in ("angle", "rate"):
            kind: Kind = "q" if described.of == "angle" else "v"
            statements = [Assign(remaining.pop(0).ref, _motion(layout, link, Past(kind, 0)))]
        elif described.of == "torque":
            statements = [Assign(remaining.pop(0).ref, _torque(scene, layout, described, link))]
        elif PLANAR[described.of].of_arm:
            statements = energy_statements(layout, described.of, remaining.pop(0).ref)
        else:
            x, y = remaining.pop(0), remaining.pop(0)
            build = _force if described.of == "force" else _along_links
            statements = build(scene, layout, described, link, (x.ref, y.ref))
        sections.append(Section(f"{described.name}: {described.of.replace('_', ' ')}", tuple(statements)))
    return Routine("output", "Read the outputs off the state.", tuple(sections))


def joint_torque(layout: PlanarLayout, joint: int) -> sp.Expr:
    """Return the torque of a joint's spring and damper, counted from 1, positive when the joint is bent upward."""
    law = chain.joint_sweep().known_torque
    rates = Past("v", 0)
    values = {
        chain.INNER_ANGLE: _angle(layout, joint - 1),
        chain.OUTER_ANGLE: _angle(layout, joint),
        chain.INNER_RATE: _motion(layout, joint - 1, rates),
        chain.OUTER_RATE: _motion(layout, joint, rates),
        element.STIFFNESS: layout.stiffness.entry(joint - 1),
        element.DAMPING: layout.damping.entry(joint - 1) if layout.damping else sp.Integer(0),
    }
    return -law.subs(values)


def _torque(scene: Scene, layout: PlanarLayout, described: Output, link: int) -> sp.Expr:
    """Return a joint's torque; at the tip, that between the last link and the body at the tip, counted alike."""
    if described.at != "tip":
        return joint_torque(layout, max(link, 1))
    values = {
        chain.ACCELERATION: _motion(layout, link, Past("a", 0)),
        element.TIP_INERTIA: layout.tip_inertia.ref if layout.tip_inertia else sp.Integer(0),
    }
    outside = (layout.held[i.name].ref for i in scene.inputs if i.acts == "torque" and i.name in layout.held)
    return sp.Add(*outside) - chain.tip_law().torque.subs(values)


def _angle(layout: PlanarLayout, link: int) -> sp.Expr:
    return _motion(layout, link, Past("q", 0))


def _motion(layout: PlanarLayout, link: int, which: Past) -> sp.Expr:
    if link:
        return layout.state[which].entry(link - 1)
    return layout.hub[which].ref if layout.hub else sp.Integer(0)


def _along_links(
    scene: Scene, layout: PlanarLayout, described: Output, link: int, targets: tuple[Ref, Ref]
) -> list[Statement]:
    """Return position, velocity or acceleration of a link's outer end."""
    del scene
    if described.of == "acceleration":
        return _walk_accelerations(layout, targets, 0, link, sp.Integer(0))
    length, angle = layout.length.at(), layout.state[Past("q", 0)].at()
    x, y = targets
    if described.of == "position":
        steps = (length * sp.cos(angle), length * sp.sin(angle))
    else:
        rate = layout.state[Past("v", 0)].at()
        steps = (-length * rate * sp.sin(angle), length * rate * sp.cos(angle))
    body = (Assign(x, x + steps[0]), Assign(y, y + steps[1]))
    return [Assign(x, sp.Integer(0)), Assign(y, sp.Integer(0)), Loop(Order.OUTWARD, 0, link, body)]


def _swing(layout: PlanarLayout, a: tuple[Ref, Ref]) -> tuple[Assign, Assign]:
    """Carry accelerations from a link's inner to its outer end."""
    law = chain.link_law()
    angle = layout.state[Past("q", 0)].at()
    values = {
        chain.LEVER_SINE: layout.length.at() * sp.sin(angle),
        chain.LEVER_COSINE: layout.length.at() * sp.cos(angle),
        chain.RATE: layout.state[Past("v", 0)].at(),
        chain.ACCELERATION: layout.state[Past("a", 0)].at(),
        chain.A_X: a[0],
        chain.A_Y: a[1],
    }
    return Assign(a[0], law.outer_x.subs(values)), Assign(a[1], law.outer_y.subs(values))


def _walk_accelerations(
    layout: PlanarLayout, a: tuple[Ref, Ref], start: int, stop: int, upward: sp.Expr
) -> list[Statement]:
    first: list[Statement] = [] if start else [Assign(a[0], sp.Integer(0)), Assign(a[1], upward)]
    if stop == start:
        return first
    return [*first, Loop(Order.OUTWARD, start, stop, _swing(layout, a))]


def _force(
    scene: Scene, layout: PlanarLayout, described: Output, link: int, targets: tuple[Ref, Ref]
) -> list[Statement]:
    """Return the force the inner side exerts in a joint: what the links beyond it need, less what acts on them.

    At the tip it is the force between the last link and the body at the tip.
    """
    n = scene.stations
    joint = n + 1 if described.at == "tip" else max(link, 1)
    a = (local("node_x", unit="m/s^2"), local("node_y", unit="m/s^2"))
    falling = layout.gravity.ref if layout.gravity else sp.Integer(0)
    x, y = targets
    statements = _walk_accelerations(layout, a, 0, joint - 1, falling)
    statements += [Assign(x, sp.Integer(0)), Assign(y, sp.Integer(0))]
    if joint <= n:
        law = chain.link_law()
        inner = (local("inner_x", unit="m/s^2"), local("inner_y", unit="m/s^2"))
        values = {
            chain.CARRIED_MASS: law.carried_mass.subs(element.CENTER, layout.center.at()),
            chain.F_X: x,
            chain.F_Y: y,
            chain.A_X: inner[0],
            chain.A_Y: inner[1],
            chain.OUTER_A_X: a[0],
            chain.OUTER_A_Y: a[1],
        }
        of_links = {element.MASS: layout.mass.at()}
        body = (
            Assign(inner[0], a[0]),
            Assign(inner[1], a[1]),
            *_swing(layout, a),
            Assign(x, law.force_x.subs(values).subs(of_links)),
            Assign(y, law.force_y.subs(values).subs(of_links)),
        )
        statements.append(Loop(Order.OUTWARD, joint - 1, n, body))
    tip = chain.tip_law()
    beyond = {
        chain.A_X: a[0],
        chain.A_Y: a[1],
        element.TIP_MASS: layout.tip_mass.ref if layout.tip_mass else 0,
    }
    outside = {"force_x": sp.Integer(0), "force_y": sp.Integer(0)}
    for signal in scene.inputs:
        if (
            signal.acts in outside
            and station_of(signal.at, n) >= min(joint, n)
            and signal.name in layout.held
        ):
            outside[signal.acts] += layout.held[signal.name].ref
    statements += [
        Assign(x, x + tip.force_x.subs(beyond) - outside["force_x"]),
        Assign(y, y + tip.force_y.subs(beyond) - outside["force_y"]),
    ]
    return statements
