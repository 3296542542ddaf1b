"""What moves the arm is smooth, said in words, and of the scene's size."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant, Sine
from tmm_gen.scene import Scene, load_scene
from tmm_gen.study.excitation import columns, excitation, unit
from tmm_gen.study.rise import SMOOTH, Rise


def test_rise_is_smooth_at_both_ends() -> None:
    rise = Rise(2.0, 3.0)
    assert abs(float(rise.at(0.0))) < 1e-15
    assert float(rise.at(3.0)) == float(rise.at(7.0)) == pytest.approx(2.0, rel=1e-15)
    assert float(rise.at(1.5)) == 1.0
    # the first derivatives vanish, so that the way out of an end goes with the next power of time
    for end in (0.0, 3.0):
        away = [abs(float(rise.at(abs(end - x))) - float(rise.at(end))) for x in (0.1, 0.05)]
        assert np.log2(away[0] / away[1]) == pytest.approx(SMOOTH + 1, abs=0.2)


@pytest.mark.parametrize("time", [-1.0, 0.0, 0.4, 1.5, 2.9, 3.0, 4.0])
def test_slope_is_the_derivative(time: float) -> None:
    rise, d = Rise(2.0, 3.0), 1e-5
    numeric = (float(rise.at(time + d)) - float(rise.at(time - d))) / (2.0 * d)
    assert rise.slope(time) == pytest.approx(numeric, abs=1e-9)


def test_defaults_of_a_scene_with_two_inputs_and_gravity() -> None:
    scene = load_scene("scenes/arm10.toml")
    went = excitation(scene)
    assert set(went.signals) == {"hub_torque", "tip_force"}
    assert went.output == "tip"
    assert (unit(scene, went.output), columns(scene, went.output)) == ("m", ("tip_x", "tip_y"))
    told = went.told(scene)
    assert told[-1] == "gravity of 9.81 m/s^2"
    assert told[0].startswith("hub_torque: 3 sin(")


def test_given_inputs_replace_the_defaults(chain: Scene) -> None:
    went = excitation(chain, {"torque": Constant(2.0)}, until=1.0)
    assert went.told(chain) == ["torque: 2, constant"]


def test_nothing_that_moves_is_refused(chain: Scene) -> None:
    with pytest.raises(UserError, match="nothing moves"):
        excitation(chain, {"torque": Constant(0.0)})


def test_unknown_output_is_refused(chain: Scene) -> None:
    with pytest.raises(UserError, match="no such output; choose from tip"):
        excitation(chain, output="hub")


def test_a_motor_turns_what_is_beyond_it() -> None:
    scene = load_scene("scenes/elbow.toml")
    went = excitation(scene)
    elbow = went.signals["elbow_torque"]
    assert isinstance(elbow, Sine)
    forearm, payload, rotor = 0.162 * 0.4**3 / 3.0, 0.3 * 0.4**2 + 2e-4, 50.0**2 * 1e-5
    turn = 50.0 * elbow.amplitude / elbow.frequency**2 / (forearm + payload + rotor)
    assert turn == pytest.approx(1.0, rel=0.5)  # amplitudes have one digit


def test_a_motor_with_a_strong_damper_turns_too() -> None:
    """The gripper's fingers are light: their dampers are what holds them, in a plane as in space."""
    for arm in ("scenes/gripper.toml", "examples/space/yaw3.toml"):
        scene = load_scene(arm)
        went = excitation(scene)
        signal = went.signals["left_torque" if scene.spatial is None else "yaw_torque"]
        assert isinstance(signal, Sine)
        gear, damping = (30.0, 0.06) if scene.spatial is None else (100.0, 0.5)
        turn = gear * signal.amplitude / (damping * signal.frequency)
        if scene.spatial is None:
            assert turn == pytest.approx(1.0, rel=0.6)
        else:  # from rest a damped joint goes one way only, twice as far; all loads together turn it
            assert 1.0 / len(went.signals) < 2.0 * turn < 1.1


def test_a_force_beyond_a_free_joint_is_of_the_size_of_what_it_carries() -> None:
    """However heavy the arm is up to there."""
    push = {"name": "push", "at": "payload", "acts": "force_y"}
    for upper in (None, 50.0):
        scene = load_scene("scenes/elbow.toml").replace(control=None, input=[push])
        if upper is not None:
            scene = scene.replace(**{"beam.upper.material": None, "beam.upper.section": None})
            scene = scene.replace(
                **{"beam.upper.mass_per_length": upper, "beam.upper.bending_stiffness": 9.0}
            )
        signal = excitation(scene).signals["push"]
        assert isinstance(signal, Sine)
        forearm, payload, rotor = 0.162 * 0.4**3 / 3.0, 0.3 * 0.4**2 + 2e-4, 50.0**2 * 1e-5
        inertia, w = forearm + payload + rotor, signal.frequency
        turn = 0.4 * signal.amplitude / np.hypot(inertia * w**2, 0.1 * w)  # the elbow's damper too
        assert turn == pytest.approx(1.0, rel=0.5)
