"""Stages solved at once in space: orders, the same step in all backends, as many iterations as it takes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from support.spatial.afloat import random_afloat, tumbling
from support.spatial.kernels import HEADED, package_of, program_of, stepped
from support.spatial.random_arms import random_arm

from tmm_gen.derive.space.inward import CARRIED
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.inputs.signals import Sine
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.program.statements import Assign, Loop, Require, Routine
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.scene import SceneError, parse_scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.simulate.run import simulate
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)
from tmm_gen.verify.check_row import SLOPE
from tmm_gen.verify.spatial_order import fitted_order

TOLERANCE, SINGLE = 1e-12, 2e-3
ARM = """
name = "swing"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "radau3"
step = 0.01
[base]
kind = "clamp"
[[motor]]
name = "yaw"
on = "base"
axis = "z"
rotor_inertia = 1e-3
damping = 0.05
[[joint]]
name = "hinge"
on = "yaw"
at = [0.1, 0.0, 0.1]
axis = "y"
stiffness = 20.0
damping = 0.05
[[joint]]
name = "elbow"
on = "hinge"
at = [0.3, 0.0, 0.0]
axis = "y"
stiffness = 10.0
damping = 0.05
[[body]]
name = "rod"
on = "hinge"
mass = 0.5
center = [0.15, 0.0, 0.0]
inertia = [1e-3, 4e-3, 4e-3]
[[body]]
name = "load"
on = "elbow"
mass = 0.4
center = [0.2, 0.0, 0.05]
inertia = [1e-3, 2e-3, 2e-3]
[[input]]
name = "torque"
at = "yaw"
acts = "torque"
[[output]]
name = "elbow"
at = "elbow"
of = "angle"
"""
TORQUE = Sine(0.5, 6.0)


def loaded() -> SpatialArm:
    """Return an arm about any axes, under forces and moments in world and body axes."""
    return random_arm(4, 2)


def rope() -> SpatialArm:
    """Return like joints one behind the other, which are a loop."""
    begin, _, end = ARM.partition("[[motor]]")
    end = end[end.index("[[output]]") :].replace('"elbow"', '"j4"')
    for k in range(5):
        begin += f'[[joint]]\nname = "j{k}"\non = "{f"j{k - 1}" if k else "base"}"\nat = [0.2, 0.0, 0.0]\n'
        begin += 'axis = "y"\nstiffness = 9.0\ndamping = 0.02\n'
        begin += f'[[body]]\nname = "b{k}"\non = "j{k}"\nmass = 0.1\ncenter = [0.1, 0.0, 0.0]\n'
    arm = parse_scene(begin + end).spatial
    assert arm is not None
    return arm


@pytest.mark.parametrize(
    ("name", "iterations", "order"), [("radau2", 2, 3), ("radau3", 3, 5), ("gauss2", 2, 4), ("gauss3", 4, 6)]
)
def test_slope_is_the_derived_order(name: str, iterations: int, order: int) -> None:
    """On a tree of joints about any axes, with springs, dampers, rotors and torques."""
    arm = random_arm(5, 3, tree=True, loads=False)
    fitted, _ = fitted_order(arm, package_of(arm, name, SpaceChoices(1e-3, iterations=iterations)))
    assert fitted == pytest.approx(order, abs=2 * SLOPE if order == 6 else SLOPE)


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("arm", "name"),
    [(loaded(), "radau3"), (rope(), "gauss2"), (random_afloat(4, 1), "gauss2")],
    ids=["loaded", "rope", "afloat"],
)
def test_backends_take_the_same_step(arm: SpatialArm, name: str) -> None:
    program = program_of(arm, name, SpaceChoices(1e-3, iterations=2, vectors=arm.base is not None))
    module = numpy_module(HEADED, program)
    ours = numpy_step(module, program)
    vectors = list(reached_vectors(module, program, 2, relative=True))
    native = native_step(compile_kernel(program, HEADED, flags=("-O0",)), program)
    assert largest_difference(ours, native, vectors) < TOLERANCE
    if name == "radau3" or arm.base:
        models = casadi_step(casadi_module(HEADED, program), program)
        assert largest_difference(ours, models, vectors) < TOLERANCE
    if arm.base:
        fast = HEADED.replace(**{"emit.favour": "speed", "emit.box": None})
        vectors_of_stages = native_step(compile_kernel(program, fast, flags=("-O0",)), program)
        assert largest_difference(ours, vectors_of_stages, vectors) < TOLERANCE
    if name == "gauss2":
        # in loops, like joints as one
        loops = {(s.start, s.stop) for s in program.main.statements() if isinstance(s, Loop)}
        assert arm.base or (1, 4) in loops
        halved = HEADED.replace(**{"emit.real": "float32"})
        single = native_step(compile_kernel(program, halved, flags=("-O0",)), program)
        assert TOLERANCE < largest_difference(ours, single, vectors) < SINGLE


def test_runs_iterate_as_often_as_it_takes() -> None:
    """One iteration leaves more, and the reference tells how much."""
    scene = parse_scene(ARM)
    assert scene.spatial is not None
    found = simulate(scene, {"torque": TORQUE}, 0.5)
    assert found.sweeps_per_step is not None
    assert 1.0 < found.sweeps_per_step < 4.0
    exact = motion(scene.spatial, {"torque": TORQUE}, 0.01 * np.arange(1, 51))[0][:, 2]
    once = numpy_module(scene.replace(**{"model.iterations": 1})).simulate(0.5, {"torque": TORQUE.at})
    off, left = (float(np.max(np.abs(o["elbow"][1:] - exact))) for o in (found.outputs, once.outputs))
    assert off < 1e-5
    assert off < 0.3 * left


def test_a_base_alone_is_iterated_about() -> None:
    """No joint moves: what the base turns by is what tells that two iterations are not enough."""
    arm = tumbling((1.0, 2.0, 3.0))
    twice, often, auto = (
        stepped(package_of(arm, "radau2", choices), 0.1, 5)[-1].base_omega_x
        for choices in (
            SpaceChoices(0.1, iterations=2),
            SpaceChoices(0.1, iterations=8),
            SpaceChoices(0.1, auto=True),
        )
    )
    assert auto == pytest.approx(often, rel=1e-7)
    assert twice != pytest.approx(often, rel=1e-4)


def _inside(routine: Routine) -> Iterator[Assign | Require]:
    for statement in routine.statements():
        yield from statement.body if isinstance(statement, Loop) else (statement,)


def test_what_a_proof_needs_is_checked() -> None:
    """The size of each complex pivot before it is divided by, and what every system finds joints to do.

    A pivot of what is outermost is made of the arm's numbers alone: `prepare` looks at that one.
    """
    box = {"angles": [-3.0, 3.0], "rates": [-9.0, 9.0], "accelerations": [-99.0, 99.0], "torque": [-1.0, 1.0]}
    scene = parse_scene(ARM).replace(**{"emit.trigonometry": "own", "emit.box": box})
    program = build_program(scene)
    known = {inner.value for inner in _inside(program.prepare) if isinstance(inner, Require)}
    assert known
    divided = 0
    for loop in (s for s in program.main.statements() if isinstance(s, Loop)):
        required = {inner.value for inner in loop.body if isinstance(inner, Require)}
        below = {1 / inner.value for inner in loop.body if isinstance(inner, Assign) and inner.value.is_Pow}
        divided += len(below)
        assert below <= required | known
    assert divided == 2 * 3
    fence = Kernel.of(program, scene).fences["step"]
    assert {"unknown_system1", "unknown_system2_re", "unknown_system2_im"} <= set(fence.largest)
    assert {v.name.rpartition("_system")[0] for v in fence.handed} <= {s.name for s in CARRIED[:21]}


def test_more_iterations_than_help_are_refused() -> None:
    text = ARM.replace('kind = "spatial"', 'kind = "spatial"\niterations = 99')
    with pytest.raises(SceneError, match="is more than 12") as caught:
        parse_scene(text)
    assert "Write 12 or less" in str(caught.value)
    assert parse_scene(text.replace("99", "12")).sweeps == 12


def test_exact_slopes_are_refused_with_what_to_write() -> None:
    text = ARM.replace('kind = "spatial"', 'kind = "spatial"\nlinearisation = "newton"')
    with pytest.raises(SceneError, match='goes with linearisation = "inertial" in space') as caught:
        parse_scene(text)
    assert '`name = "sdirk4"`' in str(caught.value)
    assert "radau3" not in parse_scene(text.replace("radau3", "sdirk4")).integrators
    assert parse_scene(text.replace('"newton"', '"inertial"')).sweeps == 3
