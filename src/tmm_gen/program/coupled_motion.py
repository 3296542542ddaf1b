"""Where motion stands while stages are solved at once: the state, accelerations at the stages, what is being sought."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind, Past
from tmm_gen.program.statements import Assign, Loop, Order, Statement
from tmm_gen.program.variables import Ref, Role, Variable


@dataclass(frozen=True)
class Place:
    """Where motion stands of the stations, in a loop over them, or of the hub.

    Parameters
    ----------
    history : mapping from Past to Variable
    stages : tuple of Variable
        Accelerations at the stages of the last step.
    trial : Ref
        Acceleration as known so far, one for each lane.
    solved : Ref
        What sweeps find.
    prefix : str
        Of names.
    """

    history: Mapping[Past, Variable]
    stages: tuple[Variable, ...]
    trial: Ref
    solved: Ref
    prefix: str = ""

    def before(self, kind: Kind) -> sp.Expr:
        """Return the motion at the start of the step."""
        return self.history[Past(kind, 0)].at()


def first_stages(stages: Sequence[Variable], newest: Variable) -> list[Statement]:
    """Let the first step be predicted by the acceleration at the start."""
    body = tuple(Assign(v.at(), newest.at()) for v in stages if v != newest)
    if newest.length is None or not body:
        return list(body)
    return [Loop(Order.OUTWARD, 0, newest.length, body)]


def trial_acceleration(whose: str, length: int | None) -> Ref:
    """Return what stands for the acceleration of something as known so far.

    Parameters
    ----------
    whose : str
        "hub", "each link" or "each joint".
    length : int or None
        Of the array; None of a scalar.
    """
    name = "trial_acceleration" if length else f"{whose}_trial_acceleration"
    doc = f"acceleration of {'the ' * (not length)}{whose} as known so far"
    return Variable(name, Role.WORK if length else Role.LOCAL, length, doc, "rad/s^2").at()
