"""Motors with elastic gears: the rigid one as the gear gets stiff, and their shaft as Lagrange has it."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, parse_scene

pytestmark = pytest.mark.compiler

UNTIL = 0.2
ACTING = {"shoulder_torque": 0.03, "elbow_torque": -0.02}
JOINTS = "".join(
    f'\n[[output]]\nname = "{of}_of_{at}"\nat = "{at}"\nof = "{of}"\n'
    for at in ("shoulder", "elbow")
    for of in ("angle", "rate", "torque", "force")
)


def ended(scene: Scene, step: float) -> dict[str, float]:
    changed = scene.replace(**{"integrator.name": "sdirk4", "integrator.step": step})
    _, found = compile_kernel(build_program(changed), changed, flags=("-O1",)).simulate(
        UNTIL, ACTING, step=step
    )
    return {name: float(values[-1]) for name, values in found.items()}


def elastic(scene: Scene, stiffness: float, **more: float) -> Scene:
    keys = {f"motor.{m}.stiffness": stiffness for m in ("shoulder", "elbow")}
    return scene.replace(
        **keys, **{f"motor.{m}.{k}": v for m in ("shoulder", "elbow") for k, v in more.items()}
    )


@pytest.mark.parametrize("stiffness", [1e9, 1e12])
def test_a_stiff_gear_is_a_rigid_one(elbow_text: str, stiffness: float) -> None:
    scene = parse_scene(elbow_text + JOINTS)
    rigid, stiff = ended(scene, 1e-3), ended(elastic(scene, stiffness), 1e-3)
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


COSTS = {"newmark": 24, "houbolt": 32, "generalized_alpha": 36, "bathe": 52, "sdirk4": 134, "fox_euler": 24}
"""Operations a step that an elastic gear costs more than a rigid one."""


@pytest.mark.parametrize("integrator", COSTS)
def test_what_an_elastic_gear_costs(elbow_text: str, integrator: str) -> None:
    scene = parse_scene(elbow_text).replace(**{"integrator.name": integrator})
    scenes = scene, elastic(scene, 300.0), elastic(scene, 300.0, damping_time=1e-3, motor_damping=1e-6)
    rigid, *others = (count_routine(build_program(s).main).total for s in scenes)
    assert {(other - rigid) / 2 for other in others} == {COSTS[integrator]}
