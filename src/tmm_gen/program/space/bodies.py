"""First moments and inertias about the joints' points, prepared once from masses and centres."""

from __future__ import annotations

from functools import cache

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
from tmm_gen.program.space.base_layout import BaseLayout
from tmm_gen.program.space.layout import SpaceLayout
from tmm_gen.program.statements import Assign, Loop, Order, Section, Statement
from tmm_gen.program.variables import Role, Variable

_CENTER = vector("center")
_CENTRAL = tuple(sp.Symbol(f"center_inertia_{pair}") for pair in PAIRS)
_MASS = sp.Symbol("mass")
_PLACES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@cache
def derived() -> dict[str, tuple[sp.Expr, str, str]]:
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
        for name, (value, doc, unit) in derived().items():
            written = sp.factor_terms(value.xreplace(symbols))
            if written == 0:
                continue
            variable = Variable(name, role, n, f"{doc}, of each body", unit)
            self.variables[name] = variable
            body.append(Assign(variable.at(), written))
        statements: list[Statement] = [Loop(Order.OUTWARD, 0, n, tuple(body))] if body else []
        self._base: dict[str, sp.Expr] = {}
        if layout.base:
            statements += self._of_base(layout.base, role)
        self.section = Section("bodies about the points of their joints", tuple(statements))

    def _of_base(self, layout: BaseLayout, role: Role) -> list[Assign]:
        """Return statements for what is derived of a base that floats."""
        own = {name: variable.ref for name, variable in layout.parameters.items()}
        self._base = {"mass": own["mass"]}
        symbols = {s: own.get(s.name, sp.Integer(0)) for s in (_MASS, *_CENTER, *_CENTRAL)}
        found = []
        for name, (value, doc, unit) in derived().items():
            written = sp.factor_terms(value.xreplace(symbols))
            if written == 0:
                continue
            variable = Variable(
                f"base_{name}", role, None, f"{doc}, of the base".replace("joint's point", "its origin"), unit
            )
            self.variables[variable.name] = variable
            self._base[name] = variable.ref
            found.append(Assign(variable.ref, written))
        return found

    @property
    def of_base(self) -> dict[sp.Symbol, sp.Expr]:
        """What stands for the mass, first moment and inertia of a base that floats."""
        return {sp.Symbol(name, real=True): value for name, value in self._base.items()}

    def at(self, offset: int) -> dict[str, sp.Expr]:
        """Return them at a station of a loop, by the names of the symbols that stand for them."""
        return {name: v.at(offset) for name, v in self.variables.items() if v.length is not None}
