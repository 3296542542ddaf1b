"""Coupled stages on planar arms: their order, as many iterations as it takes, what they read, what they refuse."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.control.prediction.prediction import prediction_scene
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Sine
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.evaluate import allocate, execute, key
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, SceneError, load_scene, parse_scene
from tmm_gen.simulate.metrics import convergence_slope
from tmm_gen.simulate.run import simulate

ROOT = Path(__file__).resolve().parents[2]
GRIPPER = ROOT / "scenes" / "gripper.toml"
ARM = """
name = "arm"
model = {{ kind = "planar", gravity = 9.81, iterations = {iterations} }}
integrator = {{ name = "{integrator}", step = 0.01 }}
base = {base}
output = [{{ name = "tip", at = "tip", of = "position" }}]
input = [{{ name = "torque", at = "{at}", acts = "{acts}" }}]
tip = {{ mass = 0.2, inertia = 0.01 }}
[[joint]]
stiffness = 20.0
damping = 0.5
repeat = 2
[[link]]
inertia = 0.01
mass = 0.5
length = 0.4
repeat = 2
"""
BASES = {
    "clamp": ('{ kind = "clamp" }', "tip", "torque"),
    "motor": ('{ kind = "motor", inertia = 0.05 }', "base", "torque"),
    "prescribed": ('{ kind = "prescribed" }', "base", "angle"),
}
TORQUE = Sine(2.0, 5.0, 0.3)
"""N m, or the angle of a prescribed base in rad."""
STEPS = {3: (40, 80, 160), 4: (20, 40, 80), 5: (20, 40, 80), 6: (30, 60, 120)}
"""Per second, by the order."""


def arm(integrator: str, base: str, iterations: int | str = "auto") -> Scene:
    stands, at, acts = BASES[base]
    told = f'"{iterations}"' if isinstance(iterations, str) else iterations
    return parse_scene(ARM.format(integrator=integrator, base=stands, at=at, acts=acts, iterations=told))


@cache
def exact(base: str) -> np.ndarray:
    times = 0.1 * np.arange(11)
    found = planar_response(arm("radau3", base), {"torque": TORQUE}, times)
    return np.array([found["tip_x"], found["tip_y"]])


@pytest.mark.parametrize(
    ("integrator", "base", "order"),
    [
        ("radau3", "clamp", 5),
        ("radau3", "motor", 5),
        ("radau3", "prescribed", 5),
        ("radau2", "clamp", 3),
        ("gauss2", "motor", 4),
        ("gauss3", "motor", 6),
    ],
)
def test_slope_is_the_derived_order(integrator: str, base: str, order: int) -> None:
    """With so many iterations a step that the first one's start leaves nothing to be seen."""
    kernel = numpy_module(arm(integrator, base, 3 if base == "prescribed" else 2))
    moved = {"torque": TORQUE.at, "torque_rate": TORQUE.slope, "torque_acceleration": TORQUE.curvature}
    given = {name: moved[name] for name in kernel.INPUT_NAMES}
    # a base that swings four radians to and fro takes shorter steps
    counts = [(2 if base == "prescribed" else 1) * steps for steps in STEPS[order]]
    errors = []
    for steps in counts:
        found = kernel.simulate(1.0, given, step=1.0 / steps).outputs
        tip = np.array([found["tip_x"], found["tip_y"]])[:, :: steps // 10]
        errors.append(float(np.max(np.abs(tip - exact(base)))))
    slope = convergence_slope([1.0 / steps for steps in counts], errors)
    assert slope.order == pytest.approx(order, abs=0.2), errors


def test_branches_hang_together() -> None:
    """On a gripper let go, whose fingers hang on one palm, beside Lagrange's equations."""
    scene = load_scene(GRIPPER).replace(**{"integrator.name": "radau3", "model.iterations": 2})
    kernel = numpy_module(scene)
    found = kernel.simulate(0.2, {}, step=2e-3).outputs
    exact = planar_response(scene, {}, np.linspace(0.0, 0.2, 101))
    for name, values in exact.items():
        np.testing.assert_allclose(found[name], values, atol=2e-5 * np.max(np.abs(values)))


@pytest.fixture(scope="module")
def radau() -> Scene:
    return arm("radau3", "motor", "auto")


def test_one_iteration_is_near_what_as_many_as_it_takes_find(radau: Scene) -> None:
    """At 20 ms; and such runs count what they take."""
    found = simulate(radau.replace(**{"integrator.step": 0.02}), {"torque": TORQUE}, 1.0)
    assert found.sweeps_per_step is not None
    assert 1.5 < found.sweeps_per_step < 4.0
    solved = np.array([found.outputs["tip_x"], found.outputs["tip_y"]])[:, ::5]
    assert np.max(np.abs(solved - exact("motor"))) < 5e-6
    once = numpy_module(radau).simulate(1.0, {"torque": TORQUE.at}, step=0.02).outputs
    assert np.max(np.abs(np.array([once["tip_x"], once["tip_y"]])[:, ::5] - solved)) < 2e-5


def test_the_first_step_iterates_once_more(radau: Scene) -> None:
    """No polynomial leads into it; later steps take one."""

    def after(steps: int, iterations: int | str) -> np.ndarray:
        scene = radau.replace(**{"model.iterations": iterations, "integrator.step": 0.02})
        return numpy_module(scene).simulate(0.02 * steps, {"torque": 1.0}).state.angle

    np.testing.assert_array_equal(after(1, "auto"), after(1, 2))
    assert np.any(after(2, "auto") != after(2, 2))


def test_the_program_itself_does_what_the_kernel_does(radau: Scene) -> None:
    """The interpreter, which shares no printer, and C agree after three steps."""
    program = build_program(radau)
    values = allocate(
        (
            program.step,
            *program.parameters,
            *program.coefficients,
            *program.state,
            *program.inputs,
            *program.given,
        ),
        float,
    )
    values[key(program.inputs[0])] = [1.0] * 3
    for routine in (program.prepare, program.initialise, *program.startup, program.main, program.main):
        execute(routine, values)
    kernel = compile_kernel(program, radau)
    kernel.prepare()
    kernel.initialise({"torque": 1.0})
    for _ in range(3):
        kernel.step({"torque": 1.0})
    for variable in program.state:
        found = kernel.state[variable.name]
        np.testing.assert_allclose(found, values[variable.name], rtol=1e-10, atol=1e-12)


def test_steps_are_refused_as_others_are(radau: Scene) -> None:
    """An input that is not finite is refused before anything changes, and a step whose result is not finite is told."""
    kernel = compile_kernel(build_program(radau), radau)
    kernel.prepare()
    kernel.initialise({"torque": 0.0})
    before = kernel.state
    with pytest.raises(ArithmeticError, match="an argument is not finite"):
        kernel.step({"torque": np.nan})
    for name, value in kernel.state.items():
        np.testing.assert_array_equal(value, before[name])
    kernel.step({"torque": 0.0})
    with pytest.raises(ArithmeticError, match="outgrown"):
        kernel.step({"torque": 1e308})
    kernel.prepare({"stiffness": -1e6})
    kernel.initialise({"torque": 0.0})
    with pytest.raises(ArithmeticError, match="pivot"):
        kernel.step({"torque": 0.0})


@pytest.mark.parametrize(
    ("change", "told", "remedy"),
    [
        ({"model.unknown": "increment"}, "by their accelerations", {"model.unknown": "acceleration"}),
        (
            {"model.linearisation": "taylor", "model.iterations": "auto"},
            'linearisation = "taylor"',
            {"integrator.name": "sdirk4"},
        ),
        ({"emit.sensitivities": True}, "not derived here yet", {"integrator.name": "sdirk4"}),
    ],
)
def test_what_does_not_go_with_them_is_told_with_a_remedy(
    radau: Scene, change: dict[str, object], told: str, remedy: dict[str, object]
) -> None:
    with pytest.raises(SceneError) as caught:
        radau.replace(**change)
    assert told in str(caught.value)
    assert all(str(value) in str(caught.value) for value in remedy.values())


def test_controllers_say_that_they_need_derivatives() -> None:
    scene = load_scene(ROOT / "scenes" / "swing.toml").replace(**{"integrator.name": "gauss2"})
    with pytest.raises(UserError, match="use an integrator such as 'newmark'"):
        prediction_scene(scene)
