"""The first modes of the fine arm as a prediction model: few states, right frequencies, no spillover of links."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.delay import delay_of
from tmm_gen.control.linear import LinearModel
from tmm_gen.control.prediction import fine_scene
from tmm_gen.control.problem import ControlProblem
from tmm_gen.control.target import find_target
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


def modes_model(scene: Scene, problem: ControlProblem) -> LinearModel:
    """Return the first modes of the fine arm about its target, exact over a sample.

    Modes are those of undamped small motion about the target, the turning of the arm as a whole the first of them.
    The state is modal coordinates and their rates.

    Parameters
    ----------
    scene : Scene
        With a beam, which is cut finely; a scene of given links is taken as it is.
    problem : ControlProblem
        Gives sample time and number of modes.

    Raises
    ------
    UserError
        If the motor cannot hold the target.
    """
    from scipy.linalg import eigh, expm  # slow to import

    fine = fine_scene(scene)
    target = find_target(fine, problem)
    mass, damping, stiffness = target.matrices.mass, target.matrices.damping, target.matrices.stiffness
    _, shapes = eigh(stiffness, mass)
    count = min(problem.modes, len(mass))
    shapes = shapes[:, :count]
    system = np.zeros((2 * count + 1, 2 * count + 1))
    system[:count, count:-1] = np.eye(count)
    system[count:-1, :count] = -shapes.T @ stiffness @ shapes
    system[count:-1, count:-1] = -shapes.T @ damping @ shapes
    system[count:-1, -1] = shapes[0]
    delay = delay_of(problem, 0.0)
    late = delay.part * problem.sample_time
    sampled = np.asarray(expm(system * problem.sample_time), float)
    then = np.asarray(expm(system * (problem.sample_time - late)), float)[:-1, -1]

    lengths = np.array([0.0, *(link.length for link in fine.links)])
    tip = lengths / lengths.sum() @ shapes
    still: Array = np.zeros(count)
    measure, feed, seen = _sensors(fine, target.angles, shapes, system[count:-1])
    coordinates = shapes.T @ mass
    start = np.array([0.0, *fine.initial.angles]) - target.angles
    rates = np.array([0.0, *fine.initial.rates])
    return LinearModel(
        transition=sampled[:-1, :-1],
        before=sampled[:-1, -1] - then,
        then=then,
        tip=np.concatenate([tip, still]),
        tip_rate=np.concatenate([still, tip]),
        hub=np.concatenate([shapes[0], still]),
        hub_rate=np.concatenate([still, shapes[0]]),
        measure=measure,
        feed=feed,
        target_sensors=seen,
        target_hub=float(target.angles[0]),
        target_torque=target.torque,
        whirl=np.concatenate([lengths.sum() * (shapes[-1] - tip), still]),
        turn=np.concatenate([still, coordinates @ np.ones(len(mass))]),
        turned=np.concatenate([coordinates @ np.ones(len(mass)), still]),
        start_hub=float(shapes[0] @ (coordinates @ start)) + float(target.angles[0]),
        length=float(lengths.sum()),
        start=np.concatenate([coordinates @ start, coordinates @ rates]),
        delay=delay,
    )


def _sensors(scene: Scene, angles: Array, shapes: Array, accelerations: Array) -> tuple[Array, Array, Array]:
    """Return C, (3, 2 r), D, (3,), and what the sensors show at the target, from modal accelerations' rows."""
    count = shapes.shape[1]
    gravity = scene.model.gravity or 0.0
    lengths = np.array([0.0, *(link.length for link in scene.links)])
    across = (lengths * np.cos(angles - angles[-1])) @ shapes
    joint = scene.joints[0]
    bend = shapes[1] - shapes[0]
    measure, feed = np.zeros((3, 2 * count)), np.zeros(3)
    measure[0, :count] = shapes[0]
    measure[1] = across @ accelerations[:, :-1]
    measure[1, :count] -= gravity * np.sin(angles[-1]) * shapes[-1]
    measure[2] = np.concatenate([joint.stiffness * bend, joint.damping * bend])
    feed[1] = float(across @ accelerations[:, -1])
    seen = np.array(
        [angles[0], gravity * np.cos(angles[-1]), joint.stiffness * (angles[1] - angles[0])], dtype=float
    )
    return measure, feed, seen
