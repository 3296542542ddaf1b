"""What a unit refuses, with an error status: its motion is then what it was, and never not a number."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from tmm_gen.export.fmu import FmiVersion

pytestmark = [
    pytest.mark.compiler,
    pytest.mark.xdist_group("fmu"),  # units are exported once
    pytest.mark.parametrize("version", [2, 3]),
]

ERROR = 3
BAD = [np.nan, np.inf, -np.inf]


def refused(call: Any, *arguments: Any) -> None:
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == ERROR


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("name", ["thesis10", "arm10"])
def test_an_input_that_is_no_number(
    bad: float, name: str, version: FmiVersion, scene_named: Any, instance: Any
) -> None:
    scene = scene_named(name)
    disturbed, other = instance(scene, version), instance(scene, version)
    load, step = scene.inputs[-1].name, scene.integrator.step
    for unit in (disturbed, other):
        unit.begin()
        unit.set(load, 0.1)
        unit.step(0.0, 3 * step)
    before = disturbed.state()
    refused(disturbed.set, load, bad)
    assert "not a number" in disturbed.logged[-1]
    refused(
        disturbed.step, 3 * step, step
    )  # an importer that does not look at the first status meets a second
    assert "not a number" in disturbed.logged[-1]
    assert disturbed.state() == before
    assert np.isfinite([*disturbed.outputs().values()]).all()
    for unit in (disturbed, other):
        unit.set(load, 0.2)
        unit.step(3 * step, 2 * step)
    assert disturbed.state() == other.state()


def test_a_number_too_large_for_single_precision(
    version: FmiVersion, scene_named: Any, instance: Any
) -> None:
    unit = instance(scene_named("thesis2").replace(**{"emit.real": "float32"}), version)
    unit.begin()
    refused(unit.set, "tip_torque", 1e39)
    refused(unit.step, 0.0, 0.01)
    assert unit.state()["state.angle"] == [0.0, 0.0]


def test_motion_that_outgrows_the_number_type(version: FmiVersion, scene_named: Any, instance: Any) -> None:
    unit = instance(scene_named("thesis2").replace(**{"emit.real": "float32"}), version)
    unit.begin(tip_torque=1.0, parameters__inertia=1e-3)
    unit.step(0.0, 0.01)
    before = unit.state()
    unit.set("tip_torque", 3e38)
    refused(unit.step, 0.01, 0.05)
    assert "outgrown" in unit.logged[-1]
    assert unit.state() == before
    assert unit.get("time") == 0.01


@pytest.mark.parametrize("bad", [*BAD, -1e3])
def test_parameters_that_no_arm_has(bad: float, version: FmiVersion, scene_named: Any, instance: Any) -> None:
    unit = instance(scene_named("thesis10"), version)
    refused(lambda: unit.begin(parameters__inertia=bad))
    refused(unit.unit.exitInitializationMode)
    assert ("no passive arm" if np.isfinite(bad) else "not a number") in unit.logged[-1]
    unit.set("parameters.inertia", 2.0)
    unit.unit.exitInitializationMode()
    unit.step(0.0, 0.01)
    assert np.isfinite(unit.outputs()["tip"])


@pytest.mark.parametrize("size", [0.0, -0.01, 0.005, 0.015, 0.0100001, np.nan, np.inf])
def test_steps_that_are_no_multiples(
    size: float, version: FmiVersion, scene_named: Any, instance: Any
) -> None:
    unit = instance(scene_named("thesis10"), version)
    unit.begin(tip_torque=1.0)
    refused(unit.step, 0.0, size)
    assert "multiple of the internal step 0.01 s" in unit.logged[-1]
    assert unit.get("time") == 0.0
    assert unit.outputs()["tip"] == 0.0


@pytest.mark.parametrize("time", [0.01, -0.01, np.nan])
def test_a_point_in_time_where_the_unit_is_not(
    time: float, version: FmiVersion, scene_named: Any, instance: Any
) -> None:
    unit = instance(scene_named("thesis10"), version)
    unit.begin(tip_torque=1.0)
    refused(unit.step, time, 0.01)
    assert "communication point" in unit.logged[-1]


def test_what_comes_too_early_or_too_late(version: FmiVersion, scene_named: Any, instance: Any) -> None:
    unit = instance(scene_named("thesis10"), version)
    refused(unit.step, 0.0, 0.01)
    unit.begin()
    refused(unit.set, "parameters.inertia", 2.0)
    refused(unit.set, "tip", 2.0)
    refused(unit.set, "time", 2.0)
    unit.unit.terminate()
    refused(unit.step, 0.0, 0.01)
    unit.unit.reset()
    unit.begin(parameters__inertia=2.0)
    unit.step(0.0, 0.01)


def test_a_unit_of_another_token(version: FmiVersion, scene_named: Any, instance: Any) -> None:
    unit = instance(scene_named("thesis10"), version)
    unit.description.guid = unit.description.instantiationToken = "{something else}"
    with pytest.raises(Exception, match="instantiate"):
        unit._make()
    assert any("model description" in line for line in unit.logged)


def test_variables_that_are_not_there(version: FmiVersion, scene_named: Any, instance: Any) -> None:
    unit = instance(scene_named("thesis10"), version)
    unit.begin()
    get = unit.unit.getFloat64 if version == 3 else unit.unit.getReal
    refused(get, [10_000])
    refused(unit.unit.getInt32 if version == 3 else unit.unit.getInteger, [1])
