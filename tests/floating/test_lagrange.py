"""A floating arm against Lagrange's equations for its base and all its angles, written here and solved by SciPy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from tmm_gen.inputs.signals import Constant, Sine
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

pytestmark = pytest.mark.compiler

UNTIL = 0.4
WHEEL, THRUST, PUSH = 0.3, 0.5, -0.4
# mass, inertia, way to the centre: (length, which angle); angles: attitude, left, right, shin
BODIES = (
    (0.8, 0.02, (), 0),
    (0.3, 0.009, ((0.24, 1),), 1),
    (0.4, 0.01, ((0.25, 2),), 2),
    (0.2, 0.004, ((0.5, 2), (0.2, 3)), 3),
)
SPRINGS = ((20.0, 0.01, 1, 0, 3.0), (25.0, 0.0, 2, 0, 0.0), (5.0, 0.0, 3, 2, 0.0))


def accelerations(motion: Array, gravity: float, wheel: float) -> Array:
    """Solve for all six accelerations: x, y, then the angles."""
    q, v = motion[2:6], motion[8:12]
    mass, load = np.zeros((6, 6)), np.zeros(6)
    for m, inertia, way, turned in BODIES:
        jacobian, curved = np.zeros((2, 6)), np.zeros(2)
        jacobian[:, :2] = np.eye(2)
        for length, k in way:
            jacobian[:, 2 + k] = length * np.array([-np.sin(q[k]), np.cos(q[k])])
            curved -= length * v[k] ** 2 * np.array([np.cos(q[k]), np.sin(q[k])])
        mass += m * jacobian.T @ jacobian
        mass[2 + turned, 2 + turned] += inertia
        load -= m * jacobian.T @ (curved + np.array([0.0, gravity]))
    for stiffness, damping, outer, inner, rest in SPRINGS:
        torque = -stiffness * (q[outer] - q[inner] - rest) - damping * (v[outer] - v[inner])
        load[2 + outer] += torque
        load[2 + inner] -= torque
    load[2] += wheel
    load[0] += THRUST
    load[1] += PUSH  # at the end of the shin
    load[2 + 2] += PUSH * 0.5 * np.cos(q[2])
    load[2 + 3] += PUSH * 0.4 * np.cos(q[3])
    found: Array = np.linalg.solve(mass, load)
    return found


def exact(gravity: float) -> dict[str, float]:
    """Outputs at the end."""
    start = np.array([0, 0, 0, 2.5, 0.1, 0.6, 0, 0, 0, 0.5, -1.0, 2.0])
    signal = Sine(WHEEL, 2.0, 0.3)

    def rate(time: float, motion: Array) -> Array:
        return np.concatenate([motion[6:], accelerations(motion, gravity, float(signal.at(np.array(time))))])

    z = solve_ivp(rate, (0.0, UNTIL), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    a = accelerations(z, gravity, float(signal.at(np.array(UNTIL))))
    (x, y), q, v = z[:2], z[2:6], z[8:12]
    end = np.array([x + 0.5 * np.cos(q[2]) + 0.4 * np.cos(q[3]), y + 0.5 * np.sin(q[2]) + 0.4 * np.sin(q[3])])
    moving = z[6:8] + 0.5 * v[2] * np.array([-np.sin(q[2]), np.cos(q[2])])
    moving = moving + 0.4 * v[3] * np.array([-np.sin(q[3]), np.cos(q[3])])
    shin = a[:2].copy()
    for length, k in ((0.5, 2), (0.2, 3)):
        shin += length * a[2 + k] * np.array([-np.sin(q[k]), np.cos(q[k])])
        shin -= length * v[k] ** 2 * np.array([np.cos(q[k]), np.sin(q[k])])
    force = 0.2 * (shin + np.array([0.0, gravity])) - np.array([0.0, PUSH])
    kinetic, height = 0.0, 0.0
    for m, inertia, way, turned in BODIES:
        place, velocity = np.array([x, y]), z[6:8].copy()
        for length, k in way:
            place = place + length * np.array([np.cos(q[k]), np.sin(q[k])])
            velocity += length * v[k] * np.array([-np.sin(q[k]), np.cos(q[k])])
        kinetic += 0.5 * m * velocity @ velocity + 0.5 * inertia * v[turned] ** 2
        height += m * gravity * place[1]
    vectors = {"hub": z[:2], "drift": z[6:8], "jerk": a[:2], "end": end, "end_velocity": moving}
    vectors["knee_force"] = force
    found = {f"{name}_{axis}": value[k] for name, value in vectors.items() for k, axis in enumerate("xy")}
    return found | {"attitude": q[0], "kinetic": kinetic, "height": height}


SIGNALS = {"wheel": Sine(WHEEL, 2.0, 0.3), "thruster": Constant(THRUST), "push": Constant(PUSH)}


@pytest.mark.parametrize("gravity", [0.0, 9.81])
def test_the_reference_is_right(gravity: float, drifter: Callable[..., Scene]) -> None:
    """It has no coordinates for the base: the centre of mass moves as forces push it."""
    found = planar_response(drifter(gravity=gravity), SIGNALS, np.array([0.1, UNTIL]))
    right = exact(gravity)
    assert set(found) == set(right)
    for name, value in right.items():
        assert found[name][-1] == pytest.approx(value, rel=1e-9, abs=1e-9), name


def ended(kernel: NativeKernel, step: float) -> dict[str, float]:
    """Return the outputs of the compiled kernel at the end."""
    kernel.prepare(step=step)
    kernel.initialise({name: float(signal.at(np.array(0.0))) for name, signal in SIGNALS.items()})
    (instants,) = kernel.program.stage_instants
    for index in range(round(UNTIL / step)):
        times = step * (index + np.array(instants))
        values = {name: signal.at(times) for name, signal in SIGNALS.items()}
        kernel.step(values if len(instants) > 1 else {name: float(v[0]) for name, v in values.items()})
    return {name: float(value) for name, value in kernel.output().items()}


@pytest.mark.parametrize("gravity", [0.0, 9.81])
@pytest.mark.parametrize(
    ("integrator", "order"),
    [("newmark", 2), ("generalized-alpha", 2), ("bathe", 2), ("sdirk2", 2), ("sdirk4", 4)],
)
def test_orders(integrator: str, order: int, gravity: float, drifter: Callable[..., Scene]) -> None:
    """Places of the base come with the order that angles have."""
    right, scene = exact(gravity), drifter(integrator, gravity)
    steps = [4e-3, 2e-3, 1e-3] if order > 2 else [1e-3, 5e-4, 2.5e-4]
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    each = [ended(kernel, step) for step in steps]
    assert max(fall_with(order, steps, each, right)) < 5e-4


def fall_with(
    order: int, steps: list[float], each: list[dict[str, float]], right: dict[str, float]
) -> list[float]:
    """Assert that errors of places and of the attitude fall with a power of the step; return the last ones."""
    last = []
    for names in (("hub_x", "hub_y"), ("end_x", "end_y"), ("attitude",)):
        errors = [float(np.linalg.norm([found[n] - right[n] for n in names])) for found in each]
        slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
        assert slope == pytest.approx(order, abs=0.3), names
        last.append(errors[-1])
    return last


@pytest.mark.parametrize(
    ("integrator", "iterations", "order"),
    [("radau2", 2, 3), ("radau3", 3, 5), ("gauss2", 3, 4), ("gauss3", 5, 6)],
)
def test_orders_of_stages_solved_at_once(
    integrator: str, iterations: int, order: int, drifter: Callable[..., Scene]
) -> None:
    """With so many iterations that nothing is left of where they begin."""
    scene = drifter(integrator, 9.81, **{"model.iterations": iterations})
    steps = [4e-3, 2e-3, 1e-3] if order < 5 else [8e-3, 4e-3, 2e-3]
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    last = fall_with(order, steps, [ended(kernel, step) for step in steps], exact(9.81))
    assert max(last) < (1e-5 if order == 3 else 1e-7)
