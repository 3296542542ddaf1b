"""States between steps have the order that their polynomial promises, and rows are where they are asked for."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.dense import Dense, dense, halved
from tmm_gen.simulate.metrics import convergence_slope
from tmm_gen.simulate.rows import row_instants
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.stages import StagePolynomial
from tmm_gen.simulate.stepping import Backend

STEPS = (0.2, 0.1, 0.05)
_OMEGA = np.array([2.0, 3.0])
"""rad/s of two links."""


def motion(times: np.ndarray) -> dict[str, np.ndarray]:
    """Return a motion that is known, as a kernel's states: two links, a base that floats and turns about x, heat."""
    phase = times[:, None] * _OMEGA
    first, half = phase[:, 0], 0.5 * np.sin(phase[:, 1])
    zero = np.zeros(len(times))
    return {
        "angle": np.sin(phase),
        "rate": _OMEGA * np.cos(phase),
        "acceleration": -(_OMEGA**2) * np.sin(phase),
        "base_place_x": np.cos(first),
        "base_velocity_x": -_OMEGA[0] * np.sin(first),
        "base_acceleration_x": -(_OMEGA[0] ** 2) * np.cos(first),
        "base_quaternion_w": np.cos(half),
        "base_quaternion_x": np.sin(half),
        "base_quaternion_y": zero,
        "base_quaternion_z": zero.copy(),
        "base_omega_x": _OMEGA[1] * np.cos(phase[:, 1]),
        "base_omega_y": zero.copy(),
        "base_omega_z": zero.copy(),
        "base_alpha_x": -(_OMEGA[1] ** 2) * np.sin(phase[:, 1]),
        "base_alpha_y": zero.copy(),
        "base_alpha_z": zero.copy(),
        "dissipated": 2.0 * first + np.sin(2.0 * first),
    }


def slope(find: Callable[[float, np.ndarray], dict[str, np.ndarray]], name: str) -> float:
    """Return by which power of the step the largest error between nodes falls."""
    instants = np.linspace(0.0, 1.2, 97)
    exact = motion(instants)[name]
    errors = [float(np.max(np.abs(find(h, instants)[name] - exact))) for h in STEPS]
    return convergence_slope(STEPS, errors).order


def nodes(h: float) -> np.ndarray:
    return h * np.arange(round(1.2 / h) + 1)


@pytest.mark.parametrize(("settled", "orders"), [(True, (6, 5, 4)), (False, (4, 3, 2))])
def test_one_step_alone(settled: bool, orders: tuple[int, ...]) -> None:
    between = Dense(settled, None)

    def find(h: float, instants: np.ndarray) -> dict[str, np.ndarray]:
        return between.at(instants, nodes(h), motion(nodes(h)))

    for name, order in zip(("angle", "rate", "acceleration"), orders, strict=True):
        assert slope(find, name) == pytest.approx(order, abs=0.4), name
    assert slope(find, "base_place_x") == pytest.approx(orders[0], abs=0.4)
    assert slope(find, "base_quaternion_x") == pytest.approx(orders[0], abs=0.4)


def test_both_halves_of_a_step() -> None:
    def find(h: float, instants: np.ndarray) -> dict[str, np.ndarray]:
        return halved(instants, nodes(h), motion(nodes(h)))

    names = ("angle", "rate", "acceleration", "base_velocity_x", "base_quaternion_x", "base_omega_x")
    for name, order in zip(names, (6, 5, 4, 5, 6, 5), strict=True):
        assert slope(find, name) == pytest.approx(order, abs=0.5), name
    rows = find(0.1, np.linspace(0.0, 1.2, 1000))
    assert np.all(np.diff(rows["dissipated"]) >= 0.0)
    np.testing.assert_allclose(
        np.hypot(rows["base_quaternion_w"], rows["base_quaternion_x"]), 1.0, rtol=1e-14
    )


@pytest.mark.parametrize("stages", [(0.2113248654051871, 0.7886751345948129), (0.1, 0.5, 0.9)])
def test_the_polynomial_of_a_collocation_step(stages: tuple[float, ...]) -> None:
    """With s stages accelerations are right to order s, rates to one more, angles to two more; turns as angles are."""
    polynomial = StagePolynomial(stages, ("acceleration", *(f"base_alpha_{axis}" for axis in "xyz")))
    between = Dense(settled=False, stages=polynomial)

    def find(h: float, instants: np.ndarray) -> dict[str, np.ndarray]:
        times = nodes(h)
        states = motion(times)
        for newest in polynomial.moving:
            del states[newest]
            for name, node in zip(polynomial.names(newest), stages, strict=True):
                states[name] = motion(times - h + node * h)[newest]
        found = between.at(instants, times, states)
        # what an output would read: the polynomial at the end of the step that the stages are of
        weights = polynomial.weights(1.0)[0]
        parts = zip(weights, polynomial.names("acceleration"), strict=True)
        return {**found, "acceleration": sum(w * found[name] for w, name in parts)}

    s = len(stages)
    for name, order in (("angle", s + 2), ("rate", s + 1), ("base_quaternion_x", s + 2)):
        assert slope(find, name) == pytest.approx(order, abs=0.5), name
    # in steps' ends accelerations are the polynomial's own too, one order less than in between nodes of Gauss
    assert slope(find, "acceleration") == pytest.approx(s, abs=0.5)


def test_whole_turns_that_are_kept_apart() -> None:
    times = np.array([0.0, 0.1])
    states = {
        "angle": np.array([[6.2], [0.1]]),
        "rate": np.full((2, 1), (0.1 + 2.0 * math.pi - 6.2) / 0.1),
        "turned": np.array([0.0, 2.0 * math.pi]),
    }
    found = Dense(settled=False, stages=None).at(np.array([0.05]), times, states)
    assert found["angle"][0, 0] + found["turned"][0] == pytest.approx(0.5 * (6.2 + 0.1 + 2.0 * math.pi))


# -- runs -------------------------------------------------------------------------------------------------------------

SWING = """
name = "swing"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "{integrator}"
step = {step}
[base]
kind = "motor"
inertia = 0.01
[[joint]]
stiffness = 3.0
[[link]]
length = 0.3
mass = 0.2
inertia = 0.0015
[[input]]
name = "drive"
at = "base"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "position"
[[output]]
name = "pull"
at = "tip"
of = "acceleration"
[initial]
rates = 1.0
"""


def swing(integrator: str, step: float) -> Scene:
    return parse_scene(SWING.format(integrator=integrator, step=step))


@pytest.mark.parametrize("backend", ["numpy", pytest.param("c", marks=pytest.mark.compiler)])
@pytest.mark.parametrize("integrator", ["sdirk4", "gauss2"])
def test_rows_at_any_instants_lie_on_the_motion(integrator: str, backend: Backend) -> None:
    """Rows of long steps, at instants that are none of their multiples, beside the ends of short steps."""
    load = {"drive": Constant(0.3)}
    long, short = swing(integrator, 0.02), swing(integrator, 0.0025)
    run = simulate(long, load, 0.3, backend, judge=False, every=0.0075, trace=True)
    fine = simulate(short, load, 0.3, backend, judge=False)
    assert run.steps == 15
    np.testing.assert_allclose(run.time, 0.0075 * np.arange(41), atol=1e-15)
    assert run.trace is not None
    assert len(run.trace.angle) == len(run.time)
    own = simulate(long, load, 0.3, backend, judge=False)
    for name, values in fine.outputs.items():
        size = np.ptp(values)
        at_steps = np.max(np.abs(own.outputs[name] - values[::8])) / size
        between = np.max(np.abs(run.outputs[name] - values[::3])) / size
        assert between <= 3.0 * at_steps + 1e-5, name
        # every sixth step of both is at the same instant
        np.testing.assert_array_equal(run.outputs[name][::8], own.outputs[name][::3])


def test_which_polynomial_a_scene_has() -> None:
    kept = {"angle", "rate", "acceleration", "acceleration_stage1", "acceleration_stage2"}
    for name, settled in (
        ("newmark", True),
        ("sdirk4", True),
        ("generalized_alpha", False),
        ("wilson", False),
    ):
        assert dense(swing(name, 0.01), dict.fromkeys(kept, np.zeros(1))).settled is settled, name
    between = dense(swing("gauss2", 0.01), dict.fromkeys(kept - {"acceleration"}, np.zeros(1)))
    assert between.stages is not None


def test_rows_that_cannot_be() -> None:
    assert row_instants(1.0, 0.3).tolist() == pytest.approx([0.0, 0.3, 0.6, 0.9])
    for every in (2.0, 1e-9):
        with pytest.raises(UserError, match=r"--every") as caught:
            row_instants(1.0, every)
        row_instants(1.0, float(str(caught.value).split("--every ")[1].rstrip(".")))
