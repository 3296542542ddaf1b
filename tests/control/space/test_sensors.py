"""Accelerometers and strain gauges of an arm in space: what they show."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.control.arm.space_frame import SpaceFrame
from tmm_gen.control.bench import Bench
from tmm_gen.control.goals.target import rest_with
from tmm_gen.reference.spatial_places import Tree
from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.scene.spatial.motor_ends import MotorEnds


def test_accelerometers_feel_second_differences_of_places(reach: Scene) -> None:
    """Along the way the tip goes as the motor turns at the reference, in the axes of the body they are on."""
    bench = Bench.of(reach.replace(**{"control.sensors.accelerometer": 0.1}))
    sensing, random, time = bench.step.sensing, np.random.default_rng(1), 1e-4
    angles, rates, growth = random.uniform(-1.0, 1.0, (3, sensing.size)) * np.array([[1.0], [4.0], [50.0]])
    found = sensing.values(angles, rates, growth)
    arm = bench.step.scene.spatial
    assert arm is not None
    payload, tree = SpaceFrame.of(arm, "payload"), Tree(arm)
    before, now, after = (payload.place(angles + t * rates + 0.5 * t**2 * growth) for t in (-time, 0.0, time))
    pushed = (before - 2.0 * now + after) / time**2 + [0.0, 0.0, 9.81]
    straight = np.array([0.8, 0.2, 0.0, 0.0])
    turned = tree.places(angles).frame(payload.frame)[0] @ tree.places(straight).frame(payload.frame)[0].T
    for motor in range(2):
        further = straight + 1e-6 * np.eye(4)[motor]
        way = payload.place(further) - payload.place(straight)
        assert found[motor] == pytest.approx(pushed @ turned @ way / np.linalg.norm(way), abs=1e-4)


def test_a_gauge_shows_what_hangs_beyond_it(reach: Scene) -> None:
    """At rest, about the motor's axis, of an arm of many cells and of one that knows the gauge by a single cell."""
    scene = reach.replace(**{"control.sensors.strain": {"lift": 0.1}})
    bench = Bench.of(scene)
    rest = rest_with(scene, np.array([0.4, 0.3]), "control.reference")
    shown = bench.step.sensing.values(rest.angles, 0 * rest.angles, 0 * rest.angles)
    # beyond the middle of the beam, 0.3 m: half of it and the payload; positive angles lower the arm
    level = np.cos(rest.angles[1] + rest.angles[2])
    assert shown[3] == pytest.approx(9.81 * (0.15 * 0.15 + 0.4 * 0.3) * level, rel=1e-9)
    assert shown[[0, 1, 2]] == pytest.approx(0.0)
    fine = scene.replace(**{"beam.upper.links": 8})
    assert bench.modes.target_sensors[5] == pytest.approx(
        bench.links.target_sensors[5], rel=0.02
    )  # forty cells against one
    assert len(Bench.of(fine).step.sensing.gauges) == 2


def test_where_nothing_can_be_shown_the_scene_is_refused(reach: Scene, words: str) -> None:
    """With its line, and by a remedy that works; the yaw carries a motor."""
    for told, key in ((0.1, "strain"), ({"yaw": 0.1, "lift": 0.1}, "strain.yaw")):
        with pytest.raises(
            SceneError, match=r"'yaw' carries no beam .* `strain = \{ lift = 0\.1 \}`"
        ) as caught:
            reach.replace(**{"control.sensors.strain": told})
        assert [problem.key for problem in caught.value.problems] == [f"control.sensors.{key}"]
    assert Bench.of(reach.replace(**{"control.sensors.strain": {"lift": 0.1}})).step.sensing.gauges[1]
    sensors = "[control.sensors]\naccelerometer = 0.1\nstrain = { lift = 0.2 }"
    text = words.replace("[control.sensors]", sensors)
    along = text.replace('on = "yaw"\naxis = "y"', 'on = "yaw"\naxis = "x"')
    with pytest.raises(SceneError) as caught:
        parse_scene(along, "along.toml")
    line = 1 + text[: text.index("accelerometer = 0.1")].count("\n")
    felt, bent = map(str, caught.value.problems)
    assert felt == (
        f"along.toml:{line}: control.sensors.accelerometer: the tip of the motor 'lift', the end of 'payload', is on "
        "its axis, where nothing is felt of its turning (got 0.1). Name others, such as "
        "`accelerometer = { yaw = 0.1 }`, or remove it."
    )
    assert bent == (
        f"along.toml:{line + 1}: control.sensors.strain.lift: the beam of the motor 'lift' does not bend about its "
        "axis (got 0.2). Remove the key."
    )
    mended = along.replace("accelerometer = 0.1", "accelerometer = { yaw = 0.1 }")
    assert Bench.of(parse_scene(mended.replace("strain = { lift = 0.2 }\n", ""))).step.sensing.accelerometers[
        0
    ]


HINGE = """\
[[joint]]
name = "hinge"
on = "lift"
axis = "x"
stiffness = 50.0
rest = 1.2
"""


def test_what_is_refused_is_what_does_not_move(words: str) -> None:
    """Axes drawn at random, a spring that is slack askew: the rules beside places and axes of the reference."""
    random, counted = np.random.default_rng(3), np.zeros((2, 2), int)
    bent = words.replace("[[beam]]", HINGE + "[[beam]]").replace(
        'name = "upper"\non = "lift"', 'name = "upper"\non = "hinge"'
    )
    for apart in np.tile([0.01, 0.07, 0.3], 13):
        axis = [1.0, *random.normal(scale=apart, size=2).tolist()]
        text = bent.replace('on = "yaw"\naxis = "y"', f'on = "yaw"\naxis = {axis}')
        turn = [0.0, *random.normal(scale=apart, size=2).tolist()]
        arm = parse_scene(text.replace('on = "hinge"', f'on = "hinge"\nturn = {turn}')).spatial
        assert arm is not None
        posture = np.array([0.8, 0.2, 1.2, 0.0, 0.0])
        payload, tree = SpaceFrame.of(arm, "payload"), Tree(arm)
        ends = MotorEnds(arm, ("upper",), {1: 0.8, 2: 0.2})
        moved = payload.place(posture + 1e-6 * np.eye(5)[1]) - payload.place(posture)
        felt = np.linalg.norm(moved) / 1e-6 > 0.05 * 0.6
        assert (ends.tip(2) is not None) == felt
        axes = tree.places(posture).axis
        about = axes[3:] @ axes[1]
        found = ends.bends(2)
        assert (found is not None) == (np.max(np.abs(about)) >= 0.1)
        if found:
            assert [bend.about for bend in found[1]] == pytest.approx(about.tolist(), abs=1e-12)
        assert ends.bends(1) is None
        counted[0, int(felt)] += 1
        counted[1, int(found is not None)] += 1
    assert np.all(counted > 4)
