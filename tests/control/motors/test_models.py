"""Several motors: where the arm rests, and its linear models, held against Lagrange's equations of the reference."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm, solve_discrete_are

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.goals.target import find_target
from tmm_gen.control.laws.inverse_dynamics import SPARED, quintic_way
from tmm_gen.control.laws.lqr import Regulator
from tmm_gen.control.prediction.lift import Lift
from tmm_gen.control.prediction.modes import modes_model
from tmm_gen.control.task.terms import Goal
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import parse_scene
from tmm_gen.scene.control import RegulatorWeights

PAIR = """\
name = "pair"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }
motor = [
    { name = "first", rotor_inertia = 1e-5, gear = 50 },
    { name = "second", on = "upper", rotor_inertia = 1e-5, gear = 20 },
]
link = [
    { name = "upper", on = "first", length = 0.5, mass = 1.0, inertia = 0.02 },
    { name = "fore", on = "second", length = 0.4, mass = 0.5, inertia = 0.01 },
]
input = [{ name = "u1", at = "first", acts = "torque" }, { name = "u2", at = "second", acts = "torque" }]
output = [{ name = "angle", at = "second", of = "angle" }]
"""
"""Two rigid links."""


def accelerations(bench: Bench, torques: np.ndarray, angles: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """Return the accelerations of the links under constant torques."""
    signals = {
        name: Constant(float(each)) for name, each in zip(bench.problem.motors.inputs, torques, strict=True)
    }
    return Arm(bench.scene, signals).accelerations(np.zeros(1), angles[None], rates[None])[0]


def test_nothing_moves_at_the_target_nor_at_the_start(two: Bench) -> None:
    """Joints stand at the reference, beams sag, and motors hold the payload up."""
    target, start = find_target(two.scene, two.problem), two.step.start
    for angles, torque in ((target.angles, target.goal.torque), (start.angles, start.torque)):
        assert_allclose(accelerations(two, torque, angles, np.zeros(4)), 0.0, atol=1e-7)
        assert np.all(np.abs(torque) > 0.01)
    assert_allclose(two.problem.motors.hub @ target.angles, two.problem.reference, atol=1e-12)
    sag = target.goal.tip - target.goal.hub
    assert np.all(sag < -0.01)


def test_motors_that_cannot_hold_the_arm_are_named(two: Bench) -> None:
    low, high = two.problem.torque
    weak = dataclasses.replace(two.problem, torque=(0.1 * low, 0.1 * high))
    with pytest.raises(UserError, match=r"needs 0.0\d+ N m of motor 'shoulder', beyond the bounds"):
        find_target(two.scene, weak)


def test_gains_are_those_of_the_reference_model(two: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """By central differences of Lagrange's equations, with the cost written out anew."""
    target, motors = find_target(two.scene, two.problem), two.problem.motors
    size, count, small = 4, 2, 1e-6

    def slope(z: np.ndarray) -> np.ndarray:
        angles, rates, torques = (
            target.angles + z[:size],
            z[size : 2 * size],
            target.goal.torque + z[2 * size :],
        )
        return np.concatenate([rates, accelerations(two, torques, angles, rates)])

    system = np.zeros((2 * size + count, 2 * size + count))
    for column, change in enumerate(small * np.eye(2 * size + count)):
        system[: 2 * size, column] = (slope(change) - slope(-change)) / (2.0 * small)
    sampled = expm(system * two.problem.sample_time)
    a, b = sampled[: 2 * size, : 2 * size], sampled[: 2 * size, 2 * size :]
    weights = RegulatorWeights(
        hub={"shoulder": 3.0, "elbow": 7.0}, tip_rate=0.2, torque={"shoulder": 2.0, "elbow": 9.0}
    )
    still = np.zeros((count, size))
    tips, hubs = np.hstack([motors.tip, still]), np.hstack([motors.hub, still])
    cost = tips.T @ tips + hubs.T @ np.diag([3.0, 7.0]) @ hubs
    rates = np.hstack([still, motors.tip])
    cost += 0.2 * rates.T @ rates
    price = np.diag([2.0, 9.0])
    value = solve_discrete_are(a, b, cost, price)
    expected = np.linalg.solve(price + b.T @ value @ b, b.T @ value @ a)

    monkeypatch.setattr(
        "tmm_gen.control.prediction.modes.fine_scene", lambda scene: scene
    )  # the same few links
    model = modes_model(two.scene, two.problem)
    found = Regulator(model, two.problem, weights, two.inertia)
    assert_allclose(found.gain @ model.turned, expected[:, :size] @ motors.turned, rtol=1e-5)
    assert_allclose(found.gain @ model.turn, expected[:, size:] @ motors.turned, rtol=1e-5)
    closed = [np.linalg.eigvals(m) for m in (a - b @ expected, model.transition - model.drive @ found.gain)]
    assert_allclose(np.sort(np.abs(closed[0])), np.sort(np.abs(closed[1])), rtol=1e-5, atol=1e-9)


def test_rigid_torques_are_those_of_the_textbooks_two_links() -> None:
    """Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, with rotors that add their inertia times gear^2."""
    random = np.random.default_rng(4)
    q, v, a = (random.uniform(-1.5, 1.5, (5, 2)) for _ in range(3))
    m1, m2, l1, c1, c2, i1, i2, gravity = 1.0, 0.5, 0.5, 0.25, 0.2, 0.02, 0.01, 9.81
    cos, sin = np.cos(q[:, 1]), np.sin(q[:, 1])
    d11 = m1 * c1**2 + m2 * (l1**2 + c2**2 + 2.0 * l1 * c2 * cos) + i1 + i2 + 1e-5 * 50.0**2
    d12, d22 = m2 * (c2**2 + l1 * c2 * cos) + i2, m2 * c2**2 + i2 + 1e-5 * 20.0**2
    h = -m2 * l1 * c2 * sin
    g2 = m2 * c2 * gravity * np.cos(q.sum(axis=1))
    g1 = (m1 * c1 + m2 * l1) * gravity * np.cos(q[:, 0]) + g2
    first = d11 * a[:, 0] + d12 * a[:, 1] + h * v[:, 1] * (2.0 * v[:, 0] + v[:, 1]) + g1
    second = d12 * a[:, 0] + d22 * a[:, 1] - h * v[:, 0] ** 2 + g2
    assert_allclose(
        arm_of(parse_scene(PAIR)).rigid_torques(q, v, a),
        np.column_stack([first / 50.0, second / 20.0]),
        rtol=1e-9,
    )


def test_what_holds_the_arm_up_is_what_a_rigid_one_needs() -> None:
    """Against Lagrange's equations at rest, wherever its joints are; and at the goal the torques there."""
    scene, random = parse_scene(PAIR), np.random.default_rng(8)
    hub = random.uniform(-3.0, 3.0, (4, 2))
    still, goal = np.zeros_like(hub), Goal(tip=hub[0], hub=hub[0], torque=np.array([0.2, 0.1]))
    rigid = arm_of(scene).rigid_torques(hub, still, still)
    for k in range(4):
        assert_allclose(Lift.of(scene).torque(goal, hub[k]), goal.torque + rigid[k] - rigid[0], atol=1e-12)


def test_a_quintic_lasts_as_long_as_the_bounds_make_it(two: Bench) -> None:
    """The torques it ends with hold the arm; a sample less and one of them would be too large."""
    model, (low, high) = two.modes, two.problem.torque
    way = quintic_way(two.assumed, two.problem, model.start_hub, model.goal)
    assert_allclose(way.share[[0, -1]], [[0.0, 0.0], [1.0, 1.0]], atol=1e-12)
    assert_allclose(np.sum(way.speed, axis=0) * two.problem.sample_time, 1.0, rtol=1e-2)
    assert_allclose(way.torque[-1], model.goal.torque)
    spared = SPARED * (high - low) / 2.0
    nearest = np.min(np.minimum(way.torque - low, high - way.torque) / spared)
    assert 1.0 <= nearest < 1.5
