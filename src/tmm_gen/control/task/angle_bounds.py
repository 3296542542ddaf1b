"""Intervals that the angles of hubs and tips are to stay in."""

from __future__ import annotations

import math

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.task.terms import Pair
from tmm_gen.scene import Scene
from tmm_gen.scene.control import Control
from tmm_gen.scene.each import by_names


def hub_bounds(scene: Scene, control: Control, motors: Motors) -> tuple[Pair | None, ...]:
    """Return the intervals of the hubs' angles: those of ``[control.bounds]``, within the joints' own limits."""
    told: tuple[Pair | None, ...] = (None,) * motors.count
    if control.bounds.hub is not None:
        told = (*by_names(control.bounds.hub, motors.names),)
    if scene.spatial is None:
        return told
    limits = (scene.spatial.joints[motor.place].limits for motor in motors.each)
    return tuple(map(_within, told, limits))


def _within(one: Pair | None, other: Pair | None) -> Pair | None:
    """Return what two intervals have in common, where there are two."""
    if one is None or other is None:
        return one or other
    return max(one[0], other[0]), min(one[1], other[1])


def tip_bound(control: Control, way: float) -> Pair | None:
    """Return the interval of a tip's angle off its target: bounded beyond it, as seen from the start."""
    if control.bounds.overshoot is None or way == 0.0:
        return None
    edge = control.bounds.overshoot * way
    return (-math.inf, edge) if way > 0.0 else (edge, math.inf)
