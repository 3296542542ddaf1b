"""Gears that are rigid in a scene, and give way in the arm that controllers are tried on."""

from __future__ import annotations

from typing import Any

import numpy as np

from tmm_gen.control.arm.motors import motors_of
from tmm_gen.scene import Scene
from tmm_gen.scene.each import by_names

GEAR_DAMPING_TIME = 2e-4
"""Damping of such a gear's spring over its stiffness, s: a hundredth of critical damping at 100 rad/s."""


def rigid_gears(scene: Scene) -> dict[str, float]:
    """Return the gears of the motors that control turns, by their names, which are rigid and other than 1.

    That of a motor which turns a spring is none: so `import` writes gears that give way.
    """
    data = scene.source.data
    joints: Any = data.get("joint", [])
    entries: Any = data.get("motor", [])
    turned = motors_of(scene).names
    springs = {entry.get("on") for entry in joints if entry.get("stiffness")}
    return {
        str(entry["name"]): float(entry["gear"])
        for entry in entries
        if entry["name"] in turned
        and entry["name"] not in springs
        and "stiffness" not in entry
        and entry.get("gear", 1) != 1
    }


def giving_way(scene: Scene, twist: float) -> dict[str, object]:
    """Return the changes of a scene by which its rigid gears give way; none where it has no such gears.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    twist : float
        What a motor's largest torque twists its gear by, rad.
    """
    gears, control = rigid_gears(scene), scene.control
    assert control is not None
    names = motors_of(scene).names
    most = dict(zip(names, np.max(np.abs(by_names(control.bounds.torque, names)), axis=-1), strict=True))
    changes: dict[str, object] = {}
    for name, gear in gears.items():
        changes[f"motor.{name}.stiffness"] = float(abs(gear) * most[name] / twist)
        changes[f"motor.{name}.damping_time"] = GEAR_DAMPING_TIME
    return changes
