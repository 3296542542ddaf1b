"""The first modes of the fine arm as a prediction model: few states, right frequencies, no spillover of links."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.goals.target import find_start, find_target
from tmm_gen.control.prediction.lift import Lift
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.prediction import fine_scene
from tmm_gen.control.sensors.sensing import Sensing, sites_of
from tmm_gen.control.task.delay import delay_of
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


def modes_model(scene: Scene, problem: ControlProblem) -> LinearModel:
    """Return the first modes of the fine arm about its target, exact over a sample.

    Modes are those of undamped small motion about the target, the slowest first: where nothing but motors holds the
    arm, the first ones turn it about them. The state is modal coordinates and their rates.

    Parameters
    ----------
    scene : Scene
        With a beam, which is cut finely; a scene of given links is taken as it is.
    problem : ControlProblem
        Gives sample time and number of modes.

    Raises
    ------
    UserError
        If the motors cannot hold the target, or the start.
    """
    from scipy.linalg import eigh, expm  # slow to import

    fine = fine_scene(scene)
    motors = motors_of(fine)
    target, initial = find_target(fine, problem), find_start(fine, problem)
    mass, damping, stiffness = target.matrices.mass, target.matrices.damping, target.matrices.stiffness
    _, shapes = eigh(stiffness, mass)
    count = min(problem.modes, len(mass))
    shapes = shapes[:, :count]
    size = 2 * count
    system = np.zeros((size + motors.count, size + motors.count))
    system[:count, count:size] = np.eye(count)
    system[count:size, :count] = -shapes.T @ stiffness @ shapes
    system[count:size, count:size] = -shapes.T @ damping @ shapes
    system[count:size, size:] = shapes.T @ motors.drive
    delay = delay_of(problem, 0.0)
    late = delay.part * problem.sample_time
    sampled = np.asarray(expm(system * problem.sample_time), float)
    then = np.asarray(expm(system * (problem.sample_time - late)), float)[:size, size:]

    tip, hub = motors.tip @ shapes, motors.hub @ shapes
    still: Array = np.zeros((motors.count, count))
    measure, feed = np.zeros((3 * motors.count, size)), np.zeros((3 * motors.count, motors.count))
    seen, behind = np.zeros(3 * motors.count), slice(motors.count, None)
    measure[: motors.count, :count], seen[: motors.count] = hub, target.goal.hub
    swept, whirl = np.zeros((motors.count,) * 3), np.zeros(size)
    length = float(motors.lengths.sum())
    if motors.on_hub:
        measure[behind], feed[behind], seen[behind] = _sensors(
            fine, target.angles, shapes, system[count:size]
        )
        whirl[:count] = length * (shapes[-1] - tip[0])
    else:
        sensing = Sensing.of(fine, motors, problem, sites_of(scene, motors_of(scene), problem))
        measure[behind], feed[behind], seen[behind] = _sensors_by_parts(
            sensing, target.angles, shapes, system[count:size]
        )
        swept = sensing.swept(target.angles, motors.turned)
    coordinates = shapes.T @ mass
    turned = (coordinates @ motors.turned).T
    start = coordinates @ (initial.angles - target.angles)
    return LinearModel(
        transition=sampled[:size, :size],
        before=sampled[:size, size:] - then,
        then=then,
        tip=np.hstack([tip, still]),
        tip_rate=np.hstack([still, tip]),
        hub=np.hstack([hub, still]),
        hub_rate=np.hstack([still, hub]),
        measure=measure,
        feed=feed,
        target_sensors=seen,
        goal=target.goal,
        swept=swept,
        whirl=whirl,
        turn=np.hstack([still, turned]).T,
        turned=np.hstack([turned, still]).T,
        start_hub=hub @ start + target.goal.hub,
        length=length,
        start=np.concatenate([start, coordinates @ initial.rates]),
        start_torque=initial.torque,
        lift=Lift.of(fine),
        delay=delay,
    )


def _sensors(scene: Scene, angles: Array, shapes: Array, accelerations: Array) -> tuple[Array, Array, Array]:
    """Return C, (2, 2 r), D, (2, 1), and what accelerometer and strain gauge of an arm on a hub show at the target.

    From the rows of the modal accelerations.
    """
    count = shapes.shape[1]
    gravity = scene.model.gravity or 0.0
    lengths = np.array([0.0, *(link.length for link in scene.links)])
    across = (lengths * np.cos(angles - angles[-1])) @ shapes
    joint = scene.joints[0]
    bend = shapes[1] - shapes[0]
    measure, feed = np.zeros((2, 2 * count)), np.zeros((2, 1))
    measure[0] = across @ accelerations[:, :-1]
    measure[0, :count] -= gravity * np.sin(angles[-1]) * shapes[-1]
    measure[1] = np.concatenate([joint.stiffness * bend, joint.damping * bend])
    feed[0] = across @ accelerations[:, -1:]
    seen = np.array([gravity * np.cos(angles[-1]), joint.stiffness * (angles[1] - angles[0])], dtype=float)
    return measure, feed, seen


def _sensors_by_parts(
    sensing: Sensing, angles: Array, shapes: Array, accelerations: Array
) -> tuple[Array, Array, Array]:
    """Return C, (2 m, 2 r), D, (2 m, m), and what accelerometers and gauges of an arm by parts show at the target."""
    count, still = shapes.shape[1], np.zeros(len(angles))
    seen, by_angle, by_rate, by_growth = (np.array(each) for each in sensing.function(angles, still, still))
    felt = by_growth @ shapes @ accelerations
    measure = np.hstack([by_angle @ shapes, by_rate @ shapes]) + felt[:, : 2 * count]
    return measure, felt[:, 2 * count :], seen.ravel()
