"""The scene of the arm that controllers are tried on: more links, another integrator, short steps."""

from __future__ import annotations

import numpy as np

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.condition import Condition
from tmm_gen.control.plant.gears import giving_way
from tmm_gen.control.prediction.prediction import fine_scene
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.scene import Scene

PLANT_LINKS = 20
PLANT_INTEGRATOR = "sdirk4"
SPACE_INTEGRATOR = "sdirk2"
"""In space; a kernel of more stages takes long to derive and to compile."""
PLANT_STEP = 1e-3
"""s; rounded down to a whole fraction of the sample time."""

OUTPUTS: list[dict[str, object]] = [
    {"name": "hub", "at": "base", "of": "angle"},
    {"name": "last", "at": "tip", "of": "angle"},
    {"name": "tip", "at": "tip", "of": "position"},
    {"name": "tip_acceleration", "at": "tip", "of": "acceleration"},
    {"name": "root", "at": "base", "of": "torque"},
]
"""Of an arm on a hub."""


def plant_scene(scene: Scene, condition: Condition) -> Scene:
    """Return the arm of a condition, finer than the scene's and integrated by another method."""
    changes: dict[str, object] = {
        "name": "plant",
        "output": OUTPUTS if scene.base.turns else _outputs(scene),
        "integrator.name": PLANT_INTEGRATOR if scene.spatial is None else SPACE_INTEGRATOR,
        "integrator.step": PLANT_STEP,
        "control": None,
        "emit": {"backends": ["c"]},
    }
    if condition.twist:
        changes.update(giving_way(scene, condition.twist))
    if condition.gravity:
        changes["model.gravity"] = arm_of(scene).falling(condition.gravity)
    return fine_scene(scene.replace(**changes), PLANT_LINKS)


def _outputs(scene: Scene) -> list[dict[str, object]]:
    """Return for each motor of an arm by parts its angle, where and how it stands, and where what it carries ends."""
    if scene.spatial is not None:  # the kernel's state has all angles
        return [{"name": f"hub_{name}", "at": name, "of": "angle"} for name in motors_of(scene).names]
    solid = {part.last: part.name for part in scene.parts if part.kind in ("beam", "link")}
    found: list[dict[str, object]] = []
    for motor in motors_of(scene).each:
        found.append({"name": f"hub_{motor.name}", "at": motor.name, "of": "angle"})
        if motor.host >= 0:
            inner = solid[motor.host + 1]
            found.append({"name": f"root_{motor.name}", "at": inner, "of": "position"})
            found.append({"name": f"turned_{motor.name}", "at": inner, "of": "angle"})
        found.append({"name": f"tip_{motor.name}", "at": solid[motor.end], "of": "position"})
    return found


def steps_of_a_sample(problem: ControlProblem) -> int:
    """Return how many steps the arm takes in a sample."""
    return max(1, int(np.ceil(problem.sample_time / PLANT_STEP - 1e-9)))
