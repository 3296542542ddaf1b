"""Gains of PD that nobody tells are stable in samples: by the linear model, by a rigid arm's equation, and in loops."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tmm_gen.closed_loop.loop import run_loop
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import make_pd
from tmm_gen.control.laws.pd_gains import pd_growth, unstable_pd, usual_gains
from tmm_gen.scene import Scene


@pytest.mark.parametrize("period", [0.004, 0.02])
def test_a_rigid_arm_is_stable_as_far_as_its_equation_says(period: float) -> None:
    """``x < (sqrt(41) - 5)/2``, by the criterion of Jury."""
    model: Any = SimpleNamespace(
        size=2,
        count=1,
        delay=SimpleNamespace(whole=0),
        transition=np.array([[1.0, period], [0.0, 1.0]]),
        before=np.zeros((2, 1)),
        then=np.array([[0.5 * period**2], [period]]) / 3.0,
        hub=np.array([[1.0, 0.0]]),
    )

    def growth(share: float) -> float:
        slow = share * 0.5 * (np.sqrt(41.0) - 5.0) / period
        return pd_growth(model, period, np.array([3.0 * slow**2]), np.array([6.0 * slow]))

    assert growth(0.999) < 0.0 < growth(1.001)


def test_delayed_torques_count(two: Bench) -> None:
    """What they do is what a simulation of the sampled model does, torque by torque."""
    late = Bench.of(two.scene.replace(**{"control.delay": 0.03}))
    model, period, gains = late.modes, 0.02, usual_gains(late)
    assert model.delay.whole > 0
    state, last = np.random.default_rng(1).normal(size=model.size), np.zeros(2)
    torques, sizes = [np.zeros(2)] * (model.delay.whole + 1), []
    for _ in range(2000):
        hub = model.hub @ state
        torques.append(-gains[0] * hub - gains[1] * (hub - last) / period)
        state = model.transition @ state + model.before @ torques[-2 - model.delay.whole]
        state += model.then @ torques[-1 - model.delay.whole]
        last = hub
        sizes.append(float(np.linalg.norm(state)))
        state, last, torques = state / sizes[-1], last / sizes[-1], [each / sizes[-1] for each in torques]
    grown = np.exp(np.mean(np.log(sizes[1000:]))) - 1.0
    assert grown == pytest.approx(pd_growth(model, period, *gains), abs=1e-3)


def stiff(elbow: Scene) -> Scene:
    """Return the arm with two motors and beams ten times as stiff, of one spring each, without gains of PD."""
    changes: dict[str, object] = {"control.modes": 4, "control.horizon": 8, "control.baselines.pd": None}
    beams: Any = elbow.source.data["beam"]
    for beam in beams:
        changes[f"beam.{beam['name']}.links"] = 1
        changes[f"beam.{beam['name']}.bending_stiffness"] = 10.0 * beam["bending_stiffness"]
    return elbow.replace(**changes)


def test_a_stiff_arm_is_moved_slowly_enough(elbow: Scene) -> None:
    """At a quarter of its first frequency it is not stable; with the gains that are taken it arrives."""
    bench = Bench.of(stiff(elbow))
    quarter = 0.25 * arm_of(bench.scene).slowest()
    own = (bench.inertia * quarter**2, 2.0 * bench.inertia * quarter)
    assert pd_growth(bench.modes, bench.problem.sample_time, *own) > 0.01
    proportional, derivative = usual_gains(bench)
    assert np.all(proportional < 0.3 * own[0])
    assert pd_growth(bench.modes, bench.problem.sample_time, proportional, derivative) < 0.0
    told: Any = {name: list(each) for name, *each in zip(bench.problem.motors.names, *own, strict=True)}
    off = []
    for gains in (None, told):
        loop = run_loop(
            make_pd(bench, gains), Plant(bench.scene, bench.problem, CONDITIONS[0]), 3.0, timed=False
        )
        off.append(float(np.max(np.abs(loop.tip[-200:] - loop.goal))))
    assert off[0] < 0.02 < off[1]


def test_where_no_gains_are_stable_that_is_said(elbow: Scene, two: Bench) -> None:
    """Torques come so late that an arm held up by its motors swings with any; gains that are told are the user's."""
    late = two.scene.replace(**{"control.delay": 0.03, "control.baselines.pd": None})
    (line,) = unstable_pd(Bench.of(late), ["lqr", "pd", "pd-id"])
    assert ": control.baselines: no gains are written for pd, and none" in line
    assert "a delay of 0.03 s" in line
    assert unstable_pd(Bench.of(late), ["lqr", "pd-id"]) == []
    assert unstable_pd(Bench.of(late.replace(**{"control.delay": 0.0})), ["pd"]) == []
    assert unstable_pd(Bench.of(stiff(elbow)), ["pd"]) == []
