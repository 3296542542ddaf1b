"""What a run in space says where it diverges, and what `check` does not advise there."""

from __future__ import annotations

import numpy as np
import pytest
from support.spatial.boom import BOOM

from tmm_gen.scene import parse_scene
from tmm_gen.simulate.divergence import DivergedError
from tmm_gen.simulate.planar_divergence import PlanarWatch
from tmm_gen.verify.lasting import remedy


@pytest.mark.parametrize(("joint", "name"), [(0, "yaw"), (2, "rod_1_bend_z")])
def test_the_joint_is_named(joint: int, name: str) -> None:
    scene = parse_scene(BOOM)
    assert scene.spatial is not None
    assert scene.spatial.joints[joint].name == name
    angles = np.zeros(scene.stations)
    angles[joint] = 40.0
    with pytest.raises(
        DivergedError, match=rf"at t = 0.1 s joint '{name}' turns by 4.0e\+01 rad in one step"
    ) as told:
        PlanarWatch(scene, 5e-4).look(0.1, angles)
    assert "link" not in str(told.value)


def test_no_inputs_are_advised_that_no_option_gives() -> None:
    scene = parse_scene(BOOM)
    smaller = remedy(scene, 0.01, lambda _, factor: factor < 1.0, lambda _, factor: factor < 1.0)
    assert "--input" not in smaller
    assert "in vain" in smaller
