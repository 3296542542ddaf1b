"""Motion of arms by parts against equations written apart, and what parts cost."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import Scene, parse_scene

ORDERS = [("newmark", 2, (2e-3, 1e-3)), ("sdirk4", 4, (1e-2, 5e-3))]
G = 9.81

PENDULUM = """
name = "pendulum"
[model]
kind = "planar"
gravity = 9.81
iterations = 2
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[joint]]
name = "first"
[[link]]
name = "inner"
on = "first"
length = 0.4
mass = 0.7
inertia = 0.012
center = 0.4
[[{second}]]
name = "second"
on = "inner"
{keys}
[[link]]
name = "outer"
on = "second"
length = 0.3
mass = 0.5
inertia = 0.005
center = 0.6
[[body]]
name = "bob"
on = "outer"
mass = 0.2
[[input]]
name = "torque"
at = "second"
acts = "torque"
[[output]]
name = "inner"
at = "inner"
of = "angle"
[[output]]
name = "outer"
at = "outer"
of = "angle"
[initial]
angles = [-0.3, 0.4]
rates = [0.5, -1.0]
"""


def exact(armature: float, torque: float, stiffness: float, rest: float, until: float) -> np.ndarray:
    """Return both angles at the end by Lagrange's equations of a double pendulum with a rotor between its links."""
    first = 0.012 + 0.7 * 0.16**2 + 0.7 * 0.4**2 + armature  # the outer link and the bob hang on 0.4 m
    second = 0.005 + 0.5 * 0.18**2 + 0.2 * 0.3**2 + armature
    coupling = (0.5 * 0.18 + 0.2 * 0.3) * 0.4
    weights = G * np.array([0.7 * 0.16 + 0.7 * 0.4, 0.5 * 0.18 + 0.2 * 0.3])

    def rates(_: float, x: np.ndarray) -> np.ndarray:
        a, b, u, v = x
        cross = coupling * np.cos(a - b) - armature
        mass = np.array([[first, cross], [cross, second]])
        swing = coupling * np.sin(a - b)
        between = torque - stiffness * (b - a - rest)
        force = np.array([-swing * v**2 - between, swing * u**2 + between]) - weights * np.cos([a, b])
        return np.array([u, v, *np.linalg.solve(mass, force)])

    start = np.array([-0.3, 0.4, 0.5, -1.0])
    return solve_ivp(rates, (0.0, until), start, rtol=1e-11, atol=1e-13, method="DOP853").y[:2, -1]


SECONDS = {
    "free hinges": ("joint", "", 0.0, 0.0, 0.0, 0.0),
    "a torque between": ("joint", "", 0.0, 0.3, 0.0, 0.0),
    "a slack angle": ("joint", "stiffness = 4.0\nrest = 0.5", 0.0, 0.3, 4.0, 0.5),
    "a motor": ("motor", "rotor_inertia = 2e-5\ngear = 30", 30**2 * 2e-5, 0.01, 0.0, 0.0),
    "a motor without inertia": ("motor", "gear = 30", 0.0, 0.01, 0.0, 0.0),
}


@pytest.mark.compiler
@pytest.mark.parametrize("second", SECONDS)
@pytest.mark.parametrize(("integrator", "order", "steps"), ORDERS)
def test_double_pendulum(second: str, integrator: str, order: int, steps: tuple[float, float]) -> None:
    table, keys, armature, torque, stiffness, rest = SECONDS[second]
    scene = parse_scene(PENDULUM.format(second=table, keys=keys)).replace(**{"integrator.name": integrator})
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    until = 0.5
    gear = 30.0 if table == "motor" else 1.0
    right = exact(armature, gear * torque, stiffness, rest, until)
    errors = []
    for step in steps:
        _, found = kernel.simulate(until, {"torque": torque}, step=step)
        errors.append(max(abs(found["inner"][-1] - right[0]), abs(found["outer"][-1] - right[1])))
    assert errors[1] < {2: 1e-4, 4: 1e-6}[order]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.4)


@pytest.mark.compiler
def test_a_hanging_chain_of_free_links_keeps_its_energy(hanging: Callable[..., Scene]) -> None:
    """Nothing resists in any joint: the pivots come from what is beyond alone."""
    energies = [{"name": k, "at": "arm", "of": f"{k}_energy"} for k in ("kinetic", "gravitational")]
    scene = hanging(12, output=energies, **{"initial.angles": -1.0, "integrator.name": "sdirk4"})
    kernel = compile_kernel(build_program(scene), scene, flags=("-O0",))
    drifts = []
    for step in (1e-3, 5e-4):
        _, found = kernel.simulate(0.3, {}, step=step)
        total = found["kinetic"] + found["gravitational"]
        drifts.append(np.ptp(total) / np.ptp(found["kinetic"]))
    assert drifts[1] < 1e-6
    assert drifts[0] / drifts[1] > 8.0


def operations(scene: Scene) -> int:
    return count_routine(build_program(scene).main).total


def test_a_motor_in_a_joint_costs_little(elbow_text: str) -> None:
    """At most 12 operations more than a joint with spring and damper; a free hinge costs less than one."""
    motor = '[[motor]]\nname = "elbow"\non = "upper"\nrotor_inertia = 1e-5\ngear = 50\ndamping = 0.01\n'
    torque = '[[input]]\nname = "elbow_torque"\nat = "elbow"\nacts = "torque"\n'
    assert motor in elbow_text
    plain = elbow_text.replace(torque, "")
    joint = '[[joint]]\nname = "elbow"\non = "upper"\nstiffness = 5.0\ndamping = 0.01\n'
    hinge = '[[joint]]\nname = "elbow"\non = "upper"\n'
    driven, sprung, free = (
        operations(parse_scene(text))
        for text in (elbow_text, plain.replace(motor, joint), plain.replace(motor, hinge))
    )
    assert driven - sprung == MOTOR_OVER_JOINT
    assert MOTOR_OVER_JOINT <= 12
    assert free <= sprung


MOTOR_OVER_JOINT = 2
"""Operations: an armature in place of a spring, its torque and its gear."""
