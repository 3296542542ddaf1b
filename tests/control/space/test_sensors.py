"""Accelerometers and strain gauges of an arm in space: what they show."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.control.problem import control_problem
from tmm_gen.control.space_frame import SpaceFrame
from tmm_gen.control.target import rest_with
from tmm_gen.errors import UserError
from tmm_gen.reference.spatial_places import Tree
from tmm_gen.scene import Scene, SceneError


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


def test_where_nothing_can_be_shown_the_scene_is_refused(reach: Scene) -> None:
    """The yaw carries a motor; the remedy that is told works."""
    for told in (0.1, {"yaw": 0.1, "lift": 0.1}):
        with pytest.raises(SceneError, match=r"'yaw' carries no beam .* \{ lift = 0\.01 \}"):
            reach.replace(**{"control.sensors.strain": told})
    assert Bench.of(reach.replace(**{"control.sensors.strain": {"lift": 0.01}})).step.sensing.gauges[1]
    upright = reach.replace(
        **{
            "motor.lift.axis": "x",
            "control.sensors.accelerometer": 0.1,
        }
    )
    with pytest.raises(UserError, match="what 'lift' carries ends on its axis"):
        _ = Bench.of(upright).step.sensing
    assert control_problem(upright).count == 2
