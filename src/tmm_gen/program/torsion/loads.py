"""Where a chain's inputs act."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind
from tmm_gen.program.inputs import prescribed_motion
from tmm_gen.program.statements import Assign, Loop, Order, Statement
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class Loads:
    """Inputs by place.

    Parameters
    ----------
    tip, base : sympy.Expr
        Torque at the last link and at the hub.
    motion : dict from "q", "v", "a" to sympy.Expr
        Angle, rate and acceleration of a prescribed base; empty for other bases.
    inner : tuple of (int, sympy.Expr)
        Torques at other links, by index from 0.
    array : Variable
        Torque on each link, used only where there are inner loads.
    """

    tip: sp.Expr
    base: sp.Expr
    motion: dict[Kind, sp.Expr]
    inner: tuple[tuple[int, sp.Expr], ...]
    array: Variable

    def statements(self) -> tuple[Statement, ...]:
        """Return the statements that fill the array of inner loads."""
        if not self.inner:
            return ()
        n = self.array.length or 0
        zeros = Loop(Order.OUTWARD, 0, n, (Assign(self.array.at(), sp.Integer(0)),))
        return (zeros, *(Assign(self.array.entry(index), torque) for index, torque in self.inner))


def loads_of(scene: Scene, inputs: tuple[Variable, ...], stage: int) -> Loads:
    """Sort a scene's inputs by the place they act at, read at an instant (from 0) of the step."""
    n = scene.stations
    places: dict[str | int, sp.Expr] = {}
    by_name = {variable.name: variable for variable in inputs}
    for described in scene.inputs:
        if described.acts != "angle":
            place: str | int = "tip" if described.at == n else described.at
            places[place] = places.get(place, sp.Integer(0)) + by_name[described.name].entry(stage)
    zero = sp.Integer(0)
    return Loads(
        tip=places.get("tip", zero),
        base=places.get("base", zero),
        motion=prescribed_motion(scene, inputs, stage),
        inner=tuple(
            (place - 1, torque) for place, torque in sorted(places.items(), key=str) if isinstance(place, int)
        ),
        array=Variable("load", Role.WORK, n, "external torque on each link but the last", "N m"),
    )
