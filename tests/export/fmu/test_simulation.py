"""Units simulated by FMPy give the very bits of the kernel called directly, and the NumPy kernel's to rounding."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

from tmm_gen.export.fmu import FmiVersion
from tmm_gen.inputs.waveforms import Smooth
from tmm_gen.native import NativeKernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import Scene

pytestmark = [pytest.mark.compiler, pytest.mark.xdist_group("fmu")]  # units are exported once

STEPS = 400
VERSIONS: tuple[FmiVersion, ...] = (2, 3)


def signals(scene: Scene, steps: int) -> np.ndarray:
    """Return inputs over time as FMPy takes them, something else for each and nothing that starts at zero."""
    times = scene.integrator.step * np.arange(steps + 1)
    names = [item.name for item in scene.inputs]
    table = np.zeros(len(times), dtype=[("time", float), *((name, float) for name in names)])
    table["time"] = times
    for k, name in enumerate(names):
        table[name] = np.cos((1.0 + k) * times) + 0.3 * k
    return table


def held(kernel: NativeKernel, table: np.ndarray) -> dict[str, np.ndarray]:
    """Return the outputs of a kernel that holds each input over the step that begins with it."""
    rows = [{name: float(row[name]) for name in table.dtype.names[1:]} for row in table]
    kernel.prepare()
    kernel.initialise(rows[0])
    found = [kernel.output()]
    for row in rows[:-1]:
        kernel.step(row)
        found.append(kernel.output())
    return {name: np.array([row[name] for row in found]) for name in found[0]}


def simulated(path: Path, table: np.ndarray, every: float) -> Any:
    return fmpy.simulate_fmu(
        str(path), stop_time=float(table["time"][-1]), output_interval=every, input=table, validate=True
    )


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["thesis10", "arm10"])
def test_no_bit_differs_from_the_kernel(
    name: str, version: FmiVersion, scene_named: Any, unit_of: Any, direct: Any
) -> None:
    scene = scene_named(name)
    table = signals(scene, STEPS)
    result = simulated(unit_of(scene, version), table, scene.integrator.step)
    expected = held(direct(scene), table)
    assert len(result) == STEPS + 1
    for column, values in expected.items():
        np.testing.assert_array_equal(result[column], values, err_msg=column)
        assert np.ptp(values) > 0.0


@pytest.mark.parametrize("name", ["thesis10", "arm10"])
def test_the_numpy_kernel_agrees_to_rounding(name: str, scene_named: Any, unit_of: Any) -> None:
    scene = scene_named(name)
    table = signals(scene, STEPS)
    result = simulated(unit_of(scene, 3), table, scene.integrator.step)
    module = numpy_module(scene)

    def given(row: np.void) -> Any:
        return module.Input(**{item.name: float(row[item.name]) for item in scene.inputs})

    model = module.prepare()
    state = module.initialise(module.Params(), given(table[0]))
    for k in range(STEPS + 1):
        found = module.output(model, state)
        for column in result.dtype.names[1:]:
            scale = float(np.max(np.abs(result[column])))
            assert float(result[column][k]) == pytest.approx(float(getattr(found, column)), abs=1e-11 * scale)
        state = module.step(model, state, given(table[k]))


@pytest.mark.parametrize("version", VERSIONS)
def test_a_communication_step_may_be_many_steps(
    version: FmiVersion, scene_named: Any, instance: Any, direct: Any
) -> None:
    scene = scene_named("thesis10")
    unit = instance(scene, version)
    unit.begin(tip_torque=0.5)
    kernel = direct(scene)
    kernel.prepare()
    kernel.initialise({"tip_torque": 0.5})
    time = 0.0
    for many, torque in ((5, 1.0), (1, -1.0), (12, 0.25)):
        unit.set("tip_torque", torque)
        unit.step(time, many * 0.01)
        time += many * 0.01
        for _ in range(many):
            kernel.step({"tip_torque": torque})
        assert unit.outputs() == kernel.output()
        assert unit.get("time") == pytest.approx(time, abs=1e-12)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_prescribed_angle_alone_is_gone_to_along_a_straight_line(
    version: FmiVersion, servo: Scene, instance: Any, direct: Any
) -> None:
    unit = instance(servo, version)
    unit.begin(angle=0.1, push=0.2)
    kernel = direct(servo)
    kernel.prepare()
    kernel.initialise({"angle": 0.1, "push": 0.2})
    (instants,) = kernel.program.stage_instants
    assert len(instants) > 1
    reached, time = 0.1, 0.0
    for many, target, push in ((1, 0.11, 0.5), (3, 0.13, -0.5), (2, 0.12, 0.0), (4, 0.12, 0.3)):
        unit.set("angle", target)
        unit.set("push", push)
        unit.step(time, many * 2e-3)
        time += many * 2e-3
        for k in range(many):
            way = [reached + ((k + at) / many) * (target - reached) for at in instants]
            rate = (target - reached) / (many * 2e-3)
            kernel.step({"angle": way, "angle_rate": rate, "push": push})
        reached = target
        assert unit.outputs() == kernel.output()
    assert abs(unit.outputs()["tip_y"]) > 0.002


@pytest.mark.parametrize("version", VERSIONS)
def test_start_up_steps_and_single_precision(
    version: FmiVersion, scene_named: Any, instance: Any, direct: Any
) -> None:
    scene = scene_named("thesis2").replace(**{"integrator.name": "mixed", "emit.real": "float32"})
    unit, kernel = instance(scene, version), direct(scene)
    assert kernel.program.startup
    unit.begin(tip_torque=1.0)
    kernel.prepare()
    kernel.initialise({"tip_torque": 1.0})
    for k in range(20):
        unit.step(0.01 * k, 0.01)
        kernel.step({"tip_torque": 1.0})
        assert unit.outputs() == kernel.output()


@pytest.mark.parametrize("version", VERSIONS)
def test_two_instances_do_not_know_each_other(version: FmiVersion, scene_named: Any, instance: Any) -> None:
    scene = scene_named("thesis10")
    one, other = instance(scene, version), instance(scene, version)
    one.begin(tip_torque=1.0)
    other.begin(start=5.0, tip_torque=-1.0)
    one.step(0.0, 0.01)
    one.step(0.01, 0.01)
    other.step(5.0, 0.02)
    assert one.outputs()["tip"] == -other.outputs()["tip"] != 0.0
    assert (one.get("time"), other.get("time")) == (0.02, 5.02)


def test_parameters_and_initial_values_are_the_kernels(scene_named: Any, instance: Any, direct: Any) -> None:
    scene = scene_named("arm10").replace(**{"initial.angles": 0.2})
    stiffness, angles = np.linspace(50.0, 30.0, 10), np.linspace(0.0, 0.4, 10)
    kernel = direct(scene)
    kernel.prepare({"stiffness": stiffness, "tip_mass": 0.3})
    kernel.initialise(initial_angle=angles)
    for _ in range(50):
        kernel.step({"hub_torque": 1.0})
    for version in VERSIONS:
        unit = instance(scene, version)
        assert unit.get("initial.angle") == [0.2] * 10
        assert unit.get("parameters.stiffness") == [64.0] + [32.0] * 9
        unit.begin(parameters__stiffness=stiffness, parameters__tip_mass=0.3, initial__angle=angles)
        unit.set("hub_torque", 1.0)
        unit.step(0.0, 50e-3)
        assert unit.outputs() == kernel.output()
        np.testing.assert_array_equal(unit.get("state.angle"), kernel.state["angle"])


def test_the_function_returned_is_callable_without_arguments(
    unit_of: Callable[..., Path], scene_named: Any
) -> None:
    result = fmpy.simulate_fmu(str(unit_of(scene_named("arm10"), 2)))
    assert len(result) == 1001  # steps of 1 ms, the unit's own, for 1 s
    assert np.isfinite(result["tip_x"]).all()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("told", [2, 3])
def test_a_plan_of_angles_and_rates_is_followed(
    version: FmiVersion, told: int, servo: Scene, unit_of: Any, direct: Any
) -> None:
    """A unit goes where the kernel goes that is given the same plan, one communication step later."""
    plan, every = Smooth(0.0, 1.2, 0.3), 4e-3
    times = every * np.arange(81)
    names = ("angle", "angle_rate", "angle_acceleration")[:told]
    table = np.zeros(len(times), dtype=[("time", float), *((name, float) for name in names)])
    table["time"] = times
    for name, of in zip(names, (plan.at, plan.slope, plan.curvature), strict=False):
        table[name] = of(times)
    result = simulated(unit_of(servo, version), table, every)
    later = Smooth(0.0, 1.2, 0.3, start=every)
    kernel = direct(servo)
    signals = {
        "angle": lambda t: float(later.at(t)),
        "angle_rate": lambda t: float(later.slope(t)),
        "angle_acceleration": lambda t: float(later.curvature(t)),
    }
    _, expected = kernel.simulate(times[-1], signals)
    # the way between two communication points is the plan's own to some power of their distance
    within = 2e-5 if told == 2 else 1e-7
    for column, values in expected.items():
        np.testing.assert_allclose(result[column], values[::2], rtol=0, atol=within)
    assert abs(result["tip_y"][-1]) > 0.3


@pytest.mark.parametrize("version", VERSIONS)
def test_the_base_is_there_at_each_communication_point(
    version: FmiVersion, servo: Scene, instance: Any
) -> None:
    """Rate and acceleration too; and the initial ones are those set before the start."""
    read = [{"name": f"base_{of}", "at": "base", "of": of} for of in ("angle", "rate")]
    scene = servo.replace(output=read)
    unit = instance(scene, version)
    unit.begin(angle=0.01, angle_rate=0.2, angle_acceleration=1.0)
    assert (unit.outputs()["base_angle"], unit.outputs()["base_rate"]) == (0.01, 0.2)
    time = 0.0
    for many, angle, rate in ((1, 0.0105, 0.21), (3, 0.012, 0.25), (2, 0.0125, 0.0)):
        unit.set("angle", angle)
        unit.set("angle_rate", rate)
        unit.step(time, many * 2e-3)
        time += many * 2e-3
        assert unit.outputs()["base_angle"] == pytest.approx(angle, abs=1e-15)
        assert unit.outputs()["base_rate"] == pytest.approx(rate, abs=1e-12)
