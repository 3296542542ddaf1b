"""Where a planar arm's inputs act."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind
from tmm_gen.program.inputs import prescribed_motion
from tmm_gen.program.statements import Assign, Loop, Order, Statement
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene, station_of

COMPONENTS = ("force_x", "force_y", "torque")
_UNITS = {"force_x": "N", "force_y": "N", "torque": "N m"}


@dataclass(frozen=True)
class PlanarLoads:
    """Inputs by place.

    Parameters
    ----------
    tip : dict from "force_x", "force_y", "torque" to sympy.Expr
        At the last link.
    base : sympy.Expr
        Torque at the hub.
    motion : dict from "q", "v", "a" to sympy.Expr
        Angle, rate and acceleration of a prescribed base; empty for other bases.
    inner : dict from component to tuple of (int, sympy.Expr)
        At other links, by index from 0; forces act at the link's outer end.
    stations : int
        Number of links.
    """

    tip: dict[str, sp.Expr]
    base: sp.Expr
    motion: dict[Kind, sp.Expr]
    inner: dict[str, tuple[tuple[int, sp.Expr], ...]]
    stations: int

    def array(self, component: str) -> Variable:
        """Return the scratch array of one component."""
        return Variable(
            f"load_{component}",
            Role.WORK,
            self.stations,
            f"external {component} on each link",
            _UNITS[component],
        )

    def statements(self) -> tuple[Statement, ...]:
        """Return the statements that fill the arrays of inner loads."""
        filled: list[Statement] = []
        for component, places in self.inner.items():
            array = self.array(component)
            filled.append(Loop(Order.OUTWARD, 0, self.stations, (Assign(array.at(), sp.Integer(0)),)))
            filled += [Assign(array.entry(index), value) for index, value in places]
        return tuple(filled)


def planar_loads(scene: Scene, inputs: tuple[Variable, ...], stage: int) -> PlanarLoads:
    """Sort a scene's inputs by the place they act at, read at an instant (from 0) of the step."""
    n = scene.stations
    tip = dict.fromkeys(COMPONENTS, sp.Integer(0))
    inner: dict[str, dict[int, sp.Expr]] = {}
    base = sp.Integer(0)
    by_name = {variable.name: variable for variable in inputs}
    for described in scene.inputs:
        value = by_name[described.name].entry(stage)
        link = station_of(described.at, n)
        if described.acts == "angle":
            continue
        if link == 0:
            base += value
        elif link == n:
            tip[described.acts] += value
        else:
            places = inner.setdefault(described.acts, {})
            places[link - 1] = places.get(link - 1, sp.Integer(0)) + value
    return PlanarLoads(
        tip=tip,
        base=base,
        motion=prescribed_motion(scene, inputs, stage),
        inner={c: tuple(sorted(inner[c].items())) for c in COMPONENTS if c in inner},
        stations=n,
    )
