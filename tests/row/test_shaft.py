"""A shaft without mass is eliminated before the sweep: the same motion as with a station of its own, for less."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.elements.nodes import GRAVITY, MASS_AT_NODE, POINT_MASS
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.native import compile_kernel
from tmm_gen.program.arm.assemble import Choices, build
from tmm_gen.row.row import Row
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene, parse_scene

ARM = """
name = "arm"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "{integrator}"
step = 1e-3
[base]
kind = "motor"
inertia = 0.05
[[motor]]
name = "shoulder"
on = "base"
rotor_inertia = 4e-5
gear = 50
stiffness = 90.0
damping_time = 1e-3
[[link]]
name = "inner"
on = "shoulder"
length = 0.4
mass = 0.7
inertia = 0.012
[[motor]]
name = "elbow"
on = "inner"
rotor_inertia = 2e-5
gear = 30
damping = 0.02
stiffness = 40.0
[[link]]
name = "outer"
on = "elbow"
length = 0.3
mass = 0.5
inertia = 0.005
center = 0.3
[[motor]]
name = "side"
on = "inner"
rotor_inertia = 1e-5
gear = 40
stiffness = 60.0
[[link]]
name = "finger"
on = "side"
length = 0.2
mass = 0.1
inertia = 4e-4
[[input]]
name = "torque"
at = "elbow"
acts = "torque"
[[output]]
name = "outer"
at = "outer"
of = "position"
[[output]]
name = "finger"
at = "finger"
of = "position"
[[output]]
name = "elbow"
at = "elbow"
of = "torque"
"""
SHAFTS = {0, 2, 4}


def rows(name: str) -> tuple[Scene, Row, Row]:
    """Return an arm with three shafts, and its row as it is and with the mass of a node on each shaft."""
    scene = parse_scene(ARM.format(integrator=name))
    row = row_of(scene, integrator(name))
    mass = MASS_AT_NODE.with_values({POINT_MASS: sp.Symbol("node_mass"), GRAVITY: sp.Symbol("gravity")})
    kept = tuple((*station, mass) if k in SHAFTS else station for k, station in enumerate(row.stations))
    return scene, row, replace(row, stations=kept)


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("name", "step"), [("newmark", 1e-3), ("zhai", 2e-5), ("park", 1e-3), ("sdirk4", 2e-3)]
)
def test_motion_is_that_with_a_station_of_its_own(name: str, step: float) -> None:
    scene, *both = rows(name)
    assert [set(row.shafts) for row in both] == [SHAFTS, set()]
    ends = []
    for row in both:
        program = build(row, integrator(name), Choices(step))
        kernel = compile_kernel(program, scene, flags=("-O0",))
        ends.append({k: v[-1] for k, v in kernel.simulate(0.04, {"torque": 0.02}, step=step)[1].items()})
    for output, value in ends[0].items():
        assert value == pytest.approx(ends[1][output], rel=1e-10, abs=1e-11), output


def test_a_shaft_whose_sides_feel_different_torques_keeps_its_station() -> None:
    _, row, _ = rows("newmark")
    (pin,) = row.stations[2]
    inner = pin.inboard.forces[-1]
    lossy: Element = replace(pin, equations=tuple(e.subs(inner, 2 * inner) for e in pin.equations))
    changed = replace(row, stations=(*row.stations[:2], (lossy,), *row.stations[3:]))
    assert set(changed.shafts) == SHAFTS - {2}
    assert changed.swept()[2:4] == changed.stations[2:4]
    assert changed.swept()[0] == ()
