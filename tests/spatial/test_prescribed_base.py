"""A base in space that turns and moves as inputs say: about any axis, with any integrator and either linearisation."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest
from support.spatial.kernels import package_of, program_of
from support.spatial.random_arms import random_arm

from tmm_gen.inputs.signals import Sine
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.program.statements import Program
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.reference.spatial_places import Tree
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene import SceneError, parse_scene
from tmm_gen.scene.spatial.arm import ArmInput, SpatialArm
from tmm_gen.simulate.run import simulate
from tmm_gen.verify.agreement import largest_difference, native_step, numpy_step, reached_vectors
from tmm_gen.verify.check_row import SLOPE
from tmm_gen.verify.spatial_order import fitted_order

TABLE = """
name = "turntable"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "prescribed"
axis = [0.5, 0.6, 1.0]
[[input]]
name = "table"
at = "base"
acts = "angle"
[[input]]
name = "cart"
at = "base"
acts = "place_y"
[[input]]
name = "push"
at = "load"
acts = "force"
[[joint]]
name = "hinge"
on = "base"
at = [0.1, 0.0, 0.1]
axis = "y"
stiffness = 20.0
damping = 0.05
[[body]]
name = "load"
on = "hinge"
mass = 0.5
center = [0.3, 0.02, 0.01]
inertia = [1e-3, 1e-3, 5e-4]
[[joint]]
name = "other"
on = "base"
axis = "x"
stiffness = 20.0
[[body]]
name = "second"
on = "other"
mass = 0.5
center = [-0.1, 0.2, 0.01]
inertia = [1e-3, 1e-3, 5e-4]
""" + "".join(
    f'[[output]]\nname = "{at}_{of}"\nat = "{at}"\nof = "{of}"\n'
    for at, of in (
        *(("load", "position"), ("base", "angle"), ("base", "orientation"), ("load", "velocity")),
        ("base", "torque"),
        ("base", "force"),
    )
)


def driven(arm: SpatialArm) -> SpatialArm:
    """Return an arm whose first joint moves as an input says, on a base that two others move along."""
    first, *others = arm.joints
    first = replace(first, given="table", stiffness=0.0, damping=0.0, armature=0.0)
    inputs = (ArmInput("table", "angle", joint=1), ArmInput("cart", "place_y"), ArmInput("lift", "place_z"))
    return replace(arm, joints=(first, *others), inputs=inputs, outputs=())


@pytest.mark.parametrize(
    ("name", "choices", "order"),
    [
        ("newmark", SpaceChoices(1e-3, iterations=2), 2),
        ("generalized_alpha", SpaceChoices(1e-3, iterations=2), 2),
        ("sdirk4", SpaceChoices(1e-3, iterations=1, exact=True, held=True), 4),
        ("gauss2", SpaceChoices(1e-3, iterations=3), 4),
    ],
    ids=["newmark", "generalized-alpha", "sdirk4, exact", "gauss2"],
)
def test_order(name: str, choices: SpaceChoices, order: int) -> None:
    """Generalised alpha and Gauss have their last stage before the end of the step: the base is asked there too."""
    arm = driven(random_arm(11, 3, tree=True, loads=False))
    fitted, _ = fitted_order(arm, package_of(arm, name, choices))
    assert fitted == pytest.approx(order, abs=SLOPE)


def test_a_joint_that_is_given_costs_no_elimination() -> None:
    arm = random_arm(11, 3, tree=False, loads=False)
    free = replace(arm, inputs=(), outputs=())
    costs = [count_routine(program_of(each).main).total for each in (driven(arm), free)]
    assert costs[0] < 0.75 * costs[1]


def assert_driven(module: ModuleType, program: Program, arm: SpatialArm) -> None:
    """What turns the table, and what carries it, is all that bodies and pushes ask for, whatever the motion."""
    rng, n = np.random.default_rng(3), len(arm.joints)
    columns = {v.name: float(value) for v, value in zip(program.inputs, rng.normal(size=9), strict=True)}
    state = module.initialise(
        module.Params(),
        module.Input(**columns),
        initial_angle=rng.normal(size=n),
        initial_rate=rng.normal(size=n),
    )
    read = module.output(module.prepare(), state)
    moving = (state.angle, state.rate, state.acceleration)
    wanted = outputs(arm, *(x[None] for x in moving), {k: np.array([v]) for k, v in columns.items()})
    for column in ("torque", "force_x", "force_y", "force_z"):
        found = getattr(read, f"base_{column}")
        assert abs(found) > 0.5
        assert found == pytest.approx(wanted[f"base_{column}"][0], rel=1e-12)


@pytest.mark.compiler
def test_scene() -> None:
    """It runs by C as the reference has it, compiles without a warning, and agrees with NumPy."""
    scene = parse_scene(TABLE)
    assert scene.spatial is not None
    program = build_program(scene)
    kernel = compile_kernel(program, scene, flags=("-O1", "-Wall", "-Wextra", "-Werror"))
    module = numpy_module(scene, program)
    vectors = list(reached_vectors(module, program, 2, relative=True))
    assert largest_difference(numpy_step(module, program), native_step(kernel, program), vectors) < 1e-12
    assert_driven(module, program, scene.spatial)
    signals = {"table": Sine(0.7, 5.0, 0.4), "cart": Sine(0.2, 6.0, 0.1)}
    found = simulate(scene, signals, 0.5, "c", kernel=kernel)
    arm = scene.spatial
    assert arm is not None
    q, _, _ = motion(arm, signals, found.time[1:])
    frame = next(f for f in arm.frames if f.name == "load")
    _, point = Tree(arm).places(q).frame(frame)
    for k, axis in enumerate("xyz"):
        own = point[:, k] + (signals["cart"].at(found.time[1:]) if axis == "y" else 0.0)
        assert np.abs(found.outputs[f"load_position_{axis}"][1:] - own).max() < 3e-5
    assert np.abs(found.outputs["base_angle"] - signals["table"].at(found.time)).max() < 1e-14
    axis = np.array([0.5, 0.6, 1.0]) / np.linalg.norm([0.5, 0.6, 1.0])
    half = 0.5 * signals["table"].at(found.time)
    for k, letter in enumerate("xyz"):
        assert np.abs(found.outputs[f"base_orientation_{letter}"] - axis[k] * np.sin(half)).max() < 1e-14


ANGLE = 'name = "table"\nat = "base"\nacts = "angle"'
SECOND = '[[joint]]\nname = "other"'
FAULTS = {
    "no angle": (ANGLE, 'name = "table"\nat = "hinge"\nacts = "torque"', "no input says by how much"),
    "twice": (SECOND, f'[[input]]\nname = "b"\nat = "base"\nacts = "angle"\n{SECOND}', "a second time"),
    "elsewhere": (ANGLE, ANGLE.replace("base", "hinge"), 'cannot be "angle" here'),
    "pushed": ('at = "load"\nacts = "force"', 'at = "base"\nacts = "force"', "which moves as its inputs say"),
    "starts": (
        'kind = "prescribed"',
        'kind = "prescribed"\nrate = [0, 0, 1]',
        "a prescribed base moves as its inputs say",
    ),
    "axis of a clamp": ('kind = "prescribed"', 'kind = "clamp"', "is that of a prescribed base"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults(name: str) -> None:
    old, new, message = FAULTS[name]
    assert old in TABLE
    with pytest.raises(SceneError, match=message):
        parse_scene(TABLE.replace(old, new, 1))
