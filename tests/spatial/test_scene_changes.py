"""Scenes in space by their content: what counts, what does not, and keys that are changed."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from tmm_gen.scene import Scene, SceneError, load_scene, parse_scene
from tmm_gen.scene.emit import Emit
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.template import template

YAW3 = Path(__file__).parents[2] / "examples" / "space" / "yaw3.toml"


@pytest.fixture(scope="module")
def yaw3() -> Scene:
    return load_scene(YAW3)


def arm_of(scene: Scene) -> SpatialArm:
    assert scene.spatial is not None
    return scene.spatial


def test_the_arm_is_part_of_the_content(yaw3: Scene) -> None:
    heavier = yaw3.replace(**{"body.payload.mass": 0.6})
    assert heavier != yaw3
    assert heavier.digest != yaw3.digest
    assert heavier.replace(**{"body.payload.mass": 0.5}) == yaw3
    assert yaw3.replace(**{"model.gravity": None}) != yaw3


def test_spelling_is_not(yaw3: Scene) -> None:
    text = YAW3.read_text()
    same = text.replace('axis = "z"', "axis = [0, 0, 2]").replace("at = [0, 0, 0.3]", "at = [0.0, 0.0, 3e-1]")
    same = same.replace('name = "newmark"', 'name = "newmark"').replace('in = "world"\n', "")
    assert same != text
    assert parse_scene(same) == yaw3


def test_parts_may_stand_in_any_order(yaw3: Scene) -> None:
    head, *tables = YAW3.read_text().split("\n[[")
    *tables, last = tables  # with [initial] behind it
    parts = [table for table in tables if not table.startswith(("input", "output"))]
    others = [table for table in tables if table not in parts]
    parts = [part.replace('name = "yaw" ', 'name = "yaw"\non = "base" ') for part in parts]
    turned = "\n[[".join([head, *reversed(parts), *others, last])
    assert parse_scene(turned) == yaw3


def test_changes_by_name_reach_the_joints(yaw3: Scene) -> None:
    changed = arm_of(
        yaw3.replace(**{"motor.elbow.gear": 100, "beam.forearm.links": 2, "initial.angles.yaw": 0.25})
    )
    by_name = {joint.name: joint for joint in changed.joints}
    assert by_name["elbow"].armature == pytest.approx(0.1)
    assert by_name["yaw"].angle == 0.25
    assert by_name["elbow"].angle == 1.0
    assert len(changed.joints) == len(arm_of(yaw3).joints) - 2 * 3
    with pytest.raises(SceneError, match=r"motor\[3\]\.gear: must be greater than 0"):
        yaw3.replace(**{"motor.elbow.gear": 0})


def test_sweeps_follow_the_integrator(yaw3: Scene) -> None:
    assert yaw3.model.sweeps == 2
    assert yaw3.replace(**{"integrator.name": "sdirk4"}).model.sweeps == 3
    assert yaw3.replace(**{"model.iterations": 4}).model.sweeps == 4


def test_what_all_scenes_have(yaw3: Scene) -> None:
    assert yaw3.base.kind == "clamp"
    assert yaw3.emit == Emit()
    assert (yaw3.hub, yaw3.floats, yaw3.drivetrain, yaw3.turns, yaw3.prescribed) == (
        0,
        False,
        False,
        (),
        None,
    )
    # column, turret, upper arm, forearm
    assert yaw3.reach == pytest.approx(0.3 + 0.08 + 0.5 + 0.4)
    again = pickle.loads(pickle.dumps(arm_of(yaw3)))
    assert again == arm_of(yaw3)


def test_other_kinds_have_no_arm_in_space() -> None:
    for kind in ("chain", "planar"):
        assert parse_scene(template("a", kind)).spatial is None
