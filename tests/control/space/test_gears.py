"""In space: gears that are rigid in a scene and give way in the arm that controllers are tried on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.compare import compare
from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.plant.gears import giving_way, rigid_gears
from tmm_gen.scene import Scene, load_scene, parse_scene

GEARS = next(case for case in CONDITIONS if case.name == "gears")
SPRING = """
[[joint]]
name = "lift_gear"
on = "lift"
axis = "y"
stiffness = 900.0
damping = 0.3
"""


def test_only_rigid_gears_give_way(reach: Scene, words: str) -> None:
    """Not that of a motor without gear, nor one before a spring, as `import` writes gears that give way."""
    assert rigid_gears(reach) == {"lift": 50}
    assert giving_way(reach, GEARS.twist)["motor.lift.stiffness"] == pytest.approx(50 * 0.16 / 2e-3)
    before = words.replace("[[beam]]", SPRING + "[[beam]]").replace(
        'on = "lift"\nlength', 'on = "lift_gear"\nlength'
    )
    assert not rigid_gears(parse_scene(before, "reach.toml"))
    yaw3 = load_scene(Path(__file__).resolve().parents[3] / "examples" / "space" / "yaw3.toml")
    assert set(rigid_gears(yaw3)) == set(motors_of(yaw3).names)


@pytest.mark.compiler
def test_a_rotor_is_ahead_of_an_arm_at_rest(bench: Bench) -> None:
    """By statics, torque over stiffness; the encoder on it shows where the arm starts, and it stays there."""
    plant = plant_of(bench.scene, bench.problem, GEARS)
    torque = plant._start()[1]
    angles = np.array(plant.kernel.state["angle"])
    (spring,) = (
        number for number, joint in enumerate(plant.scene.spatial.joints) if joint.name == "lift_gear"
    )
    assert abs(torque[1]) > 0.04
    assert_allclose(angles[spring], -GEARS.twist * torque[1] / 0.16, rtol=1e-9)
    assert_allclose(plant.measured()[:2], bench.problem.start, atol=2.0 * np.pi / 65536)
    for _ in range(5):
        plant.advance(torque)
    assert_allclose(plant.kernel.state["angle"], angles, atol=1e-9)


@pytest.mark.compiler
def test_controllers_are_not_told_and_come_to_rest(bench: Bench) -> None:
    kinds = [BY_NAME[name] for name in ("pd", "pd-id", "lqr", "mpc-links", "rti-zero")]
    for trial in compare(bench, kinds, [GEARS], duration=1.6):
        name, last = trial.kind.name, trial.loop.tip[-1] - trial.loop.goal
        assert trial.figures.fallbacks == 0
        assert np.max(np.abs(last)) < (0.05 if name.startswith("pd") else 0.01), name
