"""Prediction models: the generated step and the modes, held against the arm they stand for."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.prediction.modes import modes_model
from tmm_gen.control.prediction.prediction import fine_scene
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.prediction.stepped_frequency import model_frequency
from tmm_gen.control.task.delay import Delay, delay_of
from tmm_gen.modal.beam import natural_frequencies
from tmm_gen.modal.discretised import continuous
from tmm_gen.scene import Scene


@pytest.fixture(scope="module")
def bench(swing: Scene) -> Bench:
    """Models of the arm there is: they reckon with the payload it has."""
    return Bench.of(swing.replace(**{"control.payload": 1.0}))


def nearest(transition: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Return the natural frequencies of a sampled model nearest to some, rad/s; higher ones appear among them."""
    poles = np.linalg.eigvals(transition).astype(complex)
    found = np.abs(np.log(poles[np.abs(poles) > 1e-3]) / 0.02)
    return np.array([found[np.argmin(np.abs(found - each))] for each in wanted])


def test_stepped_frequency_of_the_average_acceleration(swing: Scene) -> None:
    """tan(w h / 2) is half of the model's frequency times the step."""
    for wanted in (1.0, 30.0, 100.0):
        expected = 2.0 / 5e-3 * math.tan(0.5 * wanted * 5e-3)
        assert model_frequency(swing.integrator, 5e-3, wanted) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("springs", ["half-clamp", "clamped-segment"])
def test_links_and_modes_have_the_frequencies_of_the_beam(springs: str, bench: Bench) -> None:
    """However it is cut: equal links, or the last one half as long."""
    if springs != "half-clamp":
        bench = Bench.of(bench.scene.replace(**{"beam.springs": springs}))
    beam = continuous(bench.assumed)
    assert beam is not None
    exact = natural_frequencies(beam, 3)[1:]
    assert_allclose(nearest(bench.links.transition, exact), exact, rtol=3e-3)  # damping shifts them
    assert_allclose(nearest(bench.modes.transition, exact), exact, rtol=2e-3)


@pytest.mark.parametrize("springs", ["half-clamp", "clamped-segment"])
def test_a_finer_arm_starts_in_the_same_shape(springs: str, swing: Scene) -> None:
    """Bent evenly, each middle of a link by as much as its place along the beam."""
    coarse = swing.replace(**{"beam.springs": springs})
    bent = coarse.replace(**{"initial.angles": middles(coarse).tolist()})
    fine = fine_scene(bent)
    assert fine.stations == 40
    places = middles(fine)
    within = (places > middles(bent)[0]) & (places < middles(bent)[-1])
    assert np.count_nonzero(within) > 30
    assert_allclose(np.array(fine.initial.angles)[within], places[within], rtol=1e-12)


def middles(scene: Scene) -> np.ndarray:
    """Return where the middles of links are along the beam, m."""
    ends = np.cumsum([link.length for link in scene.links])
    return ends - 0.5 * np.array([link.length for link in scene.links])


def test_a_beam_of_few_links_is_too_slow_without_calibration(small: Bench) -> None:
    from tmm_gen.control.prediction.prediction import prediction_scene

    raw = StepModel(prediction_scene(small.assumed, calibrate=False), small.problem)
    transition, _ = raw.jacobian(raw.straight(1.0), np.zeros(1))
    beam = continuous(small.assumed)
    assert beam is not None
    exact = natural_frequencies(beam, 3)[1:]
    assert nearest(transition, exact)[0] < 0.95 * exact[0]
    assert_allclose(nearest(small.links.transition, exact), exact, rtol=6e-3)


def test_slopes_are_those_of_the_sample(bench: Bench) -> None:
    model, random = bench.step, np.random.default_rng(0)
    state = 0.1 * random.standard_normal(model.size)
    _, by_state, by_torques = (np.array(item) for item in model.sample_slopes(state, [0.5, -0.7]))
    for slope, width in ((by_state, model.size), (by_torques, 2)):
        for column in random.choice(width, min(4, width), replace=False):
            change = np.zeros(width)
            change[column] = 1e-6

            def moved(sign: float, change: np.ndarray = change, states: bool = width > 2) -> np.ndarray:
                at = state + sign * change if states else state
                torques = [0.5, -0.7] if states else np.array([0.5, -0.7]) + sign * change
                return np.array(model.sample(at, torques)).ravel()

            assert_allclose(slope[:, column], (moved(1.0) - moved(-1.0)) / 2e-6, rtol=1e-6, atol=1e-5)


def test_compiled_trajectories_are_those_of_single_samples_whatever_is_carried(bench: Bench) -> None:
    """One library for all arms alike: what they weigh is an argument."""
    heavier = Bench.of(bench.scene.replace(**{"control.payload": 1.5}))
    random = np.random.default_rng(1)
    count = bench.problem.horizon
    states = 0.1 * random.standard_normal((bench.step.size, count))
    torques = random.standard_normal((2, count))
    rolled = []
    for model in (bench.step, heavier.step):
        singly = [model.sample_slopes(x, w) for x, w in zip(states.T, torques.T, strict=True)]
        expected = np.stack([np.hstack([np.array(item) for item in each]) for each in singly], axis=1)
        after, by_state, by_torques = (np.array(item) for item in model.rollout_slopes(states, torques))
        width = model.size
        assert_allclose(after, expected[:, :, 0], rtol=1e-9, atol=1e-9)
        assert_allclose(by_state.reshape(width, count, width), expected[:, :, 1:-2], rtol=1e-9, atol=1e-6)
        assert_allclose(by_torques.reshape(width, count, 2), expected[:, :, -2:], rtol=1e-9, atol=1e-9)
        x = states[:, 0]
        for k, reached in enumerate(np.array(model.rollout(x, torques)).T):
            x = np.array(model.sample(x, torques[:, k])).ravel()
            assert_allclose(reached, x, rtol=1e-9, atol=1e-9)
        rolled.append(x)
    assert np.max(np.abs(rolled[0] - rolled[1])) > 1e-3


def test_newmark_is_half_a_step_late_and_runge_kutta_is_not(swing: Scene, bench: Bench) -> None:
    assert bench.step.lag == pytest.approx(0.5, abs=2e-3)
    other = Bench.of(swing.replace(**{"integrator.name": "sdirk2", "beam.links": 1}))
    assert other.step.lag == 0.0


def test_delays_are_split(bench: Bench) -> None:
    def split(delay: float, lag: float) -> Delay:
        return delay_of(dataclasses.replace(bench.problem, delay=delay), lag)

    assert split(0.0, 0.0) == Delay(0, 0.0, 0)
    assert split(0.0, 0.125) == Delay(0, -0.125, 0)
    assert split(0.01, 0.0) == Delay(0, 0.5, 0)
    assert split(0.04, 0.0) == Delay(2, pytest.approx(0.0), 2)
    assert split(0.05, 0.125) == Delay(2, pytest.approx(0.375), 2)
    assert_allclose(split(0.0, 0.125).shares(4), [-0.5, 0.0, 0.0, 0.0])
    assert_allclose(split(0.015, 0.0).shares(4), [1.0, 1.0, 1.0, 0.0])


def test_which_torques_act() -> None:
    past = np.array([1.0, 2.0, 3.0, 4.0])  # the newest last
    late = Delay(whole=2, part=0.5, acting=2)
    assert late.memory == 3
    assert late.pair(past) == (1.0, 2.0)
    assert late.end(past) == 2.0
    assert late.known(past) == [(2.0, 3.0), (3.0, 4.0)]
    assert Delay(0, 0.0, 0).known(past) == []


@pytest.mark.compiler
@pytest.mark.parametrize("delay", [0.0, 0.01, 0.034])
def test_models_follow_the_arm_under_known_torques(swing: Scene, bench: Bench, delay: float) -> None:
    """Half a second of changing torques, with a delay: tip within 0.6 % of its way, hub within 2 %, by modes 1 %."""
    problem = dataclasses.replace(bench.problem, delay=delay)
    plant = Plant(swing, problem, CONDITIONS[0])
    step = StepModel(bench.step.scene, problem)
    modes = modes_model(swing, problem)
    random = np.random.default_rng(3)
    state, modal = step.initial(), modes.start.copy()
    offset = np.vstack([modes.tip, modes.hub]) @ modes.start
    rows = step.rows(np.vstack([step.motors.tip, step.motors.hub]), "angle")
    past = {"links": np.zeros((5, 1)), "modes": np.zeros((5, 1))}
    seen, way = [], []
    for k in range(25):
        torque = 2.0 * (1.0 if k < 12 else -1.0) + random.uniform(-1.0, 1.0, 1)
        angles = plant.advance(torque)[-1]
        past = {name: np.vstack([old[1:], torque]) for name, old in past.items()}
        state = np.array(step.sample(state, np.hstack(step.delay.pair(past["links"])))).ravel()
        before, then = modes.delay.pair(past["modes"])
        modal = modes.transition @ modal + modes.before @ before + modes.then @ then
        links = rows @ state
        found = np.vstack([modes.tip, modes.hub]) @ modal - offset
        seen.append([links - angles, found - angles])
        way.append(angles)
    off, reach = np.max(np.abs(seen), axis=0), np.max(np.abs(way), axis=0)
    assert reach[0] > 0.3
    assert np.all(off[:, 0] < 6e-3 * reach[0]), off
    assert np.all(off[:, 1] < np.array([2e-2, 1e-2]) * reach[1]), off


def test_models_reckon_with_the_payload_they_are_told(swing: Scene) -> None:
    told = Bench.of(swing.replace(**{"control.payload": 1.5}))
    heavier = Bench.of(swing.replace(**{"control.payload": 1.0, "tip.mass": 1.5 * 0.1}))
    assert told.inertia == pytest.approx(heavier.inertia, rel=1e-12)
    for model, other in ((told.modes, heavier.modes), (told.links, heavier.links)):
        assert_allclose(model.transition, other.transition, rtol=1e-12, atol=1e-12)
    plants = [Plant(each.scene, each.problem, CONDITIONS[0]) for each in (told, heavier)]
    lighter, loaded = (np.vstack([plant.advance(np.ones(1)) for _ in range(10)])[-1, 0] for plant in plants)
    assert lighter > 1.05 * loaded  # the arm itself has the payload of the scene
