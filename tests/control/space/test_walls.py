"""Walls in space and rates of joints: where parts are, what turns them there, that real-time iterations keep bounds."""

from __future__ import annotations

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.compare import compare
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.full_nmpc import FullNmpc
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.plant.plant_scene import plant_scene
from tmm_gen.control.quadratic.response import split_outputs
from tmm_gen.control.quadratic.walls import Wall, far_behind
from tmm_gen.errors import UserError
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.still import Still
from tmm_gen.scene import SceneError, parse_scene


def test_how_far_along_the_normal_a_part_is_and_what_turns_it_there(walled: Bench) -> None:
    """Against the forms of small motion, which go from body to body."""
    arm = walled.scene.spatial
    assert arm is not None
    numbers = ArmNumbers(arm)
    angles = np.random.default_rng(3).uniform(-2.0, 2.0, (4, numbers.size))
    for keep in walled.problem.keeps:
        wall, normal = Wall.of(walled.scene, keep), np.array(keep.normal)
        frame = next(each for each in arm.frames if each.name == keep.frame)
        normal /= np.linalg.norm(normal)
        for still, place, slopes in zip(
            [Still(numbers, each, {}) for each in angles],
            wall.along(angles),
            wall.slopes(angles),
            strict=True,
        ):
            assert_allclose(place, normal @ still.place(frame), atol=1e-14)
            assert_allclose(slopes, normal @ still.moved(frame)[0][:, 6:], atol=1e-14)


def test_real_time_iterations_keep_away_from_what_a_regulator_passes(walled: Bench) -> None:
    """The arm that is controlled has more cells than the one thought of, and so bends otherwise."""
    kinds = [BY_NAME[name] for name in ("lqr", "rti", "rti-zero")]
    passing, *keeping = compare(walled, kinds, CONDITIONS[:1], duration=0.9)
    assert passing.nearest is not None
    assert passing.nearest < -0.1
    fine = plant_scene(walled.scene, CONDITIONS[0])
    for trial in keeping:
        assert trial.nearest is not None
        assert trial.nearest > 0.0
        assert not trial.loop.fallbacks
        angles = trial.loop.states[-1]["angle"]
        for keep in walled.problem.keeps:  # both hold it up, at their margins, softly
            there = Wall.of(fine, keep).along(angles[None])[0] - keep.offset
            assert there == pytest.approx(keep.margin, abs=4e-3)


def test_what_is_kept_of_a_wall_at_rest_is_what_full_sensitivities_are_there(walled: Bench) -> None:
    """Along a plan that holds the arm at its reference, where both are about the same motion, a delay before it."""
    late = Bench.of(walled.scene.replace(**{"control.delay": 0.05}))
    found = []
    for zero_order in (False, True):
        rti = RealTimeIteration(late.step, late.links, late.inertia, zero_order)
        state, none, held = rti.rest, np.zeros(2), rti.goal.torque
        rti._plan = np.repeat(held[:, None], late.problem.horizon, axis=1)
        _, by_start, condensed = rti._along(state, none, held)
        assert rti.delay.whole > 0
        known = [(held, held)] * rti.delay.whole
        rti.estimator.estimate = np.append(state, none)
        by_estimate = by_start if zero_order else by_start @ rti._until(known)
        count = len(late.problem.keeps) * late.problem.horizon
        found.append([condensed.slopes.keep, by_estimate[-count:]])
    for full, kept in zip(*found, strict=True):
        assert np.max(np.abs(full)) > 1e-3
        assert_allclose(kept, full, atol=1e-8 * np.max(np.abs(full)))


def test_an_arm_that_starts_far_behind_a_wall_is_told(walled: Bench) -> None:
    """By the wall's number, and how far: further than a wall holds."""
    assert far_behind(walled.scene, walled.problem) == []
    moved = Bench.of(walled.scene.replace(**{"control.keep[2].offset": 0.3}))
    (told,) = far_behind(moved.scene, moved.problem)
    upper = Wall.of(moved.scene, moved.problem.keeps[1])
    angles = rest_with(moved.scene, moved.problem.start, "start").angles
    assert re.match(r".*:\d+: control\.keep\[2\]: 'upper' starts .* m beyond", told)
    assert f"starts {0.3 + 0.02 - upper.along(angles[None])[0]:.3g} m" in told


def test_what_keeps_no_walls_says_so(walled: Bench, words: str) -> None:
    with pytest.raises(UserError, match=r":\d+: control\.keep: .* keeps no walls; take rti-zero, rti"):
        BY_NAME["mpc-links"].require_able(walled)
    wall = '[[control.keep]]\nframe = "payload"\nnormal = [0, 0, 1]\noffset = -0.3\n'
    assert parse_scene(words + wall, "reach.toml").control
    for old, new, told in (
        ("[0, 0, 1]", "[0, 1]", "must be three numbers: x, y, z"),
        ("[0, 0, 1]", "[0, 0, 0]", "has no direction"),
        ("[0, 0, 1]", "[0, 0, 0, 1]", "must be a direction"),
        ("payload", "pay", "is not the name of a part that moves"),
        ("[[control.keep]]", "[control.keep]", r"Write \[\[control\.keep\]\] with double brackets"),
    ):
        with pytest.raises(SceneError, match=told):
            parse_scene(words + wall.replace(old, new), "reach.toml")


def test_plans_repeated_at_one_state_keep_the_walls_of_their_own_rollout(walled: Bench) -> None:
    """From a plan that is all wrong, at an arm on its way into the floor; both end as near to the wall."""
    state, none, last = walled.step.initial(), np.zeros(2), walled.links.start_torque
    for quantity, change in (("angle", [0.35, 0.35]), ("rate", [1.0, 0.5])):
        state[walled.step.places(quantity)] += walled.problem.motors.turned @ np.array(change)
    floor, edges = walled.problem.keeps[0], []
    for kind in ("rti", "rti-zero"):
        rti = BY_NAME[kind].make(walled)
        assert isinstance(rti, RealTimeIteration)
        passed, changes = [], []
        for _ in range(8):  # of zero order each leaves a fifth of the change before
            before = rti._plan.copy()
            rti._plan = np.hstack([before[:, :1], before[:, :-1]])  # decide() moves on by a sample
            rti.decide(state, none, last)
            along = split_outputs(rti._along(state, none, last)[0], before.shape, len(rti.walls))
            passed.append(floor.offset + floor.margin - np.min(along.keep[0]))
            changes.append(np.max(np.abs(rti._plan - before)))
        assert changes[0] > 5.0
        assert changes[-1] < 1e-4
        assert passed[0] < 5e-3  # one iteration has made up for nearly all of it
        edges.append(passed[-1])
    assert 0.0 < edges[0] < 1e-3  # softly
    assert edges[1] == pytest.approx(edges[0], abs=1e-5)


def test_plans_keep_bounds_of_how_fast_joints_turn(walled: Bench) -> None:
    """Repeated at one state; without the bounds they would turn half as fast again."""
    peaks = []
    for bench in (walled, Bench.of(walled.scene.replace(**{"control.bounds.hub_rate": None}))):
        rti = BY_NAME["rti"].make(bench)
        assert isinstance(rti, RealTimeIteration)
        state, none, last = bench.step.initial(), np.zeros(2), bench.links.start_torque
        for _ in range(3):
            rti._plan = np.hstack([rti._plan[:, :1], rti._plan[:, :-1]])  # decide() moves on by a sample
            rti.decide(state, none, last)
        along = split_outputs(rti._along(state, none, last)[0], rti._plan.shape, len(rti.walls))
        peaks.append(np.max(np.abs(along.hub_rate), axis=1))
    assert_allclose(peaks[0], 2.0, atol=2e-3)  # softly
    assert np.all(peaks[1] > 2.7)


def test_real_time_iterations_beside_walls_come_to_the_nonlinear_optimum(walled: Bench) -> None:
    """At an arm on its way into the floor, whose joints turn as fast as they may: all soft bounds are met."""
    state, none, last = walled.step.initial(), np.zeros(2), walled.links.start_torque
    for quantity, change in (("angle", [0.35, 0.35]), ("rate", [1.9, 0.9])):
        state[walled.step.places(quantity)] += walled.problem.motors.turned @ np.array(change)
    full = FullNmpc(walled.step, walled.links, walled.inertia, "ipopt")
    expected = full.decide(state, none, last)
    rti = BY_NAME["rti"].make(walled)
    assert isinstance(rti, RealTimeIteration)
    for _ in range(12):
        rti._plan = np.hstack([rti._plan[:, :1], rti._plan[:, :-1]])  # decide() moves on by a sample
        found = rti.decide(state, none, last)
    assert expected.status.optimal
    assert_allclose(found.torque, expected.torque, atol=1e-3 * np.max(walled.problem.torque))


def test_walls_between_which_nothing_is_left_are_refused_with_an_offset_that_goes(words: str) -> None:
    wall = '[[control.keep]]\nframe = "payload"\nnormal = {}\noffset = {}\n'
    floor = wall.format([0, 0, 2], 0.3)
    with pytest.raises(
        SceneError, match=r"keep\[2\]\.offset: leaves 'payload' no place.*below -0\.3, or turn"
    ):
        parse_scene(words + floor + wall.format([0, 0, -7], -0.2), "reach.toml")
    for normal, offset in (([0, 0, -7], -0.31), ([0, 0, 1], -0.2), ([0, 1, -1], -0.2)):
        assert parse_scene(words + floor + wall.format(normal, offset), "reach.toml").control


@pytest.mark.parametrize("length", [1e-320, 1e308])
def test_a_normal_may_be_of_any_length(walled: Bench, length: float) -> None:
    keep = walled.problem.keeps[0].model_copy(update={"normal": (0.0, length, 0.0)})
    assert_allclose(Wall.of(walled.scene, keep).normal, [0.0, 1.0, 0.0])
