"""Jacobians of the CasADi model against Lagrange's equations, differentiated by CasADi from energies alone."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np
import pytest

from tmm_gen.native.python_module import casadi_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, station_of

STEP = 2e-3


def lagrange_residual(scene: Scene) -> ca.Function:
    """Return ``R(q, v, a, u)`` of Lagrange's equations from kinetic and potential energy."""
    hub = int(scene.base.kind == "motor")
    n = scene.stations + hub
    q, v, a = (ca.SX.sym(name, n) for name in "qva")
    u = ca.SX.sym("u", len(scene.inputs))
    x = y = kinetic = potential = work = 0
    nodes = [(0, 0)]
    g = scene.model.gravity or 0.0
    for i, (link, joint) in enumerate(zip(scene.links, scene.joints, strict=True)):
        angle = q[hub + i]
        inner = q[hub + i - 1] if hub + i else 0
        cx, cy = x + link.center * link.length * ca.cos(angle), y + link.center * link.length * ca.sin(angle)
        speed = ca.jtimes(ca.vertcat(cx, cy), q, v)
        kinetic += 0.5 * link.mass * ca.sumsqr(speed) + 0.5 * link.inertia * v[hub + i] ** 2
        potential += link.mass * g * cy + 0.5 * joint.stiffness * (angle - inner) ** 2
        x, y = x + link.length * ca.cos(angle), y + link.length * ca.sin(angle)
        nodes.append((x, y))
    if scene.tip:
        kinetic += 0.5 * scene.tip.mass * ca.sumsqr(ca.jtimes(ca.vertcat(x, y), q, v))
        kinetic += 0.5 * scene.tip.inertia * v[n - 1] ** 2
        potential += scene.tip.mass * g * y
    heat = 0
    for i, joint in enumerate(scene.joints):
        inner = v[hub + i - 1] if hub + i else 0
        heat += 0.5 * joint.damping * (v[hub + i] - inner) ** 2
    if hub:
        kinetic += 0.5 * scene.base.inertia * v[0] ** 2
        heat += 0.5 * scene.base.damping * v[0] ** 2
    for k, item in enumerate(scene.inputs):
        station = station_of(item.at, scene.stations)
        turned = q[hub + station - 1]
        work += (
            u[k] * {"torque": turned, "force_x": nodes[station][0], "force_y": nodes[station][1]}[item.acts]
        )
    momentum = ca.gradient(kinetic, v)
    rate = ca.jtimes(momentum, q, v) + ca.jtimes(momentum, v, a)
    residual = rate - ca.gradient(kinetic, q) + ca.gradient(potential - work, q) + ca.gradient(heat, v)
    return ca.Function("residual", [q, v, a, u], [residual])


@pytest.mark.parametrize("base", ["clamp", "motor"])
def test_jacobians_are_those_of_lagranges_equations(base: str, unlike: Callable[..., Scene]) -> None:
    """Newmark's step, iterated to convergence, solves ``R = 0``; its derivatives follow from those of ``R``."""
    outputs = [{"name": "tip", "at": "tip", "of": "position"}]
    scene = unlike(base, step=STEP, iterations=5).replace(output=outputs)
    program = build_program(scene)
    module = casadi_module(scene, program)
    step = module.step_function()
    hub = int(base == "motor")
    n = scene.stations + hub
    rng = np.random.default_rng(2)
    q, v, a = (rng.normal(size=n) * size for size in (0.3, 1.0, 3.0))
    u = rng.normal(size=len(scene.inputs))

    residual = lagrange_residual(scene)
    old = [ca.SX.sym(name, n) for name in ("q0", "v0", "a0")]
    new, load = ca.SX.sym("a1", n), ca.SX.sym("u", len(scene.inputs))
    at_end = (
        old[0] + STEP * old[1] + STEP**2 / 4.0 * (old[2] + new),
        old[1] + STEP / 2.0 * (old[2] + new),
        new,
    )
    implicit = ca.Function("implicit", [new, *old, load], [residual(*at_end, load)])
    solver = ca.rootfinder("solver", "newton", implicit, {"abstol": 1e-13})
    symbols = [*(ca.MX.sym(name, n) for name in ("q", "v", "a")), ca.MX.sym("u", len(scene.inputs))]
    solved = solver(symbols[2], *symbols)
    ends = ca.vertcat(
        symbols[0] + STEP * symbols[1] + STEP**2 / 4.0 * (symbols[2] + solved),
        symbols[1] + STEP / 2.0 * (symbols[2] + solved),
        solved,
    )
    theirs = ca.Function("theirs", symbols, [ends, *(ca.jacobian(ends, s) for s in symbols)])(q, v, a, u)

    order = [program.state.index(v) for v in program.state]
    assert order == sorted(order)
    places = {}
    start = 0
    for variable in program.state:
        places[variable.name] = range(start, start + (variable.length or 1))
        start += variable.length or 1
    rows = [
        k
        for kind in ("angle", "rate", "acceleration")
        for name in ([f"hub_{kind}", kind] if hub else [kind])
        for k in places[name]
    ]
    x = np.zeros(start)
    x[rows] = np.concatenate([q, v, a])
    jacobian = step.jacobian()
    zero = [ca.DM(*step.size_out(k)) for k in range(2)]
    p = module.default_parameters()
    found = dict(zip(jacobian.name_out(), jacobian(x, u, p, *zero), strict=True))
    after = np.array(step(x=x, u=u, p=p)["x_next"]).ravel()[rows]
    assert after == pytest.approx(np.array(theirs[0]).ravel(), rel=1e-10, abs=1e-10)
    by_x = np.array(found["jac_x_next_x"])[np.ix_(rows, rows)]
    by_u = np.array(found["jac_x_next_u"])[rows]
    expected = np.hstack([np.array(part) for part in theirs[1:4]])
    assert by_x == pytest.approx(expected, rel=1e-8, abs=1e-8 * np.max(np.abs(expected)))
    expected = np.array(theirs[4])
    assert by_u == pytest.approx(expected, rel=1e-8, abs=1e-8 * np.max(np.abs(expected)))
