"""A new element for a chain, added here alone: a gear pair whose teeth give way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from tmm_gen.derive.elements.declaration import Element, torsion_port
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.program.arm.assemble import Choices, build
from tmm_gen.program.arm.product import ProductWalks
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.passes.lifetimes import read_before_written
from tmm_gen.program.statements import Program
from tmm_gen.row.row import Parameter
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene, parse_scene

# -- the element: all there is to it ---------------------------------------------------------------------------

MESH_STIFFNESS, MESH_DAMPING, RATIO = sp.symbols("k c r", positive=True)
_IN, _OUT = torsion_port("in"), torsion_port("out")
_inner, _outer = _IN.motions[0], _OUT.motions[0]
_MESH = MESH_STIFFNESS * (_outer.q - RATIO * _inner.q) + MESH_DAMPING * (_outer.v - RATIO * _inner.v)

GEAR_PAIR = Element(
    name="gear_pair",
    source="virtual work of a mesh that is pressed by theta_out - r theta_in",
    inboard=_IN,
    outboard=_OUT,
    equations=(_OUT.forces[0] - _MESH, _IN.forces[0] - RATIO * _OUT.forces[0]),
    parameters=(MESH_STIFFNESS, MESH_DAMPING, RATIO),
    energies={"elastic": MESH_STIFFNESS * (_outer.q - RATIO * _inner.q) ** 2 / 2},
)

# -- an arm with one, and what it should do --------------------------------------------------------------------

VALUES = {"mesh_stiffness": 900.0, "mesh_damping": 1.5, "ratio": -2.5}
JOINTS, LINKS, HUB = ((40.0, 0.3), (1.0, 0.0), (60.0, 0.2)), (0.8, 0.3, 0.5), (0.6, 0.1)
UNTIL, TORQUE = 0.5, 3.0

SCENE = """
name = "geared"
[model]
kind = "chain"
[integrator]
name = "{integrator}"
step = 1e-3
[base]
{base}
{stations}
[[input]]
name = "push"
at = "tip"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
"""
BASES = {"clamp": 'kind = "clamp"', "motor": f'kind = "motor"\ninertia = {HUB[0]}\ndamping = {HUB[1]}'}


def scene_of(base: str, name: str) -> Scene:
    stations = "".join(
        f"[[joint]]\nstiffness = {k}\ndamping = {c}\n[[link]]\ninertia = {inertia}\n"
        for (k, c), inertia in zip(JOINTS, LINKS, strict=True)
    )
    return parse_scene(SCENE.format(base=BASES[base], integrator=name, stations=stations))


def geared(scene: Scene, walks: type[Walks] = Walks) -> Program:
    """Put the gear pair in the place of the second spring."""
    chosen = integrator(scene.integrator.name)
    row = row_of(scene, chosen)
    names = dict(zip(GEAR_PAIR.parameters, (sp.Symbol(n) for n in VALUES), strict=True))
    station = (GEAR_PAIR.with_values(names), *row.stations[1][1:])
    stations = (row.stations[0], station, row.stations[2])
    parameters = tuple(Parameter(name, name.replace("_", " "), "1", (v,)) for name, v in VALUES.items())
    row = replace(row, stations=stations, detail=stations, parameters=(*row.parameters, *parameters))
    return build(row, chosen, Choices(scene.integrator.step, walks=walks))


def exact(base: str) -> np.ndarray:
    """Return angles at the end, by the equations of motion written here by hand."""
    inertia = np.array([HUB[0], *LINKS])
    r = VALUES["ratio"]
    springs = [(JOINTS[0], 1.0), ((VALUES["mesh_stiffness"], VALUES["mesh_damping"]), r), (JOINTS[2], 1.0)]

    def rates(_: float, x: np.ndarray) -> np.ndarray:
        angles, speeds = x[:4].copy(), x[4:].copy()
        torque = np.array([-HUB[1] * speeds[0], 0.0, 0.0, TORQUE])
        for i, ((k, c), ratio) in enumerate(springs):
            pressed = k * (angles[i + 1] - ratio * angles[i]) + c * (speeds[i + 1] - ratio * speeds[i])
            torque[i] += ratio * pressed
            torque[i + 1] -= pressed
        acceleration = torque / inertia
        if base == "clamp":
            speeds[0] = acceleration[0] = 0.0
        return np.concatenate([speeds, acceleration])

    return solve_ivp(rates, (0.0, UNTIL), np.zeros(8), rtol=1e-11, atol=1e-13).y[1:4, -1]


@pytest.mark.compiler
@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("name", ["sdirk4", "zhai"])
def test_it_runs_right_in_c_and_numpy(base: str, name: str, run_numpy: Callable[..., Any]) -> None:
    scene = scene_of(base, name)
    program = geared(scene)
    for routine in (program.prepare, program.initialise, *program.steps, program.output):
        assert read_before_written(routine) is None, routine.name
    right = exact(base)
    native = compile_kernel(program, scene, flags=("-O1",))
    native.prepare()
    stages = len(program.stage_instants[-1])
    acting = {"push": np.full(stages, TORQUE) if stages > 1 else TORQUE}
    native.initialise({"push": TORQUE})
    for _ in range(round(UNTIL / 1e-3)):
        native.step(acting)
    scale = np.abs(right).max()
    bound = {"sdirk4": 1e-7, "zhai": 1e-4}[name] * scale
    assert np.abs(np.array(native.state["angle"]) - right).max() < bound
    state = run_numpy(program, scene, {"push": TORQUE}, round(UNTIL / 1e-3))
    assert np.abs(np.array(state.angle) - right).max() < bound


def test_a_plain_product_over_it_is_refused_with_a_remedy() -> None:
    scene = scene_of("clamp", "newmark")
    with pytest.raises(UserError, match=r"gear_pair.* Set model\.sweep = \"riccati\"\."):
        geared(scene, ProductWalks)
    geared(scene)  # the remedy


def test_a_gear_without_compliance_is_refused_with_a_remedy() -> None:
    rigid = replace(
        GEAR_PAIR, equations=(_outer.q - RATIO * _inner.q, _IN.forces[0] - RATIO * _OUT.forces[0])
    )
    scene = scene_of("clamp", "newmark")
    chosen = integrator(scene.integrator.name)
    row = row_of(scene, chosen)
    station = (*row.stations[1], rigid.with_values({RATIO: sp.Integer(2)}))
    stations = (row.stations[0], station, row.stations[2])
    with pytest.raises(UserError, match="Let it give way there"):
        build(replace(row, stations=stations, detail=stations), chosen, Choices(scene.integrator.step))


def test_its_factors_belong_to_prepare() -> None:
    program = geared(scene_of("motor", "newmark"))
    assert {"admittance", "transmission", "reflection"} <= {v.name for v in program.coefficients}
    assert not any(str(a.target).startswith("impedance") for a in program.main.assignments())
