"""Elastic gears in space: the reference's motion, the rigid gear as they get stiff, and what they cost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from support.spatial.kernels import package_of, stepped

from tmm_gen.inputs.signals import Sine
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.response import space_response
from tmm_gen.modal.space.still import Still
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.program.space.gears import shafts_of
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.spatial.arm import ArmOutput, Revolute, SpatialArm
from tmm_gen.simulate.disturbance import disturbed
from tmm_gen.simulate.run import simulate
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

READ = [(at, of) for at in ("yaw", "elbow") for of in ("angle", "rate", "acceleration", "torque")]
TEXT = """
name = "geared"
[model]
kind = "spatial"
gravity = [1, -2, -9.81]
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[motor]]
name = "yaw"
turn = [0.3, 0, 0]
axis = "z"
rotor_inertia = 2e-5
gear = 50
stiffness = 400.0
damping = 0.2
motor_damping = 1e-5
damping_time = 1e-3
[[link]]
name = "column"
on = "yaw"
end = [0.1, 0, 0.3]
mass = 1.0
inertia = [0.01, 0.02, 0.015]
[[motor]]
name = "elbow"
on = "column"
axis = [0, 1, 1]
rotor_inertia = 1e-5
gear = 50
stiffness = 150.0
damping = 0.1
[[body]]
name = "load"
on = "elbow"
at = [0.2, 0, 0.05]
mass = 0.6
center = [0.05, 0.02, 0]
inertia = [1e-3, 1.2e-3, 5e-4, 1e-4, -5e-5, 2e-5]
[[input]]
name = "yaw_drive"
at = "yaw"
acts = "torque"
[[input]]
name = "elbow_drive"
at = "elbow"
acts = "torque"
[[output]]
name = "load"
at = "load"
of = "position"
[[output]]
name = "hold"
at = "base"
of = "force"
[[output]]
name = "energy"
at = "arm"
of = "elastic_energy"
[initial]
angles = { elbow = 0.4 }
rates = { yaw = 1.0, elbow = -1.0 }
""" + "".join(f'[[output]]\nname = "{at}_{of}"\nat = "{at}"\nof = "{of}"\n' for at, of in READ)
ACTING = {"yaw_drive": Sine(0.1, 2.0), "elbow_drive": Sine(-0.05, 3.0)}
UNTIL = 0.1


@pytest.fixture(scope="module")
def scene() -> Scene:
    return parse_scene(TEXT, "geared.toml")


def arm_of(scene: Scene) -> SpatialArm:
    assert scene.spatial is not None
    return scene.spatial


def test_which_joints_are_shafts(scene: Scene) -> None:
    """Not those on which something acts or is read, nor without any rotor, nor beside another axis or branch."""
    arm = arm_of(scene)
    assert shafts_of(arm, frozenset()) == {0, 2}
    assert shafts_of(arm, frozenset({2})) == {0}
    one, gear, *others = arm.joints
    for joints in (
        [replace(one, armature=0.0), gear, *others],
        [one, replace(gear, axis=1), *others],
        [one, replace(gear, at=(0.0, 0.0, 0.1)), *others],
        [one, gear, *others, Revolute("more", 1, body=others[-1].body)],
    ):
        assert shafts_of(replace(arm, joints=tuple(joints)), frozenset()) == {2}


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("name", "iterations", "stiffness", "longest", "order"),
    [("newmark", 2, (400.0, 150.0), 1e-3, 2), ("radau3", 3, (12.0, 4.5), 1e-2, 5)],
)
def test_steps_are_those_of_the_reference(
    scene: Scene, name: str, iterations: int, stiffness: tuple[float, float], longest: float, order: int
) -> None:
    """Outputs of both sides together; accelerations at the start; errors that fall by the order of the method."""
    yaw, elbow = (
        stiffness  # a step of one hundredth does not resolve stiff gears, and falls short of its order
    )
    scene = scene.replace(
        **{
            "integrator.name": name,
            "model.iterations": iterations,
            "motor.yaw.stiffness": yaw,
            "motor.elbow.stiffness": elbow,
        }
    )
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    times = np.array([0.0, UNTIL])
    acting = {name: signal.at(times) for name, signal in ACTING.items()}
    right = outputs(arm_of(scene), *motion(arm_of(scene), ACTING, times), acting)
    assert {f"{at}_{of}" for at, of in READ} < set(right)
    errors = []
    for step in (longest, 0.5 * longest):
        _, found = kernel.simulate(UNTIL, {name: signal.at for name, signal in ACTING.items()}, step=step)
        for name, values in right.items():
            assert found[name][0] == pytest.approx(values[0], rel=1e-11, abs=1e-11)
        errors.append([found[name][-1] - values[1] for name, values in right.items()])
    coarse, fine = np.array(errors)
    assert np.log2(np.linalg.norm(coarse) / np.linalg.norm(fine)) == pytest.approx(order, abs=0.1)
    assert np.linalg.norm(2**order * fine - coarse) / (2**order - 1) < 0.05 * np.linalg.norm(fine)


@pytest.mark.parametrize(("name", "iterations"), [("sdirk4", 1), ("radau3", 2)])
def test_a_stiff_gear_is_a_rigid_one(scene: Scene, name: str, iterations: int) -> None:
    """At 1e12 N m/rad, by methods that damp what the step does not resolve."""
    rigid = scene.replace(
        **{f"motor.{at}.{key}": None for at in ("yaw", "elbow") for key in ("stiffness", "damping_time")}
    )
    stiff = scene.replace(**{f"motor.{at}.stiffness": 1e12 for at in ("yaw", "elbow")})
    ended = [
        stepped(package_of(arm_of(each), name, SpaceChoices(1e-3, iterations=iterations)), 1e-3, 50)[-1]
        for each in (stiff, rigid)
    ]
    both = np.reshape(ended[0].angle, (2, 2))
    np.testing.assert_allclose(both.sum(axis=1), ended[1].angle, rtol=0, atol=1e-11)
    assert 0.0 < np.abs(both[:, 1]).max() < 1e-11


def test_a_stiff_gear_makes_no_motion_sensitive(scene: Scene) -> None:
    """What a start disturbed in such a gear would ring with, no step follows: a run is not judged by it."""
    stiff = scene.replace(**{f"motor.{at}.stiffness": 1e12 for at in ("yaw", "elbow")})
    found = simulate(stiff, ACTING, 0.05).accuracy
    assert found is not None
    assert found.sensitivity is not None
    assert 0.5 < found.sensitivity < 2.0
    assert found.error < 1e-4
    start = disturbed(stiff, 1e-9, 1e-3)
    assert np.all(start[[1, 3]] < 1e-14)
    np.testing.assert_array_equal(start[[0, 2]], disturbed(scene, 1e-9, 1e-6)[[0, 2]])


@pytest.mark.compiler
def test_backends_agree(scene: Scene) -> None:
    program = build_program(scene.replace(**{"model.linearisation": "newton", "integrator.name": "bathe"}))
    module = numpy_module(scene, program)
    ours = numpy_step(module, program)
    vectors = list(reached_vectors(module, program, 2, relative=True))
    native = native_step(compile_kernel(program, scene, flags=("-O0",)), program)
    assert largest_difference(ours, native, vectors) < 1e-12
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < 1e-12


def test_frequencies_are_read_on_both_sides(scene: Scene) -> None:
    """The outer side turns by rotor and twist together; what it is turned by is the twisted spring's torque."""
    arm, s = arm_of(scene), 30.0j
    alone = tuple(ArmOutput(joint.name, "angle", joint=k) for k, joint in enumerate(arm.joints, start=1))
    still = Still(ArmNumbers(replace(arm, outputs=arm.outputs[3:] + alone)), np.zeros(4), {})
    found = {name: values[0] for name, values in space_response(still, s).items()}
    for at in ("yaw", "elbow"):
        rotor, twist = found[at], found[f"{at}_gear"]
        spring = arm.joints[[joint.name for joint in arm.joints].index(f"{at}_gear")]
        for order, of in enumerate(("angle", "rate", "acceleration")):
            np.testing.assert_allclose(found[f"{at}_{of}"], s**order * (rotor + twist), rtol=1e-12)
        law = spring.stiffness + spring.damping * s
        np.testing.assert_allclose(found[f"{at}_torque"], -law * twist, rtol=1e-12)
