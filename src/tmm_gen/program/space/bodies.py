"""First moments and inertias about the joints' points, prepared once from masses and centres."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.declaration import (
    AXES,
    OMEGA,
    PAIRS,
    VELOCITY,
    about_center,
    symmetric,
    vector,
)
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.statements import Assign, Loop, Order, Section
from tmm_gen.program.variables import Role, Variable

_CENTER = vector("center")
_CENTRAL = tuple(sp.Symbol(f"center_inertia_{pair}") for pair in PAIRS)
_MASS = sp.Symbol("mass")
_PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def _derived() -> dict[str, tuple[sp.Expr, str, str]]:
    """Return what a body's kinetic energy is made of, by the velocity of the joint's point."""
    energy = sp.expand(about_center(_MASS, _CENTER, symmetric(_CENTRAL)))
    found: dict[str, tuple[sp.Expr, str, str]] = {}
    for k, axis in enumerate(AXES):
        i, j = (k + 1) % 3, (k + 2) % 3
        moment = sp.diff(energy, VELOCITY[i], OMEGA[j])
        found[f"first_moment_{axis}"] = (moment, f"mass times its centre along {axis}", "kg m")
    for pair, (i, j) in zip(PAIRS, _PLACES, strict=True):
        inertia = sp.diff(energy, OMEGA[i], OMEGA[j])
        found[f"inertia_{pair}"] = (inertia, f"inertia about the joint's point, {pair}", "kg m^2")
    return found


DERIVED = _derived()


class Bodies:
    """Variables for what is derived of bodies, and the statements that compute it.

    Parameters
    ----------
    layout : SpaceLayout
        The arm's variables.
    role : Role
        Kept in the model, or scratch of the start.
    """

    def __init__(self, layout: SpaceLayout, role: Role) -> None:
        n = layout.stations
        self.variables: dict[str, Variable] = {}
        body: list[Assign] = []
        symbols = {s: layout.at(s.name, None) for s in (_MASS, *_CENTER, *_CENTRAL)}
        for name, (value, doc, unit) in DERIVED.items():
            written = sp.factor_terms(value.xreplace(symbols))
            if written == 0:
                continue
            variable = Variable(name, role, n, f"{doc}, of each body", unit)
            self.variables[name] = variable
            body.append(Assign(variable.at(), written))
        loop = (Loop(Order.OUTWARD, 0, n, tuple(body)),) if body else ()
        self.section = Section("bodies about the points of their joints", loop)

    def at(self, offset: int) -> dict[str, sp.Expr]:
        """Return them at a station of a loop, by the names of the symbols that stand for them."""
        return {name: variable.at(offset) for name, variable in self.variables.items()}
