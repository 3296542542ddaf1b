"""What a scene offers once it is read."""

from __future__ import annotations

import dataclasses
import itertools
import pickle
import subprocess
import sys
from pathlib import Path

import pydantic
import pytest

from tmm_gen.scene import Budget, Input, Joint, Link, Output, load_scene, parse_scene, station_of


def test_chain(chain: str) -> None:
    scene = parse_scene(chain)
    assert (scene.name, scene.title, scene.stations) == ("arm", "An arm", 2)
    assert (scene.model.kind, scene.model.gravity) == ("chain", None)
    assert (scene.model.sweep, scene.model.unknown) == ("riccati", "acceleration")
    assert (scene.integrator.name, scene.integrator.step) == ("newmark", 0.01)
    assert scene.integrator.parameters == {"beta": 0.25}
    assert (scene.base.kind, scene.base.inertia, scene.base.damping) == ("clamp", 0.0, 0.0)
    assert scene.joints == (Joint(stiffness=20.0, damping=0.5), Joint(stiffness=10.0, damping=0.0))
    assert [link.inertia for link in scene.links] == [1.0, 2.0]
    assert scene.inputs == (Input(name="tip_torque", at="tip", acts="torque"),)
    assert scene.outputs == (Output(name="tip", at="tip", of="angle"),)
    assert (scene.initial.angles, scene.initial.rates) == ((0.0, 0.0), (0.0, 0.0))
    assert (scene.emit.backends, scene.emit.real) == (("numpy", "c", "casadi"), "float64")
    assert (scene.beam, scene.tip, scene.emit.budget, scene.emit.box, scene.control) == (None,) * 5


def test_planar(planar: str) -> None:
    scene = parse_scene(planar)
    assert (scene.title, scene.stations) == ("arm", 5)
    assert (scene.model.gravity, scene.model.linearisation, scene.model.iterations) == (
        9.81,
        "newton",
        "auto",
    )
    assert scene.beam is not None
    assert scene.tip is not None
    assert (scene.beam.springs, scene.tip.mass, scene.tip.inertia) == ("clamped-segment", 0.1, 0.0)


def test_planar_links_written_out(planar: str) -> None:
    start, end = planar.index("[beam]"), planar.index("[tip]")
    stations = """
    [[joint]]
    stiffness = 5
    [[link]]
    inertia = 0.1
    mass = 2
    length = 0.5
    center = 0.25
    """
    scene = parse_scene(planar[:start] + stations + planar[end:])
    assert scene.joints == (Joint(stiffness=5.0, damping=0.0),)
    assert scene.links == (Link(inertia=0.1, mass=2.0, length=0.5, center=0.25),)


def test_repeat_makes_identical_copies(chain: str) -> None:
    text = chain.replace("damping = 0.5", "damping = 0.5\nrepeat = 3").replace("= 2.0", "= 2.0\nrepeat = 3")
    scene = parse_scene(text)
    assert [joint.stiffness for joint in scene.joints] == [20.0, 20.0, 20.0, 10.0]
    assert [link.inertia for link in scene.links] == [1.0, 2.0, 2.0, 2.0]


def test_inline_arrays_are_as_good_as_headers(chain: str) -> None:
    start, end = chain.index("[[joint]]"), chain.index("[[input]]")
    inline = (
        "joint = [{stiffness = 20, damping = 0.5}, {stiffness = 10}]\nlink = [{inertia = 1}, {inertia = 2}]\n"
    )
    assert parse_scene(inline + chain[:start] + chain[end:]) == parse_scene(chain)


@pytest.mark.parametrize(
    ("angles", "expected"), [("0.5", (0.5, 0.5)), ("2", (2.0, 2.0)), ("[0.1, -1]", (0.1, -1.0))]
)
def test_initial_motion(chain: str, angles: str, expected: tuple[float, ...]) -> None:
    initial = parse_scene(f"{chain}\n[initial]\nangles = {angles}\nrates = {angles}").initial
    assert initial.angles == expected
    assert initial.rates == expected


def test_emission(chain: str) -> None:
    emit = parse_scene(
        chain + '[emit]\nbackends = ["c", "numpy"]\nreal = "float32"\n'
        "[emit.budget]\ninstructions = 700\nflash = 900\n"
        "[emit.box]\ntip_torque = [-1, 1]\nangles = [-3.0, 3.0]\nstep = [1e-4, 1e-2]\n"
    ).emit
    assert (emit.backends, emit.real) == (("numpy", "c"), "float32")
    assert emit.budget == Budget(instructions=700, flash=900)
    assert emit.box == {"tip_torque": (-1.0, 1.0), "angles": (-3.0, 3.0), "step": (1e-4, 1e-2)}


def test_control_has_defaults(planar: str) -> None:
    table = "[control]\nreference = 1\n[control.bounds]\ntorque = 3\nhub = [-0.1, 1.02]\n"
    control = parse_scene(planar + table).control
    assert control is not None
    assert (control.reference, control.horizon, control.sample_time) == (1.0, 30, 0.02)
    assert (control.bounds.torque, control.bounds.hub, control.bounds.overshoot) == (
        (-3.0, 3.0),
        (-0.1, 1.02),
        None,
    )
    assert control.sensors.accelerometer is None


@pytest.mark.parametrize(
    ("at", "of"),
    [
        *itertools.product(['"base"', '"tip"', "1", "2"], ["angle", "velocity", "acceleration"]),
        *itertools.product(['"base"', "1", "2"], ["torque"]),  # the free end carries none
    ],
)
def test_outputs_of_a_chain_with_a_hub(chain: str, at: str, of: str) -> None:
    text = chain.replace('"clamp"', '"motor"\ninertia = 1').replace(
        'at = "tip"\nof = "angle"', f'at = {at}\nof = "{of}"'
    )
    assert parse_scene(text).outputs[0].of == of


@pytest.mark.parametrize("of", ["position", "angle", "velocity", "acceleration", "torque", "force"])
def test_outputs_of_a_planar_tip_with_a_mass(planar: str, of: str) -> None:
    assert parse_scene(planar.replace('"position"', f'"{of}"')).outputs[0].of == of


def test_prescribed_base(chain: str) -> None:
    text = (
        chain.replace('"clamp"', '"prescribed"') + '[[input]]\nname = "base"\nat = "base"\nacts = "angle"\n'
    )
    assert parse_scene(text).inputs[1].acts == "angle"


def test_places_by_number() -> None:
    assert [station_of(at, 7) for at in ("base", 1, 7, "tip")] == [0, 1, 7, 7]


def test_nothing_can_be_assigned(planar: str) -> None:
    scene = parse_scene(planar)
    with pytest.raises(dataclasses.FrozenInstanceError):
        scene.name = "other"  # type: ignore[misc]
    with pytest.raises(pydantic.ValidationError):
        scene.joints[0].stiffness = 1.0  # type: ignore[misc]
    with pytest.raises(pydantic.ValidationError):
        scene.base.inertia = 1.0  # type: ignore[misc]


def test_scenes_are_hashable_and_survive_pickling(planar: str) -> None:
    scene = parse_scene(planar)
    again = pickle.loads(pickle.dumps(scene))
    assert {scene: 1}[again] == 1
    assert again.joints == scene.joints
    assert scene != planar


def test_example_scenes(repository: Path) -> None:
    scenes = {path.stem: load_scene(path) for path in sorted((repository / "scenes").glob("*.toml"))}
    assert {"thesis2", "thesis10", "drivetrain", "hundred"} <= set(scenes)
    assert all(scene.name == stem for stem, scene in scenes.items())
    thesis2, thesis10 = scenes["thesis2"], scenes["thesis10"]
    # Gholampour (2018), tables 3-2 and 4-1.
    assert thesis2.joints == (Joint(stiffness=20.0, damping=5.0),) * 2
    assert [link.inertia for link in thesis2.links] == [5.0, 5.0]
    assert thesis10.joints == (Joint(stiffness=20.0, damping=5.0),) * 10
    assert [link.inertia for link in thesis10.links] == [1.0] * 10
    assert scenes["hundred"].stations == 100
    assert len(set(scenes["drivetrain"].joints)) == scenes["drivetrain"].stations


def test_reading_a_scene_loads_no_numerical_package(repository: Path) -> None:
    code = (
        "import sys; from tmm_gen.scene import load_scene; load_scene(sys.argv[1]);"
        "heavy = {'numpy', 'sympy', 'scipy', 'casadi', 'matplotlib', 'jinja2'} & set(sys.modules);"
        "sys.exit(', '.join(heavy) or None)"
    )
    scene = repository / "scenes" / "thesis2.toml"
    done = subprocess.run(
        [sys.executable, "-c", code, str(scene)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
