"""Integrators in space, explicit ones and those that look back too: orders, and the same step in all backends."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from support.spatial.boom import BOOM
from support.spatial.palm import PALM

from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.inputs.signals import Sine
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import INTEGRATOR_NAMES, Scene, parse_scene
from tmm_gen.scene import METHODS as DECLARED
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.grid import Axes, configurations
from tmm_gen.study.study import run_study
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

pytestmark = pytest.mark.compiler

TOLERANCE = 1e-12
COUPLED = tuple(method.name for method in DECLARED if method.coupled)
METHODS = tuple(name for name in INTEGRATOR_NAMES if name not in ("sdirk2", "sdirk4", *COUPLED))
"""Those of many stages take long to build; tests/spatial/test_order.py holds one."""
UNTIL = 0.4
TOP = 3e-3
"""Longest step, s."""
LOADS = {
    "twist": Sine(1e-3, 7.0),
    "push_x": Sine(0.02, 9.0),
    "push_y": Sine(0.3, 11.0),
    "push_z": Sine(0.02, 13.0),
}


@pytest.fixture(scope="module")
def errors() -> Mapping[str, list[float]]:
    """Errors of the place of the outer end with three steps, each half the last, by integrator."""
    scene = parse_scene(PALM, "palm.toml")
    went = Excitation(LOADS, UNTIL, "nail")
    steps = tuple(TOP / 2**k for k in range(3))
    grid = configurations(scene, Axes(METHODS, steps), UNTIL)
    study = run_study(scene, went, grid, rounds=0)
    found: dict[str, list[float]] = {name: [] for name in METHODS}
    for point in study.points:
        if point.configuration.step in steps:
            assert point.result.error is not None, (point.configuration, point.result)
            found[point.configuration.family.integrator].append(point.result.error)
    return found


@pytest.mark.parametrize("name", METHODS)
def test_order(name: str, errors: Mapping[str, list[float]]) -> None:
    """Explicit methods and those that look back too; what is at rounding has no slope to show."""
    first, *_, last = errors[name]
    expected = order(integrator(name))
    assert last < first < 0.1
    assert np.log2(first / last) / 2.0 > expected - 0.4


@pytest.mark.parametrize("name", ["sdirk4", "houbolt", "fox_euler"])
def test_backends_take_the_same_step(name: str) -> None:
    """Five stages, first steps of their own, an explicit method; a beam that bends both ways and twists."""
    scene = parse_scene(BOOM.replace('"newmark"', f'"{name}"').replace("5e-4", "5e-5"))
    program = build_program(scene)
    module = numpy_module(scene, program)
    ours = numpy_step(module, program)
    vectors = list(reached_vectors(module, program, 2, relative=True))
    native = native_step(compile_kernel(program, scene, flags=("-O1",)), program)
    assert largest_difference(ours, native, vectors) < TOLERANCE
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < TOLERANCE


def test_a_run_in_casadi_is_that_in_numpy_where_outputs_are_read_at_the_same_instant() -> None:
    """A step's ``y`` is of the state that it begins with: that of the last step is an instant old."""
    scene = parse_scene(BOOM)
    module, model = numpy_module(scene), casadi_module(scene)
    step, parameters = model.step_function(), model.default_parameters()
    acting = {"torque": 0.05, "push_x": 0.4, "push_y": 0.5, "push_z": -0.6}
    steps, h = 100, scene.integrator.step
    given: Scene = scene
    found = module.simulate(steps * h, acting).outputs["hand_y"]
    state = module.initialise(module.Params(), module.Input(**acting))
    x = np.concatenate(
        [np.atleast_1d(np.asarray(getattr(state, v.name))) for v in build_program(given).state]
    )
    read = []
    column = model.OUTPUT_NAMES.index("hand_y")
    for _ in range(steps + 1):
        done = step(x=x, u=list(acting.values()), p=parameters)
        read.append(float(done["y"][column]))
        x = done["x_next"]
    travel = float(np.ptp(found))
    assert float(np.max(np.abs(np.array(read) - found))) < 1e-10 * travel
    late = float(np.max(np.abs(found[1:] - found[:-1])))
    assert late > 1e-3 * travel  # what reading an instant late makes of it
