"""`tmm-gen rest`, `modes`, `frequency` and `stability` of arms in space: tables, JSON, files; and what they refuse."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.situation import resting_in_space
from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import load_scene

ARM = """
name = "boom"
title = "A boom on a yaw motor"
[model]
kind = "spatial"
gravity = [0, 0, {gravity}]
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 1e-4
gear = 20
damping = 0.02
[[motor]]
name = "shoulder"
on = "yaw"
at = [0, 0, 0.2]
axis = "y"
gear = 10
rotor_inertia = 1e-4
damping = 0.02
[[beam]]
name = "boom"
on = "shoulder"
length = 0.6
bending_stiffness = [4.0, 9.0]
torsional_stiffness = 3.0
mass_per_length = 0.3
polar_inertia_per_length = 1e-4
links = 3
damping_time = 1e-3
[[body]]
name = "hand"
on = "boom"
mass = 0.2
center = [0.02, 0, 0]
inertia = [1e-4, 1e-4, 1e-4]
[[input]]
name = "lift"
at = "shoulder"
acts = "torque"
[[input]]
name = "turn"
at = "yaw"
acts = "torque"
[[input]]
name = "push"
at = "hand"
acts = "force"
in = "world"
[[input]]
name = "grip"
at = "hand"
acts = "force"
in = "body"
[[output]]
name = "hand"
at = "hand"
of = "position"
[[output]]
name = "facing"
at = "hand"
of = "orientation"
[[output]]
name = "shoulder"
at = "shoulder"
of = "angle"
[[output]]
name = "energy"
of = "kinetic_energy"
at = "arm"
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Run in an empty folder with an arm that hangs, and the same without weight."""
    monkeypatch.chdir(tmp_path)
    Path("boom.toml").write_text(ARM.format(gravity=-9.81))
    Path("afloat.toml").write_text(ARM.format(gravity=0.0))
    return tmp_path


def told(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main([*words]) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    return shown.out


def facts(*words: str, capsys: pytest.CaptureFixture[str]) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(told(*words, "--json", capsys=capsys))
    return found


def refused(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main([*words]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.count("\n") == 1
    return shown.err


def test_rest(capsys: pytest.CaptureFixture[str]) -> None:
    found = facts("rest", "boom.toml", "--input", "lift=0.03", capsys=capsys)
    assert found["free_joints"] == ["yaw", "shoulder"]
    assert found["joint_names"][:3] == ["yaw", "shoulder", "boom_1_bend_y"]
    rows = found["rows"]
    assert [row["state"] for row in rows] == ["stays anywhere, reached from the start", "falls over"]
    assert [(row["falls"], row["idle"]) for row in rows] == [(0, 1), (1, 1)]
    for row in rows:
        joints = {joint["name"]: joint for joint in row["joints"]}
        assert joints["shoulder"]["torque"] == pytest.approx(0.3, rel=1e-9)
        assert joints["yaw"]["torque"] == 0.0
        assert len(row["angles"]) == len(found["joint_names"]) == 11
        hand = next(frame for frame in row["frames"] if frame["name"] == "hand")
        assert hand["y"] == pytest.approx(0.0, abs=1e-12)
        # the weights' levers about the shoulder take the torque: 0.3 = 9.81 (0.2 x_hand + 0.18 x_boom)
        assert hand["x"] == pytest.approx(-0.3 / (9.81 * (0.2 * 0.62 / 0.6 + 0.18 * 0.5)), rel=2e-2)
    text = told("rest", "boom.toml", capsys=capsys)
    assert "2 equilibria" in text
    assert "yaw, shoulder turn freely: motors hold no torque but that of --input" in text


def test_rest_of_more_joints_than_a_table_holds_leaves_noughts_out(
    capsys: pytest.CaptureFixture[str],
) -> None:
    example = Path(__file__).resolve().parents[2] / "examples" / "space" / "arm6.toml"
    shown = told("rest", str(example), capsys=capsys)
    assert "motor2 angle" in shown.replace("\n", " ")
    assert "gear1" not in shown


def test_modes(capsys: pytest.CaptureFixture[str]) -> None:
    found = facts("modes", "boom.toml", "--count", "20", capsys=capsys)
    rows = found["rows"]
    assert len(rows) == 11
    assert rows[0]["motion"] == "turns freely"
    assert rows[0]["frequency_hz"] == 0.0
    assert [share["what"] for share in rows[0]["shares"] if share["share"] > 0.0] == ["yaw turns"]
    assert all(row["error_bound"] < 1e-9 for row in rows)
    for row in rows:
        assert sum(share["share"] for share in row["shares"]) == pytest.approx(1.0)
    mostly = {row["shares"][0]["what"] for row in rows}
    assert {"boom bends about y", "boom bends about z", "boom twists", "shoulder turns"} <= mostly
    hanging = next(row for row in rows if row["shares"][0]["what"] == "shoulder turns")
    hand = next(frame for frame in hanging["frames"] if frame["name"] == "hand")
    assert abs(hand["moved"][0]) > 0.5
    assert np.max(np.abs(hand["moved"][1:])) < 1e-9
    assert abs(hand["turned"][1]) == pytest.approx(1.0, abs=0.1)
    assert "about the static equilibrium, in degrees: shoulder 90" in told(
        "modes", "boom.toml", capsys=capsys
    )
    afloat = facts("modes", "afloat.toml", capsys=capsys)
    assert [row["motion"] for row in afloat["rows"][:3]] == ["turns freely", "turns freely", "swings"]


def test_frequency(capsys: pytest.CaptureFixture[str]) -> None:
    band = ("--low", "0.3", "--high", "30", "--points", "5")
    found = facts("frequency", "boom.toml", "--from", "push_x", "--to", "hand", *band, capsys=capsys)
    assert found["unit"] == "m per N"
    scene = load_scene(Path("boom.toml"))
    resting = resting_in_space(scene)
    hertz = np.array(found["frequency_hz"])
    exact = space_response(resting.still, 2j * math.pi * hertz)
    number = [item.name for item in scene.inputs].index("push_x")
    for part in found["response"]:
        assert part["magnitude"] == pytest.approx(np.abs(exact[part["component"]][:, number]).tolist())
    assert {part["component"] for part in found["response"]} == {"hand_x", "hand_y", "hand_z"}
    shown = told("frequency", "boom.toml", "--from", "push_x", "--csv", "out.csv", *band, capsys=capsys)
    assert "magnitude x" in shown.replace("\n", " ")
    assert "magnitude y" not in shown.replace("\n", " ")  # across the plane of the arm: nothing but rounding
    rows = list(csv.DictReader(Path("out.csv").read_text().splitlines()))
    assert [float(row["frequency_hz"]) for row in rows] == pytest.approx(hertz)
    assert [float(row["hand_x_real"]) for row in rows] == pytest.approx(exact["hand_x"][:, number].real)


@pytest.mark.parametrize("command", ["rest", "modes", "frequency"])
def test_pictures(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert f"wrote boom-{command}.png" in told(command, "boom.toml", "--plot", capsys=capsys)
    assert Path(f"boom-{command}.png").read_bytes()[:4] == b"\x89PNG"


PENDULUMS = """
name = "pendulums"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 1e-2
[base]
kind = "clamp"
[[joint]]
name = "first"
axis = "y"
damping = 0.01
[[link]]
name = "rod"
on = "first"
mass = 0.5
center = [0, 0, -0.2]
end = [0, 0, -0.4]
inertia = [2e-3, 2e-3, 1e-4]
[[joint]]
name = "second"
on = "rod"
axis = "x"
stiffness = 0.4
[[link]]
name = "bob"
on = "second"
mass = 0.3
end = [0, 0, -0.6]
inertia = [1e-3, 1e-3, 1e-3]
[[input]]
name = "drive"
at = "first"
acts = "torque"
[[input]]
name = "wind"
at = "bob"
acts = "force"
in = "world"
[[output]]
name = "first"
at = "first"
of = "angle"
"""


def test_the_kernel_lets_nothing_accelerate_at_rest(capsys: pytest.CaptureFixture[str]) -> None:
    Path("pendulums.toml").write_text(PENDULUMS)
    given = {"drive": 0.3, "wind_x": -0.4, "wind_y": 0.5}
    words = [word for name, value in given.items() for word in ("--input", f"{name}={value}")]
    angles = facts("rest", "pendulums.toml", *words, capsys=capsys)["rows"][0]["angles"]
    assert min(map(abs, angles)) > 0.02
    module = numpy_module(load_scene(Path("pendulums.toml")))
    for inputs, still in ((given, True), ({}, False)):
        state = module.initialise(module.Params(), module.Input(**inputs), initial_angle=np.array(angles))
        assert bool(np.max(np.abs(state.acceleration)) < 1e-12) is still


def test_stability(capsys: pytest.CaptureFixture[str]) -> None:
    """Weight and a spring hold it; sweeps leave weight to the correction, and the kernel grows as derived."""
    Path("pendulums.toml").write_text(PENDULUMS)
    words = ("stability", "pendulums.toml", "--cells", "3")
    found = facts(*words, "--plot", capsys=capsys)
    for each in found["maps"]:
        assert each["cells_that_differ"] == 0
        assert each["largest_difference"] < 1e-5
        assert np.max(each["measured"]) > 1.5  # at long steps, as sweeps leave weight to one correction
    assert Path("pendulums-stability.png").read_bytes()[:4] == b"\x89PNG"
    modes = facts("modes", "pendulums.toml", capsys=capsys)["rows"]
    assert found["highest_frequency"] == pytest.approx(max(row["angular_frequency"] for row in modes))
    own = next(row for row in found["rows"] if row["own"])
    assert own["verdict"] == "stable"
    coupled = facts(*words[:2], "--set", 'integrator.name="radau2"', "--cells", "2", capsys=capsys)
    assert all(each["cells_that_differ"] == 0 for each in coupled["maps"])
    assert coupled["maps"]
    exact = facts(*words[:2], "--set", 'model.linearisation="newton"', "--cells", "0", capsys=capsys)
    exact_own = next(row for row in exact["rows"] if row["own"])
    assert exact_own["largest_step"] is None  # infinite
    assert 0.1 < own["largest_step"] < 1.0
    explicit = next(row for row in found["rows"] if row["integrator"] == "zhai")
    assert explicit["largest_step"] == pytest.approx(2.0 / found["highest_frequency"], rel=1e-2)


def test_loads_without_an_energy(capsys: pytest.CaptureFixture[str]) -> None:
    for command in ("rest", "modes", "frequency"):
        error = refused(command, "boom.toml", "--input", "grip_z=0.2", capsys=capsys)
        assert "grip_z turns with the arm" in error
    # the remedy works
    told("modes", "boom.toml", "--input", "push_x=0.2", capsys=capsys)
    told("modes", "boom.toml", "--input", "lift=0.02", capsys=capsys)


def test_torque_that_nothing_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert "no static equilibrium" in refused("modes", "boom.toml", "--input", "turn=0.1", capsys=capsys)
    assert "inputs are lift, turn, push_x" in refused("rest", "boom.toml", "--input", "push=1", capsys=capsys)


def test_how_few_links_is_not_asked_of_arms_by_parts(capsys: pytest.CaptureFixture[str]) -> None:
    error = refused("frequency", "boom.toml", "--links-for", "0.01", "--band", "20", capsys=capsys)
    assert "is an arm by parts" in error
