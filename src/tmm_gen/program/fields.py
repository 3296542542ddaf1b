"""Variables that every kind of model shares: the history an integrator needs, parameters that may differ or not."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Integrator, Kind, Past, Scheme
from tmm_gen.derive.integrators.relations import Unknown, affine_motion
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.statements import Routine
from tmm_gen.program.variables import Role, Variable
from tmm_gen.units import quotient

MOTION_NAMES: dict[Kind, tuple[str, str]] = {
    "q": ("angle", "rad"),
    "v": ("rate", "rad/s"),
    "a": ("acceleration", "rad/s^2"),
}
_AGO = {1: "one step", 2: "two steps", 3: "three steps"}


def state_variable(past: Past, prefix: str, length: int | None) -> Variable:
    """Return the variable of one value of the history."""
    name, unit = MOTION_NAMES[past.kind]
    age = f"_{past.lag}_ago" if past.lag else ""
    when = f", {_AGO.get(past.lag, f'{past.lag} steps')} ago" if past.lag else ""
    what = f"hub {name}" if prefix else f"{name} of each link, base to tip"
    return Variable(f"{prefix}{name}{age}", Role.STATE, length, what + when, unit)


def stage_accelerations(scheme: Scheme, newest: Variable, words: str) -> tuple[Variable, ...]:
    """Return where a coupled scheme keeps its stages' accelerations, by which the next step is predicted; else nothing.

    Parameters
    ----------
    newest : Variable
        Acceleration of the history: that of a stage at the end of the step.
    words : str
        What it is.
    """
    if not scheme.coupled:
        return ()
    found = [
        Variable(
            f"{newest.name}_stage{index}",
            Role.STATE,
            newest.length,
            f"{words}, at stage {index} of the last step",
            newest.unit,
        )
        for index in range(1, len(scheme.stages) + 1)
    ]
    if scheme.stages[-1].instant == 1:
        found[-1] = newest
    return tuple(found)


def gain_names(
    integrator: Integrator, unknown: Unknown, step: Variable
) -> dict[sp.Expr, tuple[str, str, str]]:
    """Name the gains of the main scheme after what they do."""
    names: dict[sp.Expr, tuple[str, str, str]] = {}
    gains = affine_motion(integrator.main, 1, unknown).gain
    for kind, (word, unit) in MOTION_NAMES.items():
        value = sp.factor(gains[kind].subs(STEP, step.ref))
        doc = f"{word} per unit of {unknown}: {value}"
        known = "rad/s^2" if unknown == "acceleration" else "rad"
        names.setdefault(value, (f"{word}_per_{unknown}", doc, quotient(unit, known)))
    return names


def living_state(
    state: tuple[Variable, ...],
    steps: tuple[Routine, ...],
    output: Routine,
    always: frozenset[str] = frozenset(),
) -> tuple[tuple[Variable, ...], tuple[Routine, ...]]:
    """Return the state that outputs depend on, through any number of steps, and the steps without what sets no such.

    The angle always stays.

    Parameters
    ----------
    always : frozenset of str
        Names of what stays as well.
    """
    alive = {v for v in state if v in output.read() or v.name == "angle" or v.name in always}
    while True:
        wanted = frozenset(alive)
        pruned = tuple(prune(routine, wanted) for routine in steps)
        alive |= {v for routine in pruned for v in routine.read() if v.role is Role.STATE}
        if alive == wanted:
            return tuple(v for v in state if v in alive), pruned
