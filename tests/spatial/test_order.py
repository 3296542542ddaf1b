"""Generated steps of arms in space go to the reference with their integrators' orders."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from support.spatial.random_arms import random_arm
from support.spatial.yardsticks import Top, cantilever

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.native.python_module import import_package
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import ArmOutput, Frame, Revolute, SpatialArm
from tmm_gen.verify.check_row import SLOPE
from tmm_gen.verify.spatial_order import fitted_order, softened, swings, turned_alike

HEADED = load_scene(Path(__file__).resolve().parents[2] / "scenes" / "arm10.toml")
"""Any scene: headers are written of one."""


def generated(arm: SpatialArm, name: str, *, sweeps: int, held: bool) -> ModuleType:
    """Return the NumPy package of an arm that reads nothing."""
    bare = replace(arm, outputs=tuple(o for o in arm.outputs if o.of in ("angle", "rate")))
    choices = SpaceChoices(1e-3, iterations=sweeps, held=held)
    return import_package(
        emit_numpy(build_in_space(bare, "arm", "arm", integrator(name), choices), HEADED), "arm"
    )


@pytest.mark.parametrize(
    ("name", "sweeps", "held", "order"),
    [
        ("newmark", 1, True, 2),
        ("newmark", 1, False, 1),
        ("newmark", 2, False, 2),
        ("sdirk4", 2, True, 3),
        ("sdirk4", 3, True, 4),
    ],
)
def test_order_of_a_tree(name: str, sweeps: int, held: bool, order: int) -> None:
    """A sweep is worth one order, and so is a prediction with the newest acceleration, up to the integrator's."""
    arm = random_arm(5, 4, tree=True, loads=False)
    fitted, _ = fitted_order(arm, generated(arm, name, sweeps=sweeps, held=held))
    assert fitted == pytest.approx(order, abs=SLOPE)


def test_order_of_a_beam() -> None:
    arm = replace(cantilever(3), gravity=(0.0, 0.0, -9.81), inputs=())
    fitted, _ = fitted_order(arm, generated(arm, "newmark", sweeps=2, held=False))
    assert fitted == pytest.approx(2.0, abs=SLOPE)


def test_wrong_equations_show() -> None:
    """A kernel of another arm does not go to this one's motion."""
    arm = random_arm(5, 4, tree=True, loads=False)
    first = arm.joints[0]
    heavier = replace(
        first, body=replace(first.body, mass=1.01 * first.body.mass), armature=first.armature + 1e-4
    )
    other = replace(arm, joints=(heavier, *arm.joints[1:]))
    fitted, _ = fitted_order(arm, generated(other, "newmark", sweeps=2, held=False))
    assert abs(fitted - 2.0) > SLOPE


def test_softened_arms_are_slow_and_loads_are_felt() -> None:
    arm = random_arm(2, loads=True)
    stiff = replace(arm, joints=tuple(replace(j, stiffness=1e5 * j.stiffness) for j in arm.joints))
    world = WorldArm(softened(stiff))
    q = np.array([joint.angle for joint in arm.joints])
    squares = np.linalg.eigvals(np.linalg.solve(world.mass_matrix(q), np.diag(world.stiffness)))
    assert np.max(squares.real) == pytest.approx(1600.0)
    free = world.forward_dynamics(q, 0.0 * q, {})
    for column, signal in swings(softened(stiff)).items():
        moved = world.forward_dynamics(
            q, 0.0 * q, {column: float(np.max(signal.at(np.linspace(0.0, 1.0, 4001))))}
        )
        assert np.max(np.abs(moved - free)) == pytest.approx(3.0, rel=1e-4)


def test_steady_top_stays_steady() -> None:
    """Rates are constant, so that every step is exact but for rounding."""
    top = Top()
    module = generated(top.arm, "newmark", sweeps=4, held=True)
    step = 1e-3
    model, given = module.prepare(step=step), module.Input()
    state = module.initialise(module.Params(), given)
    for _ in range(200):
        state = module.step(model, state, given)
    assert np.max(np.abs(state.rate - top.rates)) < 1e-12
    assert state.angle == pytest.approx(
        [200 * step * top.rates[0], top.tilt, 200 * step * top.rates[2]], abs=1e-12
    )


def test_orientations_are_compared_as_turns() -> None:
    frame = Frame("tip", 1)
    arm = SpatialArm(
        (Revolute("hinge", 0),), (frame,), outputs=(ArmOutput("facing", "orientation", frame=frame),)
    )
    turn = {f"facing_{part}": np.array([0.5, -0.5]) for part in "wxyz"}
    other = {**{name: -values for name, values in turn.items()}, "facing_w": np.array([-0.6, 0.6])}
    found = turned_alike(arm, turn, other)
    assert all(np.array_equal(found[name], -values) for name, values in turn.items())
    assert all(np.array_equal(turned_alike(arm, turn, turn)[name], values) for name, values in turn.items())
