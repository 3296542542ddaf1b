"""Every joint has something to turn."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.problem import Finding
from tmm_gen.scene.spatial.articulated import pivots
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.spatial.tables import SpatialMotor


def something_to_turn(document: SpatialDocument) -> Iterator[Finding]:
    """Find joints behind which nothing has inertia about their axes, or only what turns by itself."""
    made = document.expansion
    joints = made.moving(document.initial.angles, document.initial.rates)
    least = pivots(joints, nearest_only=True)
    if not any(pivot.vanishes for pivot in least):
        return
    told = set()
    for pivot, low, joint, name in zip(pivots(joints), least, joints, made.inner, strict=True):
        if not (pivot.vanishes and low.vanishes) or name in told:
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
