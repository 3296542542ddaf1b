"""Every joint has something to turn, and so has a base that floats."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.problem import Finding
from tmm_gen.scene.spatial.arm import RigidBody
from tmm_gen.scene.spatial.articulated import pivots
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.tables import SpatialMotor

_NONE = 1e-12
"""Of a base's largest moment of inertia: one that rounding leaves of none."""


def something_to_turn(document: SpatialDocument) -> Iterator[Finding]:
    """Find joints behind which nothing has inertia about their axes, or only what turns by itself."""
    made = document.expansion
    joints = made.moving(document.initial.angles, document.initial.rates)
    least = pivots(joints, nearest_only=True)
    if not any(pivot.vanishes for pivot in least):
        return
    told = set()
    for pivot, low, joint, name in zip(pivots(joints), least, joints, made.inner, strict=True):
        if joint.given or not (pivot.vanishes and low.vanishes) or name in told:
            continue
        told.add(name)
        hung = document.tree.by_name[name]
        light = f"{pivot.locked / 1000:.2g}" if pivot.locked > 0.0 else "1e-4"
        why = (
            "and all that does turns by itself, on joints about the same axis"
            if pivot.locked > 0.0
            else "so that any torque would turn it without end"
        )
        body = f'Add [[body]] with `on = "{name}"`, `inertia = [{light}, {light}, {light}]`'
        motor = isinstance(hung.part, SpatialMotor)
        yield Finding(
            hung.path,
            f"carries nothing that has inertia about the axis of '{joint.name}', {why}",
            f"{body}, or write `rotor_inertia = {light}` for the motor." if motor else f"{body}.",
        )


def base_to_turn(document: SpatialDocument) -> Iterator[Finding]:
    """Find a base that floats without mass, or without inertia about some axis."""
    if not document.base.floats:
        return
    body = document.expansion.base
    if body.mass > 0.0 and _turns_about_all(body):
        return
    lacks = "mass" if not body.mass > 0.0 else "the inertia to turn about every axis"
    of_bodies = [(k, part) for k, part in enumerate(document.body) if part.name in _fixed_to_base(document)]
    if of_bodies:
        index, part = of_bodies[0]
        size = max(max(part.inertia[:3]), 0.01)
        key, remedy = ("mass", "Write `mass = 1.0`.")
        if body.mass > 0.0:
            key, remedy = "inertia", f"Write `inertia = [{size:g}, {size:g}, {size:g}]`."
        yield Finding(
            ("body", index, key),
            f"leaves the base that floats without {lacks}, and nothing else fixed to it has that",
            remedy,
            getattr(part, key),
        )
        return
    yield Finding(
        ("base", "kind"),
        f"lets the base float, and nothing fixed to it has {lacks}",
        'Add [[body]] with `name = "hub"`, `on = "base"`, `mass = 1.0`, `inertia = [0.01, 0.01, 0.01]`.',
        document.base.kind,
    )


def _turns_about_all(body: RigidBody) -> bool:
    """Whether a body has inertia about every axis: the pivots of its matrix are positive."""
    xx, yy, zz, xy, xz, yz = body.inertia
    least = _NONE * max(xx, yy, zz)
    if not xx > least:
        return False
    second, mixed, third = yy - xy * xy / xx, yz - xy * xz / xx, zz - xz * xz / xx
    return second > least and third - mixed * mixed / second > least


def _fixed_to_base(document: SpatialDocument) -> set[str]:
    return {hung.name for hung in document.tree.every if document.tree.mover(hung) is None}
