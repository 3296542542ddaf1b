"""A new element for a planar arm, added here alone: a pin with a geared motor between two links."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.planar import DAMPING, STIFFNESS, planar_port
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.program.arm.assemble import Choices, build
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.sensitivities.walks import TangentableWalks
from tmm_gen.program.statements import Program
from tmm_gen.row.row import Load, Parameter, Signal
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene, parse_scene

# -- the element: all there is to it ---------------------------------------------------------------------------

ROTOR, RATIO, DRIVE = sp.symbols("J r T", real=True)
_IN, _OUT = planar_port("in"), planar_port("out")
(_x_in, _y_in, _in), (_x_out, _y_out, _out) = _IN.motions, _OUT.motions
_SPIN_UP = ROTOR * (_in.a + RATIO * (_out.a - _in.a))
_SPRING = STIFFNESS * (_in.q - _out.q) + DAMPING * (_in.v - _out.v)

MOTOR_PIN = Element(
    name="motor_pin",
    source="Lagrange for a rotor on the inner link that turns r times as fast as the pin, with the pin's own spring",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        _x_out.q - _x_in.q,
        _y_out.q - _y_in.q,
        _OUT.forces[0] - _IN.forces[0],
        _OUT.forces[1] - _IN.forces[1],
        _OUT.forces[2] - _SPRING - RATIO * (DRIVE - _SPIN_UP),
        _IN.forces[2] - _OUT.forces[2] - _SPIN_UP,
    ),
    parameters=(STIFFNESS, DAMPING, ROTOR, RATIO),
    inputs=(DRIVE,),
)

# -- an arm with one, and what it should do --------------------------------------------------------------------

J, R, TORQUE, GRAVITY, UNTIL = 2e-4, 12.0, 0.3, 9.81, 0.3
JOINTS = ((30.0, 0.2), (8.0, 0.05))
LINKS = ((0.7, 0.4, 0.012, 0.4), (0.5, 0.3, 0.005, 0.6))  # mass, length, inertia, centre
TIP = 0.2

SCENE = """
name = "driven"
[model]
kind = "planar"
gravity = {gravity}
[integrator]
name = "{integrator}"
step = 1e-3
[base]
kind = "clamp"
{stations}
[tip]
mass = {tip}
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


def scene_of(name: str) -> Scene:
    stations = "".join(f"[[joint]]\nstiffness = {k}\ndamping = {c}\n" for k, c in JOINTS)
    stations += "".join(
        f"[[link]]\nmass = {m}\nlength = {length}\ninertia = {i}\ncenter = {c}\n" for m, length, i, c in LINKS
    )
    return parse_scene(SCENE.format(gravity=GRAVITY, integrator=name, stations=stations, tip=TIP))


def driven(scene: Scene, *, sensitivities: bool = False) -> Program:
    """Put the motor in the place of the second pin."""
    chosen = integrator(scene.integrator.name)
    row = row_of(scene, chosen)
    torque = sp.Symbol("motor_torque")
    names = {
        STIFFNESS: sp.Symbol("stiffness"),
        DAMPING: sp.Symbol("damping"),
        ROTOR: sp.Symbol("rotor_inertia"),
        RATIO: sp.Symbol("gear_ratio"),
        DRIVE: torque,
    }
    motor = MOTOR_PIN.with_values(names)
    more = (
        Parameter("rotor_inertia", "inertia of the rotor", "kg m^2", (J,)),
        Parameter("gear_ratio", "turns of the rotor per turn of the pin", "1", (R,)),
    )
    row = replace(
        row,
        stations=(row.stations[0], (motor, *row.stations[1][1:])),
        detail=(row.detail[0], (motor, *row.detail[1][1:])),
        parameters=(*row.parameters, *more),
        inputs=(Signal("drive", "torque of the motor", "N m"),),
        loads=(Load(torque, "torque of the motor", "N m", ((None, "drive"),)),),
    )
    walks = TangentableWalks if sensitivities else Walks
    return build(row, chosen, Choices(scene.integrator.step, walks=walks, sensitivities=sensitivities))


def exact() -> np.ndarray:
    """Return angles at the end, by Lagrange's equations written here by hand."""
    (m1, l1, i1, k1), (m2, l2, i2, k2) = LINKS
    coupling = (m2 * k2 + TIP) * l1 * l2
    first = i1 + m1 * (k1 * l1) ** 2 + (m2 + TIP) * l1**2 + (1 - R) ** 2 * J
    second = i2 + m2 * (k2 * l2) ** 2 + TIP * l2**2 + R**2 * J

    def rates(_: float, x: np.ndarray) -> np.ndarray:
        a, b, u, v = x
        cross = coupling * np.cos(a - b) + R * (1 - R) * J
        mass = np.array([[first, cross], [cross, second]])
        swing = coupling * np.sin(a - b)
        pull = GRAVITY * np.array([(m1 * k1 + m2 + TIP) * l1 * np.cos(a), (m2 * k2 + TIP) * l2 * np.cos(b)])
        root = -JOINTS[0][0] * a - JOINTS[0][1] * u
        bent = JOINTS[1][0] * (b - a) + JOINTS[1][1] * (v - u)
        force = np.array([root + bent - R * TORQUE - swing * v**2, -bent + R * TORQUE + swing * u**2]) - pull
        return np.array([u, v, *np.linalg.solve(mass, force)])

    return solve_ivp(rates, (0.0, UNTIL), np.zeros(4), rtol=1e-11, atol=1e-13).y[:2, -1]


@pytest.mark.compiler
@pytest.mark.parametrize(("name", "bound"), [("sdirk4", 1e-7), ("newmark", 2e-4)])
def test_it_runs_right_in_c_and_numpy(name: str, bound: float, run_numpy: Callable[..., Any]) -> None:
    scene = scene_of(name)
    program = driven(scene)
    steps = round(UNTIL / 1e-3)
    native = compile_kernel(program, scene, flags=("-O1",))
    native.prepare()
    stages = len(program.stage_instants[-1])
    native.initialise({"drive": TORQUE})
    for _ in range(steps):
        native.step({"drive": np.full(stages, TORQUE) if stages > 1 else TORQUE})
    right = exact()
    assert np.abs(right).max() > 0.1
    assert np.abs(np.array(native.state["angle"]) - right).max() < bound
    state = run_numpy(program, scene, {"drive": TORQUE}, steps)
    assert np.abs(np.array(state.angle) - right).max() < bound


def test_derivatives_of_a_step_with_it_are_refused_with_a_remedy() -> None:
    scene = scene_of("newmark")
    with pytest.raises(UserError, match=r"motor_pin.* Set emit\.sensitivities = false\."):
        driven(scene, sensitivities=True)
    driven(scene)  # the remedy
