"""Small motion about an equilibrium of one's choice: a double pendulum that hangs and that stands, plane and space."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.near import joint_numbers, start_near
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.modal.undamped import KNOWN
from tmm_gen.scene import load_scene, parse_scene
from tmm_gen.stability.map import Rests
from tmm_gen.stability.motion import small_motion

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "space"
G, MASSES, LENGTHS, INERTIAS = 9.81, (1.2, 0.7), (0.5, 0.4), (0.02, 0.011)
PLANE = """
name = "pendulum"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }
motor = [{ name = "upper" }]
joint = [{ name = "lower", on = "one" }]
link = [
  { name = "one", on = "upper", length = 0.5, mass = 1.2, inertia = 0.02 },
  { name = "two", on = "lower", length = 0.4, mass = 0.7, inertia = 0.011 },
]
input = [{ name = "torque", at = "upper", acts = "torque" }]
output = [{ name = "turned", at = "upper", of = "angle" }]
"""
SPACE = """
name = "pendulum"
model = { kind = "spatial", gravity = [0, -9.81, 0] }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }
motor = [{ name = "upper", axis = "z" }]
joint = [{ name = "lower", on = "one", axis = "z" }]
link = [
  { name = "one", on = "upper", end = [0.5, 0, 0], center = [0.25, 0, 0], mass = 1.2, inertia = [0.02, 0.02, 0.02] },
  { name = "two", on = "lower", end = [0.4, 0, 0], center = [0.2, 0, 0], mass = 0.7, inertia = [0.01, 0.01, 0.011] },
]
input = [{ name = "torque", at = "upper", acts = "torque" }]
output = [{ name = "turned", at = "upper", of = "angle" }]
"""
KINDS = pytest.mark.parametrize("text", [PLANE, SPACE], ids=["plane", "space"])


def squares(*ways: float) -> np.ndarray:
    """Return the squared frequencies of the pendulum about links that hang (1) or stand (-1), in absolute angles."""
    (m, n), (a, b), (i, j) = MASSES, LENGTHS, INERTIAS
    coupled = n * a * b / 2.0 * ways[0] * ways[1]
    mass = [[i + m * a * a / 4.0 + n * a * a, coupled], [coupled, j + n * b * b / 4.0]]
    weight = np.diag([m * a / 2.0 + n * a, n * b / 2.0]) * G * np.array(ways)[:, None]
    return np.asarray(eigh(weight, mass, eigvals_only=True))


@KINDS
@pytest.mark.parametrize(
    ("near", "ways"),
    [((-1.3, 0.2), (1.0, 1.0)), ((1.4, 0.3), (-1.0, -1.0)), ((1.6, 3.0), (-1.0, 1.0))],
    ids=["hangs", "stands", "folded"],
)
def test_modes_about_each_equilibrium_are_the_closed_form(
    text: str,
    near: tuple[float, float],
    ways: tuple[float, float],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    scene = tmp_path / "pendulum.toml"
    scene.write_text(text)
    words = ["--near", f"upper={near[0]}", "--near", f"lower={near[1]}"]
    assert main(["modes", str(scene), *words, "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    found = [
        row["angular_frequency"] ** 2 if row["motion"] == "swings" else -(row["poles"][0]["real"] ** 2)
        for row in rows
    ]
    assert found == pytest.approx(squares(*ways), rel=1e-11)
    assert [row["motion"] for row in rows].count("falls over") == sum(way < 0.0 for way in ways)


@KINDS
def test_the_response_is_that_about_the_one_that_is_chosen(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A steady torque turns the upper link by itself; one that stands turns against it."""
    scene = tmp_path / "pendulum.toml"
    scene.write_text(text)
    held = G * (MASSES[0] * LENGTHS[0] / 2.0 + MASSES[1] * LENGTHS[0])
    for near, phase in ((-1.5, 0.0), (1.5, 180.0)):
        words = ["--near", f"upper={near}", "--low", "1e-6", "--high", "1e-5", "--points", "2", "--json"]
        assert main(["frequency", str(scene), *words]) == 0
        (answer,) = json.loads(capsys.readouterr().out)["response"]
        assert answer["magnitude"][0] == pytest.approx(1.0 / held, rel=1e-9)
        assert abs(answer["phase_deg"][0]) == pytest.approx(phase, abs=1e-6)


@KINDS
def test_rest_tells_it_first_and_stability_judges_it(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "pendulum.toml"
    path.write_text(text)
    assert main(["rest", str(path), "--near", "upper=1.5", "--near", "lower=0.1", "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)["rows"]
    assert len(shown) == 4
    assert [row["state"] for row in shown].count("stable") == 1
    assert shown[0]["state"] == "falls over, reached from --near"
    assert (shown[0]["from_near"], shown[0]["from_start"], shown[0]["falls"]) == (True, False, 2)
    scene = parse_scene(text)
    start = start_near(scene, {"upper": 1.5, "lower": 0.1})
    assert start == pytest.approx([1.5, 1.6 if scene.spatial is None else 0.1])
    motion = small_motion(scene, start)
    assert motion.falling
    assert Rests(scene, motion.start).angles(1.0)[0] == pytest.approx(np.pi / 2.0)
    assert not small_motion(scene).falling


@pytest.mark.parametrize("command", ["modes", "frequency", "stability", "rest"])
def test_a_joint_that_is_not_there_is_one_line(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "pendulum.toml"
    scene.write_text(PLANE)
    for word, said in (
        ("wrist=1", "scene 'pendulum': has no joint 'wrist'; there are upper, lower."),
        ("upper=up", "--near upper=up: write JOINT=ANGLE, the angle in rad"),
        ("upper", "--near upper: write JOINT=ANGLE"),
        ("upper=inf", "the angle in rad, at most 1000"),
        ("upper=-1e300", "the angle in rad, at most 1000"),
    ):
        assert main([command, str(scene), "--near", word]) == 2
        error = capsys.readouterr().err
        assert said in error
        assert error.count("\n") == 1


@KINDS
def test_where_none_is_found_smaller_inputs_are_the_remedy(
    text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "pendulum.toml"
    scene.write_text(text)
    assert main(["modes", str(scene), "--near", "upper=1", "--input", "torque=9"]) == 2
    error = capsys.readouterr().err
    assert "no static equilibrium found near the angles of --near; try smaller values of --input" in error
    assert main(["modes", str(scene), "--near", "upper=1", "--input", "torque=5"]) == 0


def test_a_motion_that_only_a_damper_holds_is_known_well() -> None:
    """A yaw below an arm that stands: it bends no spring, so that the rounding of its bends says nothing."""
    scene = load_scene(EXAMPLES / "yaw3.toml")
    linear = resting_in_space(scene, start=start_near(scene, {"shoulder": -1.5, "elbow": 0.1})).linear
    modes = find_modes(linear, 3)
    (yaw,) = [mode for mode in modes if 0.0 in mode.poles]
    assert yaw.poles[1].real < -1.0
    assert yaw.bound < 1e-12
    assert max(mode.bound for mode in modes) < KNOWN, (
        "of the others the search asks no more, and rounding decides"
    )


def test_names_are_those_that_rest_shows() -> None:
    scene = parse_scene(PLANE)
    assert joint_numbers(scene) == {"upper": 1, "lower": 2}
    elastic = parse_scene(
        PLANE.replace('name = "upper" }', 'name = "upper", rotor_inertia = 1e-4, stiffness = 50.0 }')
    )
    start = start_near(elastic, {"upper": 0.5})  # shaft and link turn along
    assert start == pytest.approx([0.5, 0.5, 0.5])
    with pytest.raises(UserError, match="has no joint 'joint 2'"):
        start_near(elastic, {"joint 2": 0.5})
