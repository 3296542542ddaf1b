"""Motors with elastic gears: the rigid one as the gear gets stiff, and their shaft as Lagrange has it."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant, Sine
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.metrics import convergence_slope

pytestmark = pytest.mark.compiler

UNTIL = 0.2
ACTING = {"shoulder_torque": 0.03, "elbow_torque": -0.02}
SWINGING = {"shoulder_torque": Sine(0.03, 3.0, 0.3), "elbow_torque": Sine(-0.02, 5.0)}
STEPS = (8e-3, 4e-3, 2e-3)
"""s."""
JOINTS = "".join(
    f'\n[[output]]\nname = "{of}_of_{at}"\nat = "{at}"\nof = "{of}"\n'
    for at in ("shoulder", "elbow")
    for of in ("angle", "rate", "torque", "force")
)


def ended(scene: Scene, step: float, integrator: str = "sdirk4") -> dict[str, float]:
    changed = scene.replace(**{"integrator.name": integrator, "integrator.step": step})
    _, found = compile_kernel(build_program(changed), changed, flags=("-O1",)).simulate(
        UNTIL, ACTING, step=step
    )
    return {name: float(values[-1]) for name, values in found.items()}


def soft(elbow_text: str) -> Scene:
    """Return an arm whose gears give way so far that steps follow them."""
    return elastic(parse_scene(elbow_text), 30.0, motor_damping=1e-6, damping_time=1e-3)


@pytest.fixture(scope="module")
def swinging(elbow_text: str) -> dict[str, float]:
    """Return outputs at the end."""
    right = planar_response(soft(elbow_text), SWINGING, np.array([UNTIL]))
    return {name: float(values[0]) for name, values in right.items()}


def elastic(scene: Scene, stiffness: float, **more: float) -> Scene:
    keys = {f"motor.{m}.stiffness": stiffness for m in ("shoulder", "elbow")}
    return scene.replace(
        **keys, **{f"motor.{m}.{k}": v for m in ("shoulder", "elbow") for k, v in more.items()}
    )


@pytest.mark.parametrize(("integrator", "stiffness"), [("sdirk4", 1e9), ("sdirk4", 1e12), ("radau2", 1e12)])
def test_a_stiff_gear_is_a_rigid_one(elbow_text: str, integrator: str, stiffness: float) -> None:
    scene = parse_scene(elbow_text + JOINTS)
    rigid, stiff = ended(scene, 1e-3, integrator), ended(elastic(scene, stiffness), 1e-3, integrator)
    # the gear gives way by its torque, some 10 N m, over its stiffness; below that stand the digits of the torque
    for name in rigid:
        if not name.startswith(("force", "torque")):
            assert stiff[name] == pytest.approx(
                rigid[name], rel=1e-11, abs=10.0 * 30.0 / stiffness + 1e-11
            ), name


def test_steps_are_those_of_lagranges_equations(elbow_text: str) -> None:
    scene = elastic(parse_scene(elbow_text + JOINTS), 300.0, motor_damping=1e-6, damping_time=1e-3)
    right = planar_response(scene, {k: Constant(v) for k, v in ACTING.items()}, np.array([UNTIL]))
    whole, half = ended(scene, 2e-3), ended(scene, 1e-3)
    for name, values in right.items():
        own = abs(whole[name] - half[name]) + 1e-9 * max(1.0, abs(values[0]))
        assert abs(half[name] - values[0]) < 2.0 * own, name


COSTS = {
    "newmark": 24,
    "houbolt": 32,
    "generalized_alpha": 36,
    "bathe": 52,
    "sdirk4": 134,
    "fox_euler": 24,
    "radau3": 158,
    "gauss2": 91,
}
"""Operations a step that an elastic gear costs more than a rigid one."""


@pytest.mark.parametrize("integrator", COSTS)
def test_what_an_elastic_gear_costs(elbow_text: str, integrator: str) -> None:
    scene = parse_scene(elbow_text).replace(**{"integrator.name": integrator})
    scenes = scene, elastic(scene, 300.0), elastic(scene, 300.0, damping_time=1e-3, motor_damping=1e-6)
    rigid, *others = (count_routine(build_program(s).main).total for s in scenes)
    assert {(other - rigid) / 2 for other in others} == {COSTS[integrator]}


def test_a_second_iteration_finds_nothing_over_on_shafts(elbow_text: str) -> None:
    """Laws of motors and gears are linear: the first one brings the torques on both sides together for good."""
    scene = parse_scene(elbow_text).replace(**{"integrator.name": "radau3"})
    costs = []
    for iterations in (1, 2):
        scenes = (each.replace(**{"model.iterations": iterations}) for each in (scene, elastic(scene, 300.0)))
        rigid, gears = (count_routine(build_program(each).main).total for each in scenes)
        costs.append((gears - rigid) / 2)
    assert costs == [COSTS["radau3"], COSTS["radau3"] + 69]


@pytest.mark.parametrize(
    ("integrator", "iterations", "order"),
    [("radau2", 2, 3), ("radau3", 3, 5), ("gauss2", 3, 4), ("gauss3", 4, 6)],
)
def test_orders_of_stages_solved_at_once(
    elbow_text: str, swinging: dict[str, float], integrator: str, iterations: int, order: int
) -> None:
    scene = soft(elbow_text).replace(**{"integrator.name": integrator, "model.iterations": iterations})
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    errors = []
    for step in STEPS:
        found = kernel.simulate(UNTIL, {name: signal.at for name, signal in SWINGING.items()}, step=step)[1]
        errors.append(max(abs(found[name][-1] - value) for name, value in swinging.items()))
    slope = convergence_slope(STEPS, errors)
    assert slope.order == pytest.approx(order, abs=0.2), errors
