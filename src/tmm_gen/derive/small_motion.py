"""The planar elements linearised about rest, and their balance there, from their own equations.

At rest nothing turns and, seen from a falling frame, every point accelerates upward by ``g``. What is left of
an element's equations is linear in the deviations, with the angle and the forces at rest as parameters.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.elements.declaration import Element, Port
from tmm_gen.derive.elements.planar import JOINT, LINK, TIP, TIP_INERTIA, planar_port

GRAVITY = sp.Symbol("g", nonnegative=True)
REST_ANGLE = sp.Symbol("theta_0", real=True)
REST_FORCES = {side: sp.symbols(f"F_x0_{side} F_y0_{side} M0_{side}", real=True) for side in ("in", "out")}
"""Forces at rest at either side of an element."""

HUB_DAMPING = sp.Symbol("b", nonnegative=True)
LOAD = sp.symbols("P_x P_y T", real=True)

_IN, _OUT = planar_port("in"), planar_port("out")

HUB = Element(
    name="planar_hub",
    source="Euler for a hub on a fixed bearing with viscous friction",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        _OUT.motions[0].a - _IN.motions[0].a,
        _OUT.motions[1].a - _IN.motions[1].a,
        _OUT.motions[2].q - _IN.motions[2].q,
        _OUT.forces[0] - _IN.forces[0],
        _OUT.forces[1] - _IN.forces[1],
        _IN.forces[2] - _OUT.forces[2] - TIP_INERTIA * _IN.motions[2].a - HUB_DAMPING * _IN.motions[2].v,
    ),
    parameters=(TIP_INERTIA, HUB_DAMPING),
)
"""Hub: inertia and friction between the base point and the first joint."""

EXTERNAL = Element(
    name="planar_load",
    source="balance of a massless node",
    inboard=_IN,
    outboard=_OUT,
    equations=(
        _OUT.motions[0].a - _IN.motions[0].a,
        _OUT.motions[1].a - _IN.motions[1].a,
        _OUT.motions[2].q - _IN.motions[2].q,
        *(_IN.forces[i] + LOAD[i] - _OUT.forces[i] for i in range(3)),
    ),
    inputs=LOAD,
)
"""External force and torque at a node."""


def linearised(element: Element) -> Element:
    """Return an element whose equations are those of small deviations from rest."""
    values = _rest(element.inboard, "in") | _rest(element.outboard, "out")
    symbols = (*values, *element.inputs)
    equations = []
    for equation in element.equations:
        within = [symbol for symbol in symbols if symbol in equation.free_symbols]
        equations.append(sp.Add(*(sp.diff(equation, each).subs(values) * each for each in within)))
    return Element(
        name=f"{element.name}_at_rest",
        source=element.source,
        inboard=element.inboard,
        outboard=element.outboard,
        equations=tuple(equations),
        parameters=(*element.parameters, REST_ANGLE, *REST_FORCES["in"], *REST_FORCES["out"]),
        inputs=element.inputs,
    )


@dataclass(frozen=True)
class RestBalance:
    """What holds an element at rest.

    Parameters
    ----------
    inner : 3 sympy.Expr
        ``F_x, F_y, M`` at the inner end from those at the outer end (``REST_FORCES["out"]``) and the angle.
    """

    inner: tuple[sp.Expr, sp.Expr, sp.Expr]


@cache
def rest_balance(element: Element) -> RestBalance:
    """Solve an element's equations at rest for its inner forces."""
    values = _rest(element.inboard, "in") | _rest(element.outboard, "out")
    values |= {signal: sp.Integer(0) for signal in element.inputs}
    unknown = REST_FORCES["in"]
    balance = [equation.subs(values) for equation in element.equations[3:]]
    solved = sp.solve(balance, unknown, dict=True)[0]
    return RestBalance(tuple(sp.expand(solved[force]) for force in unknown))


@cache
def rest_elements() -> dict[str, Element]:
    """Return the elements of an arm at rest by name: joint, link, tip, hub, load."""
    chosen = {"joint": JOINT, "link": LINK, "tip": TIP, "hub": HUB, "load": EXTERNAL}
    return {name: linearised(element) for name, element in chosen.items()}


def _rest(port: Port, side: str) -> dict[sp.Symbol, sp.Expr]:
    """Return the values of a port's symbols at rest."""
    x, y, theta = port.motions
    values: dict[sp.Symbol, sp.Expr] = {}
    for motion in (x, y, theta):
        values |= {motion.q: sp.Integer(0), motion.v: sp.Integer(0), motion.a: sp.Integer(0)}
    values[y.a] = GRAVITY
    values[theta.q] = REST_ANGLE
    return values | dict(zip(port.forces, REST_FORCES[side], strict=True))
