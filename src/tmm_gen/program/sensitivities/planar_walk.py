"""Walking in from the tip: forces and loads from given accelerations of the nodes."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive.elements import planar as element
from tmm_gen.program.planar.layout import PlanarLayout
from tmm_gen.program.planar.loads import COMPONENTS, PlanarLoads
from tmm_gen.program.statements import Assign
from tmm_gen.program.variables import Ref, Variable

AXES = ("x", "y")


def tip_forces(
    layout: PlanarLayout, nodes: Mapping[str, Variable], turning: sp.Expr, loads: PlanarLoads
) -> dict[str, sp.Expr]:
    """Return what the body at the tip asks of the last link, less what acts there, by component.

    Parameters
    ----------
    nodes : mapping from "x", "y" to Variable
        Accelerations of the nodes, base first.
    turning : sympy.Expr
        Angular acceleration of the last link.
    """
    law = chain.tip_law()
    values = {
        element.TIP_MASS: layout.tip_mass.ref if layout.tip_mass else sp.Integer(0),
        element.TIP_INERTIA: layout.tip_inertia.ref if layout.tip_inertia else sp.Integer(0),
        chain.A_X: nodes["x"].entry(layout.stations),
        chain.A_Y: nodes["y"].entry(layout.stations),
        chain.ACCELERATION: turning,
    }
    demands = (law.force_x, law.force_y, law.torque)
    return {c: d.xreplace(values) - loads.tip[c] for c, d in zip(COMPONENTS, demands, strict=True)}


def through_link(
    symbols: Mapping[sp.Symbol, sp.Expr], nodes: Mapping[str, Variable], force: Mapping[str, Ref]
) -> tuple[dict[str, sp.Expr], tuple[Assign, ...]]:
    """Carry a force over a link: the loads at its outer end, and the statements that move the force inward.

    Parameters
    ----------
    symbols : mapping from sympy.Symbol to sympy.Expr
        The derivation's symbols at link j.
    nodes : mapping from "x", "y" to Variable
        Accelerations of the nodes, base first.
    force : mapping from "x", "y" to Ref
        Force at the outer end, then at the inner one.
    """
    law = chain.link_law()
    values = {
        **symbols,
        chain.A_X: nodes["x"].at(0),
        chain.A_Y: nodes["y"].at(0),
        chain.OUTER_A_X: nodes["x"].at(1),
        chain.OUTER_A_Y: nodes["y"].at(1),
        chain.F_X: force["x"],
        chain.F_Y: force["y"],
    }
    loads = {"x": law.load_x.xreplace(values), "y": law.load_y.xreplace(values)}
    moved = {"x": law.force_x.xreplace(values), "y": law.force_y.xreplace(values)}
    return loads, tuple(Assign(force[axis], moved[axis]) for axis in AXES)


def inner_loads(loads: PlanarLoads, force: Mapping[str, Ref]) -> list[Assign]:
    """Return the statements that take off a force what acts at link j itself."""
    return [
        Assign(force[axis], force[axis] - loads.array(f"force_{axis}").at())
        for axis in AXES
        if f"force_{axis}" in loads.inner
    ]
