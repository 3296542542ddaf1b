"""The arm that an emitted controller's loop in real time moves: finer than the controller's model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.space_motors import space_motors
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import Condition
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.plant.plant_scene import plant_scene
from tmm_gen.control.sensors.sensing import Sensing, sites_of
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

AS_TOLD = Condition("nominal", "as the scene says")


@dataclass(frozen=True, eq=False)
class LoopArm:
    """An arm of m motors and d angles that is controlled.

    Parameters
    ----------
    scene : Scene
        Of the arm, finer than that of the controller; its name is of no account.
    problem : ControlProblem
        Sample time, sensors, delay.
    motors : Motors
        Of this arm.
    sensing : Sensing
        What is behind the encoders; none of an arm on a hub, whose kernel says it.
    start : array, (d,), optional
        Angles where it rests, held by its motors, rad; None of an arm on a hub, which starts as its scene says.
    start_torque : array, (m,)
        That act at first, N m.
    goal : array, (m,)
        Angles of tips where it rests at the reference, rad.
    """

    scene: Scene
    problem: ControlProblem
    motors: Motors
    sensing: Sensing
    start: Array | None
    start_torque: Array
    goal: Array


def loop_arm(bench: Bench) -> LoopArm:
    """Return the arm that `tmm-gen mpc` tries the controllers of a scene on, as the scene says it is."""
    problem = bench.problem
    scene = plant_scene(bench.scene, AS_TOLD)
    motors = motors_of(scene) if scene.spatial is None else space_motors(scene, problem.reference)
    goal = motors.tip @ rest_with(scene, problem.reference, "control.reference").angles
    if motors.on_hub:
        none = (None,) * motors.count
        sensing = Sensing(len(motors.lengths), none, none)
        return LoopArm(scene, problem, motors, sensing, None, np.zeros(motors.count), goal)
    sites = sites_of(bench.scene, motors_of(bench.scene), problem)
    start = rest_with(scene, problem.start, "initial.angles")
    return LoopArm(
        scene=scene,
        problem=problem,
        motors=motors,
        sensing=Sensing.of(scene, motors, problem, sites),
        start=start.angles,
        start_torque=start.goal.torque,
        goal=goal,
    )
