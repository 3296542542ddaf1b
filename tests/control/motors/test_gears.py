"""Gears that are rigid in a scene and give way in the arm that controllers are tried on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.cli import main
from tmm_gen.closed_loop.compare import compare
from tmm_gen.closed_loop.motion import motion
from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.plant.differing import conditions_of
from tmm_gen.control.plant.gears import GEAR_DAMPING_TIME, giving_way, rigid_gears
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

GEARS = next(case for case in CONDITIONS if case.name == "gears")
OUTPUT = {"motor.shoulder.encoder": "output", "motor.elbow.encoder": "output"}
RIGID = {"motor.shoulder.stiffness": 900.0, "motor.elbow.gear": 1}
"""Leaves no rigid gear."""


def test_the_largest_torque_twists_a_gear_by_what_is_said(elbow: Scene) -> None:
    """The larger of both bounds, as many times as the gear has it."""
    changes = giving_way(elbow, 2e-3)
    found = [changes[f"motor.{name}.stiffness"] for name in ("shoulder", "elbow")]
    assert_allclose(found, [100 * 0.15 / 2e-3, 50 * 0.06 / 2e-3])
    assert changes["motor.elbow.damping_time"] == GEAR_DAMPING_TIME
    uneven = elbow.replace(**{"control.bounds.torque.elbow": [-0.09, 0.02]})
    assert_allclose([giving_way(uneven, 1e-3)["motor.elbow.stiffness"]], [50 * 0.09 / 1e-3])


def test_only_rigid_gears_give_way(elbow: Scene) -> None:
    assert rigid_gears(elbow) == {"shoulder": 100, "elbow": 50}
    assert rigid_gears(elbow.replace(**{"motor.shoulder.stiffness": 900.0})) == {"elbow": 50}
    assert rigid_gears(elbow.replace(**{"motor.elbow.gear": 1})) == {"shoulder": 100}


def test_a_scene_without_has_no_such_condition(elbow: Scene, two: Bench) -> None:
    """It is not tried unless named, and refused before anything is simulated then."""
    assert conditions_of(elbow) == CONDITIONS
    bench = Bench.of(two.scene.replace(**RIGID))
    assert GEARS not in conditions_of(bench.scene)
    assert len(conditions_of(bench.scene)) == len(CONDITIONS) - 1
    with pytest.raises(UserError, match=r"elbow\.toml: no motor has a rigid gear"):
        next(compare(bench, [BY_NAME["pd"]], [CONDITIONS[0], GEARS]))


def test_the_command_refuses_it_for_an_arm_on_a_hub(capsys: pytest.CaptureFixture[str]) -> None:
    swing = Path(__file__).resolve().parents[3] / "scenes" / "swing.toml"
    assert main(["mpc", str(swing), "--controller", "pd", "--condition", "gears"]) == 2
    assert "no motor has a rigid gear" in capsys.readouterr().err


@pytest.mark.compiler
@pytest.mark.parametrize("encoders", [{}, OUTPUT], ids=["rotor", "output"])
def test_rotors_are_ahead_of_an_arm_at_rest(two: Bench, encoders: dict[str, object]) -> None:
    """By statics, torque over stiffness; encoders, on either side, show where the arm starts, and it stays there."""
    plant = Plant(two.scene.replace(**encoders), two.problem, GEARS)
    torque = plant._start()[1]
    angles = np.array(plant.kernel.state["angle"])
    twist = 2e-3 * torque[0] / 0.15
    assert twist > 5e-4
    assert_allclose(angles[0] - angles[1], twist, rtol=1e-9)
    assert_allclose(plant.measured()[:2], two.problem.start, atol=1e-12)
    assert_allclose(angles[1 if encoders else 0], two.problem.start[0], atol=1e-12)
    for _ in range(5):
        plant.advance(torque)
    assert_allclose(plant.kernel.state["angle"], angles, atol=1e-9)


@pytest.mark.compiler
def test_controllers_are_not_told_and_come_to_rest(firm_bench: Bench) -> None:
    """Joints, by their encoders on the rotors, and tips where the arm with such gears rests; and it can be shown."""
    kinds = [BY_NAME[name] for name in ("pd", "pd-id", "lqr", "mpc-links", "rti-zero")]
    trials = list(compare(firm_bench, kinds, [GEARS], duration=2.0))
    for trial in trials:
        name, last = trial.kind.name, trial.loop.tip[-1] - trial.loop.goal
        assert trial.figures.fallbacks == 0
        assert np.max(np.abs(last)) < (0.05 if name.startswith("pd") else 0.01), name
    shown = motion(firm_bench.scene, trials[-1])
    assert shown.scene.stations == len(trials[-1].loop.states[0]["angle"])
