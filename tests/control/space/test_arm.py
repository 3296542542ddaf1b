"""What controllers know of an arm in space, held against the same arm in a plane and against differences."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.prediction.lift import Lift
from tmm_gen.control.task.problem import control_problem
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.scene import Scene, load_scene, parse_scene

ELBOW = Path(__file__).resolve().parents[3] / "scenes" / "elbow.toml"


def twin() -> Scene:
    """Return the committed arm of two motors in a plane, written in space: it turns about z, and is stiff about y."""
    text = ELBOW.read_text()
    for old, new in (
        ('kind = "planar"', 'kind = "spatial"'),
        ("gravity = 9.81 ", "gravity = [0, -9.81, 0] "),
        ("[[motor]]", '[[motor]]\naxis = "z"'),
        ('trigonometry = "own" ', 'trigonometry = "libm" '),
        ("bending_stiffness = 11.2 ", "bending_stiffness = [1e4, 11.2] "),
        ("bending_stiffness = 3.15", "bending_stiffness = [1e4, 3.15]"),
        ("\ninertia = 1e-4 ", "\ninertia = [1e-4, 1e-4, 1e-4] "),
        ("\ninertia = 2e-4", "\ninertia = [2e-4, 2e-4, 2e-4]"),
    ):
        assert old in text, old
        text = text.replace(old, new)
    return parse_scene(text, "elbow.toml")


def test_an_arm_in_a_plane_is_the_same_in_space() -> None:
    flat = load_scene(ELBOW)
    space = twin()
    problems = [control_problem(scene) for scene in (flat, space)]
    rests = [
        rest_with(scene, problem.reference, "control.reference")
        for scene, problem in zip((flat, space), problems, strict=True)
    ]
    assert_allclose(rests[1].goal.torque, rests[0].goal.torque, rtol=1e-9)
    arms = [arm_of(scene) for scene in (flat, space)]
    inertias = [motors_of(scene).inertia(arm.mass()) for scene, arm in zip((flat, space), arms, strict=True)]
    assert_allclose(inertias[1], inertias[0], rtol=1e-9)
    random = np.random.default_rng(1)
    motion = random.uniform(-1.0, 1.0, (3, 4, 2))
    torques = [arm.rigid_torques(*motion) for arm in arms]
    assert_allclose(torques[1], torques[0], rtol=1e-8, atol=1e-12)
    hub = random.uniform(-1.0, 1.0, 2)
    held = [Lift.of(scene).torque(rest.goal, hub) for scene, rest in zip((flat, space), rests, strict=True)]
    assert_allclose(held[1], held[0], rtol=1e-8)


def test_the_tip_of_a_motor_is_how_far_the_payload_is_about_its_axis(bench: Bench) -> None:
    """Rows of angles against differences of where the payload is, seen along each motor's way."""
    arm, motors = bench.scene.spatial, bench.problem.motors
    assert arm is not None
    numbers, frame = ArmNumbers(arm), arm.frames[-1]
    assert frame.name == "payload"
    goal = motors.turned @ bench.problem.reference
    small = 1e-6

    def place(angles: np.ndarray) -> np.ndarray:
        return Still(numbers, angles, {}).place(frame)

    each = [
        (place(goal + small * one) - place(goal - small * one)) / (2 * small) for one in np.eye(len(goal))
    ]
    bending = [k for k in range(len(goal)) if k not in [motor.place for motor in motors.each]]
    for row, motor in zip(motors.tip, motors.each, strict=True):
        assert row[motor.place] == 1.0
        own = each[motor.place]
        assert_allclose(row[bending], [own @ each[k] / (own @ own) for k in bending], atol=1e-8)
    # sideways bending turns the payload about the yaw axis, up and down bending about that of the lift
    assert np.count_nonzero(np.abs(motors.tip[:, bending]) > 0.1) == len(bending)


def test_a_frame_without_mass_is_no_payload(words: str) -> None:
    tool = '[[body]]\nname = "tool"\non = "upper"\nat = [0.1, 0, 0]\n[[input]]\n'
    scene = parse_scene(words.replace("[[input]]\n", tool, 1), "reach.toml")
    assert arm_of(scene).payloads() == {"body.payload.mass": 0.4}


def test_slopes_of_a_step_are_its_derivatives(bench: Bench) -> None:
    step, random = bench.step, np.random.default_rng(2)
    state, torques = random.normal(0.0, 0.3, step.size), random.normal(0.0, 1.0, 2 * step.motors.count)
    after, by_state, by_torques = (np.array(item) for item in step.sample_slopes(state, torques))
    assert_allclose(after, np.array(step.sample(state, torques)), rtol=1e-13, atol=1e-13)
    found, at, small = np.hstack([by_state, by_torques]), np.concatenate([state, torques]), 1e-6
    columns = []
    for one in small * np.eye(len(at)):
        ahead, back = (np.array(step.sample(*np.split(at + way * one, [step.size]))) for way in (1.0, -1.0))
        columns.append((ahead - back).ravel() / (2.0 * small))
    assert_allclose(found, np.array(columns).T, rtol=1e-6, atol=1e-6 * np.max(np.abs(found)))


def test_an_arm_that_branches_rests_with_all_joints_at_the_reference(words: str) -> None:
    """A second arm on the same yaw motor, without a motor about the first one's axis: each tip is on its own branch."""
    branch = """
[[motor]]
name = "other"
on = "yaw"
at = [0, 0.1, 0]
axis = "x"
rotor_inertia = 0.1
[[body]]
name = "weight"
on = "other"
mass = 0.2
center = [0, 0.3, 0]
inertia = [1e-3, 1e-3, 1e-3]
[[input]]
name = "other_torque"
at = "other"
acts = "torque"
[[output]]
name = "payload"
"""
    text = words.replace('\n[[output]]\nname = "payload"\n', branch)
    for table in ("reference", "torque_step", "torque", "disturbance"):
        text = text.replace(f"{table} = {{ yaw", f"{table} = {{ other = 0.7, yaw")
    scene = parse_scene(text.partition("[control.baselines]")[0], "tree.toml")
    problem = control_problem(scene)
    names, motors = problem.motors.names, problem.motors
    rest = rest_with(scene, problem.reference, "control.reference")
    assert_allclose(motors.hub @ rest.angles, problem.reference, atol=1e-12)
    place = names.index("other")
    assert rest.goal.torque[place] == pytest.approx(0.2 * 9.81 * 0.3 * np.cos(0.7), rel=1e-9)
    assert np.count_nonzero(motors.tip[place]) == 1
    assert motors.tip[names.index("lift"), motors.each[place].place] == 0.0
