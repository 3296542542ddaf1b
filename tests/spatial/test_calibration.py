"""Numbers of an arm in space are found from a record that other equations have made.

The record is of the reference: geometric Jacobians in world axes, integrated by collocation to eleven digits.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.calibration.calibrate import calibrate
from tmm_gen.calibration.fit import parameters_of
from tmm_gen.calibration.fitted_keys import default_keys, number_of
from tmm_gen.cli import main
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import CheckFailed, UserError
from tmm_gen.inputs.signals import Signal, Table
from tmm_gen.program.space.layout import layout_of
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene, parse_scene

ARM = """
name = "reacher"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 5e-4
[base]
kind = "clamp"
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 2e-5
gear = 30
damping = 0.1
[[body]]
name = "turret"
on = "yaw"
mass = 1.2
inertia = [2e-3, 2e-3, 1.5e-3]
[[motor]]
name = "shoulder"
on = "turret"
axis = "y"
rotor_inertia = 2e-5
gear = 30
damping = 0.1
[[beam]]
name = "forearm"
on = "shoulder"
length = 0.4
bending_stiffness = [20.0, 7.5]   # EI about y and about z
mass_per_length = 0.2
links = 2
damping_time = 5e-3
[[body]]
name = "payload"
on = "forearm"
mass = 0.5
center = [0.03, 0.02, 0]
inertia = [3e-4, 4e-4, 4e-4]
[[input]]
name = "yaw_torque"
at = "yaw"
acts = "torque"
[[input]]
name = "shoulder_torque"
at = "shoulder"
acts = "torque"
[[output]]
name = "payload"
at = "payload"
of = "position"
[[output]]
name = "yaw"
at = "yaw"
of = "angle"
[[output]]
name = "shoulder"
at = "shoulder"
of = "angle"
[initial]
angles = { shoulder = -0.3 }
"""

TRUTH = {
    "beam.forearm.bending_stiffness.1": 15.0,
    "beam.forearm.bending_stiffness.2": 5.0,
    "beam.forearm.damping_time": 8e-3,
    "motor.yaw.damping": 0.14,
    "motor.shoulder.damping": 0.08,
    "body.payload.mass": 0.7,
    "motor.yaw.rotor_inertia": 3e-5,
    "motor.shoulder.rotor_inertia": 1.5e-5,
}

CLOSE = 2e-3
"""Of what is found: Newmark errs by so much at this step, and that is fitted too."""


@pytest.fixture(scope="module")
def scene() -> Scene:
    return parse_scene(ARM, "reacher.toml")


@pytest.fixture(scope="module")
def record(scene: Scene) -> dict[str, Signal]:
    """What an arm like it does, softer and with more at its tip, when its motors push to and fro."""
    knots = np.linspace(0.0, 0.4, 9)
    draw = np.random.default_rng(17)
    acting: dict[str, Signal] = {
        "yaw_torque": Table(knots, draw.uniform(-0.3, 0.3, 9)),
        "shoulder_torque": Table(knots, draw.uniform(-0.3, 0.1, 9)),
    }
    times = np.linspace(0.0, 0.4, 201)
    made = scene.replace(**TRUTH)
    assert made.spatial is not None
    inputs = {name: signal.at(times) for name, signal in acting.items()}
    found = outputs(made.spatial, *motion(made.spatial, acting, times, 1e-9), inputs)
    return {**acting, **{name: Table(times, values) for name, values in found.items()}}


def _written(path: Path, record: dict[str, Signal]) -> NDArray[np.float64]:
    times = np.linspace(0.0, 0.4, 201)
    rows = np.column_stack([times, *(signal.at(times) for signal in record.values())])
    np.savetxt(path, rows, delimiter=",", header=",".join(["time", *record]), comments="", fmt="%.17g")
    return rows


@pytest.mark.compiler
def test_stiffness_damping_payload_and_rotors_are_found_and_written(
    record: dict[str, Signal],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Of two motors at once, by the command; numbers of a list each by itself, comments as they were."""
    monkeypatch.chdir(tmp_path)
    Path("reacher.toml").write_text(ARM)
    _written(Path("record.csv"), record)
    words = [word for key in TRUTH for word in ("--fit", key)]
    assert main(["calibrate", "reacher.toml", "record.csv", *words, "--out", "fitted.toml"]) == 0
    assert re.search(r"what is left: 0\.0\d+ % of the record's", capsys.readouterr().out)
    fitted = load_scene(Path("fitted.toml"))
    for key, value in TRUTH.items():
        assert number_of(fitted, key) == pytest.approx(value, rel=CLOSE), key
    assert "] # EI about y and about z" in Path("fitted.toml").read_text()


@pytest.mark.compiler
def test_combinations_that_a_record_cannot_tell_are_named(scene: Scene, record: dict[str, Signal]) -> None:
    """Rotor and turret turn as one about the yaw: their shares of a percent are told, and are right."""
    turret, rotor = "body.turret.inertia.3", "motor.yaw.rotor_inertia"
    known = scene.replace(**TRUTH)
    with pytest.raises(UserError, match="does not tell") as caught:
        calibrate(known, record, [turret, rotor, "body.turret.mass"])
    said = str(caught.value)
    share = 1.5e-3 / (30.0**2 * TRUTH[rotor])
    (less,) = re.findall(
        rf"1 % more of {turret} and (\S+) % less of {rotor} together leave the record as it is", said
    )
    assert float(less) == pytest.approx(share, rel=1e-3)
    assert "Nothing recorded depends on body.turret.mass" in said
    (kept,) = re.findall(r"--fit ([\w.]+)", said)
    assert kept in (turret, rotor)


@pytest.mark.compiler
@pytest.mark.parametrize(("aside", "said"), [(0.0, "Nothing recorded depends on"), (0.02, "does not follow")])
def test_torques_that_are_not_recorded_are_told(
    scene: Scene, record: dict[str, Signal], aside: float, said: str
) -> None:
    """The arm falls without them; its yaw stands still where the payload is not held beside the plane of the fall."""
    falling = scene.replace(**{"body.payload.center": [0.03, aside, 0.0]})
    without = {name: signal for name, signal in record.items() if not name.endswith("torque")}
    left_out = r".*has no column yaw_torque or shoulder_torque\. .*--input yaw_torque=1\.$"
    with pytest.raises((UserError, CheckFailed), match=said + left_out):
        calibrate(falling, without, ["motor.yaw.damping", "body.payload.mass"])


def test_what_is_fitted_unless_told_otherwise(scene: Scene) -> None:
    keys = list(TRUTH)
    assert set(default_keys(scene)) == set(keys[:5])
    twisting = load_scene(scenes_dir().parent / "examples" / "space" / "helix.toml")
    assert default_keys(twisting) == (
        "beam.rod.material.young",
        "beam.rod.material.shear",
        "beam.rod.damping_time",
    )


@pytest.mark.parametrize(
    "key",
    ["beam.forearm.length", "motor.shoulder.at", "beam.forearm.bending_stiffness", "integrator.step"],
)
def test_keys_that_are_none_are_refused_with_some_that_are(scene: Scene, key: str) -> None:
    built = scene.replace(**{"motor.shoulder.at": [0.0, 0.0, 0.08]})
    with pytest.raises(UserError, match=r"Fit one of ") as caught:
        number_of(built, f"{key}.3" if key.endswith("at") else key)
    for each in re.findall(r"[\w.]*\w", str(caught.value).partition("Fit one of ")[2]):
        assert number_of(built, each) > 0.0


@pytest.mark.parametrize("name", ["yaw3", "arm6", "helix", "satellite"])
def test_every_parameter_of_a_kernel_follows_the_scene(name: str) -> None:
    """What a fit hands to the kernel is what a kernel of that scene has by itself, and all else of it stays."""
    scene = load_scene(scenes_dir().parent / "examples" / "space" / f"{name}.toml")
    changed = scene.replace(**{key: 1.1 * number_of(scene, key) for key in default_keys(scene)})
    for each in (scene, changed):
        arm, known = each.spatial, parameters_of(each)
        assert arm is not None
        layout = layout_of(arm, name, name, integrator("newmark"), 1e-3)
        own = [*layout.parameters.values(), *(layout.base.parameters.values() if layout.base else ())]
        assert own
        for variable in own:
            values = np.ravel(known[variable.name])
            assert np.array_equal(values if variable.length else values[:1], np.ravel(variable.default))
    before, after = scene.spatial, changed.spatial
    assert before is not None
    assert after is not None
    assert after != before
    springs = [replace(j, stiffness=0.0, damping=0.0) for j in before.joints]
    assert [replace(j, stiffness=0.0, damping=0.0) for j in after.joints] == springs
    assert after.frames == before.frames
