"""Several motors: the quadratic program, the nonlinear problem and the filter, held against solvers of others."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.estimators.credible import JUMP, PATIENCE
from tmm_gen.control.estimators.extended_kalman import ExtendedKalmanFilter, NonlinearFilter
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.laws.full_nmpc import FullNmpc
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.rti import FAR, TURNED, RealTimeIteration
from tmm_gen.scene import Scene

NONE = np.zeros(2)


def test_torques_of_the_quadratic_program_are_those_of_a_generic_solver(two: Bench) -> None:
    """CasADi's qrqp on the condensed program, far from the target, where bounds of both motors bind."""
    mpc = LinearMpc(two.links, two.problem, two.inertia)
    state, last = two.links.start, two.links.start_torque
    solution = mpc.planned(state, NONE, last)
    assert solution.status is Status.OK
    made, condensed = mpc.response, mpc.condensed
    found = made.by_state @ state - made.by_constant @ two.links.goal.torque + made.by_last @ last
    along, nothing = made.outputs(found + mpc.offsets(two.links.goal)), np.zeros((2, two.problem.horizon))
    low, high = condensed.bounds(along, nothing, last)
    options = {"print_iter": False, "print_header": False, "constr_viol_tol": 1e-11, "dual_inf_tol": 1e-11}
    structure = {"h": ca.DM(condensed.hessian).sparsity(), "a": ca.DM(condensed.rows).sparsity()}
    count = condensed.inputs
    free = np.full(condensed.size - count, np.inf)
    expected = ca.conic("generic", "qrqp", structure, options)(
        h=condensed.hessian,
        g=condensed.gradient(along, nothing, last, NONE),
        a=condensed.rows,
        lbx=np.concatenate([low[:count], -free]),
        ubx=np.concatenate([high[:count], free]),
        lba=low[count:],
        uba=high[count:],
    )
    torques = np.array(expected["x"]).ravel()[:count]
    assert_allclose(solution.point[:count], torques, atol=1e-6)
    at_bound = np.abs(torques.reshape(2, -1)) > 0.999 * np.abs(two.problem.torque[1][:, None])
    assert np.all(at_bound.any(axis=1))


def closed_loop_cost(bench: Bench, controller: RealTimeIteration | FullNmpc, samples: int) -> float:
    """Return the sum of the stage costs of a loop on the model itself, whose state is known."""
    step, goal, weights = bench.step, bench.links.goal, bench.problem.weights
    rows = {
        f"{name}{more}": step.rows(of, quantity)
        for name, of in (("tip", step.motors.tip), ("hub", step.motors.hub))
        for more, quantity in (("", "angle"), ("_rate", "rate"))
    }
    targets = {"tip": goal.tip, "hub": goal.hub}
    state, last, cost = step.initial(), bench.links.start_torque, 0.0
    for _ in range(samples):
        command = controller.decide(state, NONE, last)
        assert command.status is Status.OK
        state = np.array(step.sample(state, np.concatenate([last, command.torque]))).ravel()
        for name, of in rows.items():
            cost += 0.5 * float(getattr(weights, name) @ (of @ state - targets.get(name, NONE)) ** 2)
        cost += 0.5 * float(weights.torque @ (command.torque - goal.torque) ** 2)
        cost += 0.5 * float(weights.torque_step @ (command.torque - last) ** 2)
        last = command.torque
    return cost


def test_an_iteration_a_sample_costs_what_the_solution_does(two: Bench) -> None:
    """IPOPT to convergence at every sample, on the same model and from the same states."""
    parts = (two.step, two.links, two.inertia)
    costs = [
        closed_loop_cost(two, controller, 15)
        for controller in (
            FullNmpc(*parts, "ipopt"),
            RealTimeIteration(*parts),
            RealTimeIteration(*parts, True),
        )
    ]
    assert costs[1] == pytest.approx(costs[0], rel=2e-3)
    assert costs[2] == pytest.approx(costs[0], rel=1e-2)


@pytest.mark.parametrize("kind", [NonlinearFilter, ExtendedKalmanFilter])
def test_torques_nobody_commanded_are_found_motor_by_motor(two: Bench, kind: type[NonlinearFilter]) -> None:
    """A tenth of what they can give, of opposite signs, against the model itself: to 3 % within 5 s."""
    filtered, step = kind(two.step, two.links), two.step
    unknown = np.array([0.015, -0.006])
    state, acting = step.initial(), two.links.start_torque
    for _ in range(250):
        seen = np.append(step.motors.hub @ state[step.places("angle")], 4 * [np.nan])
        filtered.correct(filtered.surprise(seen), (0, 1), np.ones(2))
        # held where it began, or it would fall
        acting = two.links.start_torque - unknown - 0.05 * (seen[:2] - two.links.start_hub)
        filtered.advance((acting, acting), acting)
        state = np.array(step.sample(state, np.tile(acting + unknown, 2))).ravel()
    _, disturbance = filtered.ahead([])
    assert_allclose(disturbance, unknown, rtol=0.03)


def test_sensitivities_of_zero_order_are_those_of_what_is_carried_and_where(two: Bench) -> None:
    """Those of an arm whose scene has that payload and that reference; after a reset, those of its own."""
    elsewhere = {"shoulder": 0.3, "elbow": -0.5}
    light = two.scene.replace(**{"body.payload.mass": 0.05})
    told = RealTimeIteration(two.step, two.links, two.inertia, zero_order=True)
    own = told.prepared.slopes
    assert told.carry(np.nan) is Status.NOT_FINITE
    assert told.prepared.slopes is own
    assert told.carry(0.05) is Status.OK
    _same_answers(told, light)
    assert told.aim(np.array([*elsewhere.values()])) is Status.OK
    seen = np.array([*two.links.start_hub, *4 * [np.nan]])
    for _ in range(3):  # the reference has to stay for a sample
        told.command(seen)
    _same_answers(told, light.replace(**{"control.reference": elsewhere}))
    told.reset()
    assert told.prepared.slopes is own


def test_sensitivities_of_zero_order_are_those_of_where_a_far_arm_is(two: Bench) -> None:
    """But for how it sags there, until it is near again; half of what it may turn meanwhile does not count."""
    told, there = (RealTimeIteration(two.step, two.links, two.inertia, zero_order=True) for _ in "ab")
    own, goal, nothing = told.prepared.slopes.hub, told.goal.hub, 4 * [np.nan]
    for elbow, near in ((0.9 * FAR, True), (2.0 * FAR, False)):
        told.reset()
        place = goal + np.array([0.0, elbow])
        told.command(np.append(place, nothing))
        told.prepare()
        assert (told.prepared.slopes.hub is own) is near
    assert there.aim(place) is Status.OK
    for _ in range(3):  # it is near there, and the reference has to stay for a sample
        there.command(np.append(place, nothing))
    right = there.prepared.slopes.hub
    far = told.prepared.slopes.hub
    assert np.abs(far - right).max() < 0.3 * np.abs(own - right).max()
    for turned, kept in ((0.5 * TURNED, True), (FAR, False)):
        told.estimator.turn(np.array([0.0, -turned]))
        told._shift()
        assert (told.prepared.slopes.hub is far) is kept
    assert_allclose(told.prepared.slopes.hub, own, atol=1e-9 * np.abs(own).max())


def _same_answers(found: RealTimeIteration, scene: Scene) -> None:
    """Check that sensitivities are those of a scene, and others than were found first."""
    other = Bench.of(scene)
    wanted = RealTimeIteration(other.step, other.links, other.inertia, zero_order=True).prepared.slopes
    first = found._unladen.condensed.slopes
    for name in ("tip", "tip_rate", "hub", "hub_rate"):
        here, there, before = (getattr(each, name) for each in (found.prepared.slopes, wanted, first))
        assert_allclose(here, there, atol=1e-5 * np.abs(there).max())
        assert np.abs(here - before).max() > 0.3 * np.abs(before).max()


def test_an_encoder_that_is_off_makes_the_estimate_wait(two: Bench) -> None:
    """What one of them shows is believed only with the other: the arm is where both say."""
    mpc = LinearMpc(two.links, two.problem, two.inertia)
    good = np.append(two.links.start_hub, 4 * [np.nan])
    assert mpc.command(good).status is Status.OK
    mpc.prepare()
    before = mpc.estimator.ahead([])[0].copy()
    assert mpc.command(good + np.array([0.001, 0.5, *4 * [0.0]])).status is Status.REDUCED
    assert_allclose(mpc.estimator.ahead([])[0], before, atol=0.0)


def test_an_estimate_that_started_anew_takes_in_what_hubs_can_do_until_it_has_proved_itself(
    two: Bench,
) -> None:
    """Off by half a radian is a hub that whirls as long as nobody knows better, and a wrong encoder then."""
    mpc = LinearMpc(two.links, two.problem, two.inertia)
    none, aside = 4 * [np.nan], np.array([0.0, 0.5, *4 * [0.0]])
    good = np.append(two.links.start_hub, none)
    assert mpc.command(good).status is Status.OK
    statuses = [mpc.command(good + aside).status for _ in range(PATIENCE + 1)]
    assert statuses == [Status.REDUCED] * PATIENCE + [Status.OK]  # started anew there
    for off, status in ((0.5, Status.OK), *[(0.0, Status.OK)] * PATIENCE, (0.5, Status.REDUCED)):
        mpc.prepare()
        seen = np.append(mpc.estimator.hubs()[0], none) + 2.0 * off * aside
        assert mpc.command(seen).status is status
    mpc.prepare()
    far = np.append(mpc.estimator.hubs()[0], none) + 2.0 * JUMP * aside
    mpc.reset()
    assert mpc.command(far).status is Status.OK  # where it starts, the encoders say


def hubs(rti: RealTimeIteration) -> np.ndarray:
    """Return where an estimate has the hubs."""
    return rti.estimator.hubs()[0]


def test_encoders_go_on_without_one_that_is_not_valid_for_five_samples(two: Bench) -> None:
    """What it shows is not looked at; back again it is believed at once, where the arm is as it was foreseen."""
    rti = RealTimeIteration(two.step, two.links, two.inertia, zero_order=True)
    good, low, high = np.append(two.links.start_hub, 4 * [np.nan]), *two.problem.torque
    flags = np.array([True, False, *4 * [True]])
    assert rti.command(good, flags).status is Status.MEASUREMENT  # nobody knows yet where the arm starts
    assert rti.command(good).status is Status.OK
    statuses = []
    off = np.array([0.0, 1e6, *4 * [0.0]])
    for _ in range(PATIENCE + 2):
        command = rti.command(np.append(hubs(rti), 4 * [0.0]) + off, flags)
        statuses.append(command.status)
        assert np.all((command.torque >= low) & (command.torque <= high))
    assert statuses == [Status.REDUCED] * PATIENCE + [Status.MEASUREMENT] * 2
    rti.prepare()
    assert rti.command(np.append(hubs(rti), 4 * [np.nan])).status is Status.OK


def test_without_an_encoder_the_gain_is_that_of_the_covariance(two: Bench) -> None:
    """Of the first sample without it; with all of them it is the stationary one."""
    found = KalmanFilter(two.links, two.problem)
    row, noise = found.measure[1], found.noise[1, 1]
    expected = found.covariance @ row / (row @ found.covariance @ row + noise)
    assert_allclose(found.gain_of((1,))[:, 0], expected, rtol=1e-6, atol=1e-9)


def test_what_a_measurement_changes_is_what_rolling_out_anew_gives(two: Bench) -> None:
    """To first order, two samples late, on the way to the target; there zero order has the same sensitivities."""
    bench = Bench.of(two.scene.replace(**{"control.delay": 0.04}))
    rti = RealTimeIteration(bench.step, bench.links, bench.inertia)
    rti.command(np.append(bench.links.start_hub, 4 * [np.nan]))
    rti.prepare()
    about, start = rti._about, rti.estimator.estimate.copy()
    assert about is not None
    change = np.random.default_rng(1).normal(size=len(start))
    ends = []
    for small in (-1e-6, 1e-6):
        rti.estimator.estimate = start + small * change
        ends.append(rti._rolled_out().along)
    slope = (ends[1] - ends[0]) / 2e-6
    assert_allclose(about.by_estimate @ change, slope, rtol=1e-4, atol=1e-5 * np.abs(slope).max())
    rti.estimator.estimate = np.append(rti.target, NONE)
    rti._past[:] = bench.links.goal.torque
    rti._forget()
    scale = np.abs(rti.by_estimate).max()
    assert_allclose(rti._rolled_out().by_estimate, rti.by_estimate, atol=1e-6 * scale)
