"""Where a base that floats starts from: given, with a quaternion of any length."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import CONSISTENT_START, past
from tmm_gen.derive.space.declaration import AXES
from tmm_gen.program.space.base import BaseStep
from tmm_gen.program.space.base_layout import PARTS, BaseLayout
from tmm_gen.program.statements import Assign, Require, Statement
from tmm_gen.program.variables import Ref, Variable, local


def start_of_base(layout: BaseLayout, step: Variable) -> BaseStep:
    """Return the start as a step of no length: from what is given, with accelerations that satisfy the equations."""
    zero, given = sp.Integer(0), layout.given
    sources = {}
    for k, axis in enumerate(AXES):
        place, velocity, omega = (given[name].entry(k) for name in ("place", "velocity", "omega"))
        sources[f"place_{axis}"] = {past("q"): place, past("v"): velocity, past("a"): zero}
        sources[f"turn_{axis}"] = {past("q"): zero, past("v"): omega, past("a"): zero}
    return BaseStep(layout.newest_only, step, CONSISTENT_START, sources, sp.Matrix([_unit(p) for p in PARTS]))


def unit_start(layout: BaseLayout) -> list[Statement]:
    """Return the given quaternion at length one; one of no length is no turn."""
    entries = [layout.given["quaternion"].entry(k) for k in range(4)]
    squared = local("start_squared", "square of the given quaternion's length")
    scale = local("start_scale", "what makes its length one")
    return [
        Assign(squared, sp.Add(*(entry**2 for entry in entries))),
        Require(squared),
        Assign(scale, 1 / sp.sqrt(squared)),
        *(Assign(_unit(part), scale * entry) for part, entry in zip(PARTS, entries, strict=True)),
    ]


def _unit(part: str) -> Ref:
    return local(f"start_quaternion_{part}", f"quaternion to start from, of length one, {part}")
