"""A base in space that is moved along as inputs say: the reference by MuJoCo, a crane by its own two lines."""

from __future__ import annotations

import re
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.spatial.kernels import HEADED
from support.spatial.random_arms import random_arm

from tmm_gen.errors import UserError
from tmm_gen.export.mjcf import mujoco_model
from tmm_gen.inputs.signals import Sine
from tmm_gen.inputs.waveforms import Step
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.situation import rest_in_space
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.report.space_motion import space_motion
from tmm_gen.scene import SceneError, parse_scene
from tmm_gen.scene.spatial.arm import ArmInput
from tmm_gen.simulate.run import simulate

MASS, LENGTH, INERTIA, GRAVITY = 2.0, 0.7, 0.02, 9.81
CRANE = f"""
name = "crane"
model = {{ kind = "spatial", gravity = [0, 0, -{GRAVITY}] }}
integrator = {{ name = "newmark", step = 1e-3 }}
[base]
kind = "prescribed"
[[input]]
name = "trolley"
at = "base"
acts = "place_x"
[[joint]]
name = "sway"
axis = "y"
[[link]]
name = "rope"
on = "sway"
end = [0, 0, -{LENGTH}]
[[body]]
name = "load"
on = "rope"
mass = {MASS}
inertia = [{INERTIA}, {INERTIA}, {INERTIA}]
[[output]]
name = "load"
at = "load"
of = "position"
[[output]]
name = "speed"
at = "load"
of = "velocity"
[[output]]
name = "kinetic"
at = "arm"
of = "kinetic_energy"
[[output]]
name = "weight"
at = "arm"
of = "gravitational_energy"
[[output]]
name = "hold"
at = "base"
of = "force"
"""
SLIDES = "".join(f'<joint type="slide" axis="{axis}" />' for axis in ("1 0 0", "0 1 0", "0 0 1"))


@pytest.mark.parametrize("seed", range(3))
def test_the_reference_takes_the_torques_that_mujoco_takes(seed: int) -> None:
    """MuJoCo carries the same arm on three slides, and says what its joints lack for a motion."""
    arm = replace(random_arm(seed, 5, loads=False), inputs=(), outputs=())
    text = mujoco_model(replace(HEADED, spatial=arm)).text
    inertial = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1" />'
    text = text.replace('<body name="ground">', f'<body name="ground">{SLIDES}{inertial}', 1)
    model = mujoco.MjModel.from_xml_string(re.sub("<keyframe>.*</keyframe>", "", text, flags=re.DOTALL))
    data, rng, n = mujoco.MjData(model), np.random.default_rng(seed), len(arm.joints)
    q, v, a = rng.normal(size=(3, n))
    pulled = rng.normal(size=3)
    data.qpos[:], data.qvel[:], data.qacc[:] = (
        np.concatenate(pair) for pair in ((np.zeros(3), q), (rng.normal(size=3), v), (pulled, a))
    )
    mujoco.mj_inverse(model, data)
    told = tuple(ArmInput(f"along_{axis}", f"place_{axis}") for axis in "xyz")  # type: ignore[arg-type]
    columns = {f"along_{axis}_acceleration": value for axis, value in zip("xyz", pulled, strict=True)}
    found = WorldArm(replace(arm, inputs=told)).inverse_dynamics(q, v, a, columns)
    assert found == pytest.approx(data.qfrc_inverse[3:], rel=1e-10, abs=1e-10 * np.abs(found).max())
    # the slides carry a body of 1 kg besides
    carried = WorldArm(replace(arm, inputs=told)).base_force(q, v, a, columns)
    wanted = data.qfrc_inverse[:3] - (pulled - np.array(arm.gravity))
    assert carried == pytest.approx(wanted, rel=1e-10, abs=1e-10 * np.abs(wanted).max())
    still = WorldArm(arm).inverse_dynamics(q, v, a, {})
    assert np.abs(found - still).max() > 1e-3 * np.abs(found).max()


def test_a_crane() -> None:
    """Its angle, and with it all that is read, as its own equation has it; seen from the moving trolley by pictures."""
    scene, trolley = parse_scene(CRANE), Sine(0.3, 4.0, 0.1)
    found = simulate(scene, {"trolley": trolley}, 0.5, "numpy")
    inertia = INERTIA + MASS * LENGTH**2

    def slope(time: float, y: np.ndarray) -> np.ndarray:
        pull = GRAVITY * np.sin(y[0]) + trolley.curvature(time) * -np.cos(y[0])
        return np.array([y[1], -MASS * LENGTH * pull / inertia])

    turned = solve_ivp(slope, (0.0, 0.5), [0.0, 0.0], t_eval=found.time, rtol=1e-11, atol=1e-12).y
    sine, cosine = np.sin(turned[0]), np.cos(turned[0])
    x, z = trolley.at(found.time) - LENGTH * sine, -LENGTH * cosine
    along, up = trolley.slope(found.time) - LENGTH * cosine * turned[1], LENGTH * sine * turned[1]
    swinging = np.array([slope(*pair)[1] for pair in zip(found.time, turned.T, strict=True)])
    pulled = trolley.curvature(found.time) + LENGTH * (sine * turned[1] ** 2 - cosine * swinging)
    lifted = LENGTH * (cosine * turned[1] ** 2 + sine * swinging)
    exact = {
        "hold_x": MASS * pulled,
        "hold_z": MASS * (GRAVITY + lifted),
        "load_x": x,
        "load_z": z,
        "speed_x": along,
        "speed_z": up,
        "kinetic": 0.5 * MASS * (along**2 + up**2) + 0.5 * INERTIA * turned[1] ** 2,
        "weight": MASS * GRAVITY * z,
    }
    for column, values in exact.items():
        assert np.abs(found.outputs[column] - values).max() < 2e-5 * np.abs(values).max(), column
    motion = space_motion(found)
    base = motion.points[:, 0]
    assert np.allclose(base[:, 0], trolley.at(motion.time), rtol=0.0, atol=1e-15)
    assert not base[:, 1:].any()
    between = simulate(scene, {"trolley": trolley}, 0.05, "numpy", every=0.0113)
    assert np.abs(between.outputs["load_x"] - np.interp(between.time, found.time, x)).max() < 1e-5


def test_small_motion_of_a_crane() -> None:
    """``(J + m l^2) s^2 + m g l`` times the angle is ``m l s^2`` times the trolley's way; the load goes with both."""
    s = np.array([0.3 + 2.0j, 40.0j])
    read = space_response(rest_in_space(parse_scene(CRANE)), s)
    stiff = (INERTIA + MASS * LENGTH**2) * s**2 + MASS * GRAVITY * LENGTH
    swung = MASS * LENGTH * s**2 / stiff
    assert read["load_x"][:, 0] == pytest.approx(1.0 - LENGTH * swung, rel=1e-12)
    assert read["speed_x"][:, 0] == pytest.approx(s * (1.0 - LENGTH * swung), rel=1e-12)


def test_no_base_jumps() -> None:
    message = "the place along x of the prescribed base jumps from 0 to 0.1 m at t = 0.2 s"
    with pytest.raises(UserError, match=message):
        simulate(parse_scene(CRANE), {"trolley": Step(0.0, 0.1, 0.2)}, 0.5, "numpy")


PLACE = 'name = "trolley"\nat = "base"\nacts = "place_x"'
FAULTS = {
    "clamp": (
        'kind = "prescribed"',
        'kind = "clamp"',
        'has a place along x that is given.*base.kind = "presc',
    ),
    "twice": (
        "[[joint]]",
        f"[[input]]\n{PLACE.replace('trolley', 'b')}\n[[joint]]",
        "the place along x of the base a",
    ),
    "axis": ('kind = "prescribed"', 'kind = "prescribed"\naxis = "x"', "no input says by how much"),
    "pushed": (
        '[[joint]]\nname = "sway"',
        '[[link]]\nname = "post"\non = "base"\nend = [1, 0, 0]\n[[input]]\nname = "f"\nat = "post"\nacts = "force"\n'
        '[[joint]]\nname = "sway"\non = "base"',
        "moves as the base does, whatever acts on it",
    ),
    "held": (
        'at = "base"\nof = "force"',
        'at = "rope"\nof = "force"',
        "cannot be force at 'rope': it is what a base",
    ),
    "read": (
        "[[joint]]",
        '[[output]]\nname = "b"\nat = "base"\nof = "angle"\n[[joint]]',
        "cannot be angle at the base",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults(name: str) -> None:
    old, new, message = FAULTS[name]
    assert old in CRANE
    with pytest.raises(SceneError, match=message):
        parse_scene(CRANE.replace(old, new, 1))
