"""Units of arms in space: the very bits of the kernel, quaternions among them, and motions that are right."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from support.spatial.boom import BOOM
from support.spatial.moving import AFLOAT, TABLE

from tmm_gen.cli import main
from tmm_gen.export.fmu import FmiVersion
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.spatial_reference import spatial_response
from tmm_gen.scene import Scene, parse_scene

pytestmark = [pytest.mark.compiler, pytest.mark.xdist_group("fmu")]  # units are exported once

BATHE = BOOM.replace("newmark", "bathe")
STEP = 5e-4
INPUTS = ("torque", "push_x", "push_y", "push_z")
LEFT = {"torque": 0.02, "push_x": 0.4, "push_y": 0.0, "push_z": -0.7}
"""Loads as they are left alone; the torque acts fifty-fold."""


@pytest.fixture(scope="module")
def boom() -> Scene:
    """A motor and a beam that bends both ways and twists: two stages a step."""
    return parse_scene(BATHE)


@pytest.mark.parametrize("version", [2, 3])
def test_no_bit_differs_from_the_kernel(version: FmiVersion, boom: Scene, instance: Any, direct: Any) -> None:
    unit, kernel = instance(boom, version), direct(boom)
    kernel.prepare()
    kernel.initialise(LEFT)
    unit.begin(**LEFT)
    first = unit.outputs()
    assert set(first) == {"yaw", *(f"hand_{k}" for k in "xyz"), *(f"facing_{k}" for k in "wxyz")}
    for k in range(30):
        acting = {name: value * np.cos(0.2 * (k + j)) for j, (name, value) in enumerate(LEFT.items())}
        for name, value in acting.items():
            unit.set(name, value)
        unit.step(STEP * k, STEP)
        kernel.step(acting)
        assert unit.outputs() == kernel.output()
        np.testing.assert_array_equal(unit.get("state.angle"), kernel.state["angle"])
    assert all(first[name] != value for name, value in unit.outputs().items())


CARRIED = TABLE.replace("input = [", 'input = [{ name = "along", at = "base", acts = "place_x" }, ')


@pytest.mark.parametrize("text", [AFLOAT, CARRIED], ids=["floats", "turned and carried"])
def test_a_unit_on_a_base_that_moves_is_its_kernel(text: str, instance: Any, direct: Any) -> None:
    """But for the rounding of what a base is told, which units follow between the instants at which it is set."""
    scene = parse_scene(text)
    unit, kernel = instance(scene, 3), direct(scene)
    given = {"push_x": 0.3, "push_y": -0.2, "push_z": 0.4}
    if scene.prescribed is not None:
        given |= {"table": 0.1, "table_rate": 0.5, "table_acceleration": -0.3}
        given |= {"along": -0.2, "along_rate": 0.4, "along_acceleration": 0.7}
    kernel.prepare()
    kernel.initialise(given)
    unit.begin(**given)
    step = scene.integrator.step
    for k in range(5):
        given = {name: 1.1 * value for name, value in given.items()}
        for name, value in given.items():
            unit.set(name, value)
        unit.step(step * k, step)
        kernel.step(given)
        assert unit.outputs() == pytest.approx(kernel.output(), rel=1e-13, abs=1e-14)
        assert scene.prescribed is not None or unit.outputs() == kernel.output()


def test_a_unit_moves_as_the_reference(boom: Scene, unit_of: Any) -> None:
    """Places and turns of the hand under loads that are left alone, by other equations in world axes."""
    result = fmpy.simulate_fmu(str(unit_of(boom, 3)), stop_time=0.05, start_values=LEFT)
    assert boom.spatial is not None
    exact = spatial_response(
        boom.spatial,
        {name: Constant(value) for name, value in LEFT.items()},
        np.asarray(result["time"]),
    )
    for name, values in exact.items():
        travelled = np.ptp(values)
        assert travelled > 1e-3
        np.testing.assert_allclose(result[name], values, rtol=0, atol=2e-4 * travelled)


def test_parameters_and_start_can_be_set(boom: Scene, instance: Any, direct: Any) -> None:
    kernel = direct(boom)
    names = {v.name: v for v in kernel.program.parameters}
    joints = names["stiffness"].length
    assert joints is not None
    stiffness, angles = np.linspace(200.0, 100.0, joints), np.linspace(0.0, 0.05, joints)
    kernel.prepare({"stiffness": stiffness})
    kernel.initialise(initial_angle=angles)
    for _ in range(5):
        kernel.step({})
    for version in (2, 3):
        unit = instance(boom, version)
        assert unit.get("parameters.torque_gear") == 50.0
        unit.begin(parameters__stiffness=stiffness, initial__angle=angles)
        unit.step(0.0, 5 * STEP)
        assert unit.outputs() == kernel.output()


def test_single_precision(boom: Scene, instance: Any, direct: Any) -> None:
    scene = boom.replace(**{"emit.real": "float32"})
    unit, kernel = instance(scene, 2), direct(scene)
    unit.begin(torque=0.02)
    kernel.prepare()
    kernel.initialise({"torque": 0.02})
    for k in range(6):
        unit.step(STEP * k, STEP)
        kernel.step({"torque": 0.02})
        assert unit.outputs() == kernel.output()


def test_the_command_writes_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("boom.toml").write_text(BOOM)
    assert main(["export", "boom.toml", "--to", "fmu", "--fmi", "3"]) == 0
    assert "wrote boom.fmu: FMI 3.0" in capsys.readouterr().out
    described = fmpy.read_model_description("boom.fmu")
    assert [v.name for v in described.modelVariables if v.causality == "input"] == list(INPUTS)
