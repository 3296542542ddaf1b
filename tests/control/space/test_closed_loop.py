"""Controllers move an arm in space of more cells and another integrator to where it is to go."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.loop import run_loop
from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.laws.full_nmpc import FullNmpc
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.scene import SceneError, parse_scene

HUB = '[[body]]\nname = "hub"\non = "base"\nmass = 1.0\ninertia = [0.01, 0.01, 0.01]'
HEAVIER = replace(CONDITIONS[1], payload=1.2, friction=0.02)


@pytest.mark.parametrize("name", ["pd-id", "lqr", "rti-zero", "rti"])
def test_it_comes_to_rest_where_it_is_to_go(bench: Bench, name: str) -> None:
    """With more payload than it was told, and friction: what has an estimator has no offset left."""
    plant = plant_of(bench.scene, bench.problem, HEAVIER)
    assert plant.scene.stations > bench.scene.stations
    loop = run_loop(BY_NAME[name].make(bench), plant, 1.6, timed=False)
    low, high = bench.problem.torque
    assert np.all((loop.torque >= low) & (loop.torque <= high))
    assert np.max(np.abs(loop.tip[-1] - loop.goal)) < (0.05 if name == "pd-id" else 2e-3)
    assert not loop.fallbacks


def test_real_time_iterations_at_one_state_come_to_the_nonlinear_optimum(bench: Bench) -> None:
    rti = RealTimeIteration(bench.step, bench.links, bench.inertia)
    full = FullNmpc(bench.step, bench.links, bench.inertia, "ipopt")
    state, none, last = bench.step.initial(), np.zeros(2), bench.links.start_torque
    expected = full.decide(state, none, last)
    for _ in range(8):
        rti._plan = np.hstack([rti._plan[:, :1], rti._plan[:, :-1]])  # decide() moves on by a sample
        found = rti.decide(state, none, last)
    assert expected.status.optimal
    assert_allclose(found.torque, expected.torque, rtol=1e-3)


def test_what_cannot_be_had_says_so(words: str) -> None:
    for old, new, told in (
        (
            'kind = "clamp"',
            f'kind = "free"\n{HUB}',
            'does not control arms in space on base.kind = "free" yet',
        ),
        ("reference = { yaw", "reference = { jaw", "is not the name of a driven motor"),
        ("encoder = 65536", "encoder = 65536\nstrain = { jaw = 0.1 }", "is not the name of a driven"),
        (
            "[control.bounds]",
            "[control.bounds]\nhub = { yaw = [-1, 0.5], lift = 1 }",
            "excludes the reference",
        ),
    ):
        with pytest.raises(SceneError, match=told):
            parse_scene(words.replace(old, new), "reach.toml")
