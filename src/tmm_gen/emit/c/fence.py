"""Bounds on what a step computes on its way, without which no analyser can show that nothing overflows.

In a planar arm each link's answer to its neighbour enters the next link's, so that bounds of intervals square from
link to link and exceed any number type, though the numbers themselves never do: an analyser that looks at intervals
does not know that the arm is passive. Where a scene states a box (``[emit.box]``), its kernel therefore checks the
pivots and the answers that a sweep keeps, and returns a status where they leave their bounds. Those lie far beyond what
random states of the box lead to.
In space a sweep hands 21 numbers from joint to joint (54 with all slopes): their sizes are added up at each joint and
the sum is checked, and so is what each joint is found to do, which corrections begin with.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import sympy as sp

from tmm_gen.derive.space.inward import OWN
from tmm_gen.emit.c.box import Box
from tmm_gen.emit.c.handed import handed_at, handed_on
from tmm_gen.program.evaluate import Values, VanishingPivotError, allocate, execute, key
from tmm_gen.program.statements import Assign, Loop, Order, Program, Require, Routine, Section, Statement
from tmm_gen.program.variables import Role, Variable, refs_in

SAMPLES = 24
MARGIN = 64.0
"""By how much bounds exceed what random states lead to."""


@dataclass(frozen=True)
class Fence:
    """Bounds of a routine.

    Parameters
    ----------
    largest : mapping from str to float
        By name of a scratch array: what the absolute value of its elements must stay below.
    least : mapping from str to float
        By the expression of a pivot: what it must exceed.
    handed : frozenset of Variable
        Scalars that one joint hands to the next.
    sum : float
        What the sum of their sizes must stay below.
    """

    largest: Mapping[str, float] = field(default_factory=dict)
    least: Mapping[str, float] = field(default_factory=dict)
    handed: frozenset[Variable] = frozenset()
    sum: float = 0.0

    def least_of(self, required: Require) -> float:
        """Return what a pivot must exceed."""
        return self.least.get(str(required.value), 0.0)

    def __bool__(self) -> bool:
        """Whether there are bounds besides those of pivots."""
        return bool(self.largest or self.handed)


def fence_of(program: Program, box: Box, routine: Routine, *, in_space: bool = False) -> Fence:
    """Return bounds for a step of a program or its start, found by taking it from random states of a box.

    Parameters
    ----------
    program : Program
        Lowered.
    box : Box
        Bounds of state and inputs.
    routine : Routine
        Its step, one of the first, or its start.
    in_space : bool
        Whether it is an arm's in space, whose sweeps keep little and hand on much.

    Returns
    -------
    Fence
        Powers of two, so that they are exact in every number type; empty where the step has no pivots.
    """
    kept = (*kept_answers(routine), *(found_by(routine) if in_space else ()))
    handed = handed_on(routine) if in_space else frozenset()
    if not kept and not handed:
        return Fence()
    watched, pivots, sums = _watched(routine, handed)
    largest = dict.fromkeys((v.name for v in kept), 0.0)
    least = dict.fromkeys(pivots, math.inf)
    most = 0.0
    for values in _steps(program, box, watched):
        for variable in kept:
            largest[variable.name] = max(largest[variable.name], *map(abs, values[key(variable)]))
        for required, recorded in pivots.items():
            held = values[key(recorded)]
            taken = [pivot for pivot in (held if isinstance(held, list) else [held]) if pivot > 0.0]
            least[required] = min([least[required], *taken])  # stations without this pivot have zero there
        most = max([most, *(value for total in sums for value in values[key(total)])])
    return Fence(
        {name: _beyond(value) for name, value in largest.items() if value > 0.0},
        {
            name: 2.0 ** math.floor(math.log2(value / MARGIN))
            for name, value in least.items()
            if math.isfinite(value)
        },
        handed if most > 0.0 else frozenset(),
        _beyond(most) if most > 0.0 else 0.0,
    )


def _beyond(value: float) -> float:
    """Return a power of two that random states do not come near."""
    return 2.0 ** math.ceil(math.log2(MARGIN * value))


def kept_answers(routine: Routine) -> tuple[Variable, ...]:
    """Return the arrays an inward sweep writes behind its pivot, from more than the pivot and the model."""
    found: dict[Variable, None] = {}
    for loop in routine.statements():
        if not isinstance(loop, Loop) or loop.order is not Order.INWARD:
            continue
        places = [place for place, inner in enumerate(loop.body) if isinstance(inner, Require)]
        for inner in loop.body[places[0] + 1 :] if places else ():
            if not isinstance(inner, Assign) or inner.target.variable.role is not Role.WORK:
                continue
            varying = {ref for ref in refs_in(inner.value) if not ref.variable.role.bound_at_prepare}
            if len(varying) > 1:
                found[inner.target.variable] = None
    return tuple(found)


def found_by(routine: Routine) -> tuple[Variable, ...]:
    """Return the arrays in which a step in space keeps what each joint is found to do: corrections begin with them.

    Where stages are solved at once there is one for each part of each system.
    """
    return tuple(v for v in routine.variables(Role.WORK) if v.name.partition("_system")[0] == OWN.name)


def _watched(
    routine: Routine, handed: frozenset[Variable]
) -> tuple[Routine, dict[str, Variable], list[Variable]]:
    """Return the routine with every pivot recorded, the records by expression, and those of what is handed on."""
    records: dict[str, Variable] = {}
    totals: list[Variable] = []
    stations = max((loop.stop for loop in routine.statements() if isinstance(loop, Loop)), default=0)

    def record(required: Require, length: int | None) -> list[Assign | Require]:
        role = Role.LOCAL if length is None else Role.WORK
        variable = records.setdefault(
            str(required.value), Variable(f"recorded_{len(records)}", role, length, "a pivot")
        )
        return [Assign(variable.at(), required.value), required]

    def expanded(statement: Statement) -> list[Statement]:
        if isinstance(statement, Require):
            return list(record(statement, None))
        if isinstance(statement, Loop):
            body: list[Assign | Require] = []
            places = handed_at(statement, handed)
            for place, inner in enumerate(statement.body):
                body += record(inner, stations) if isinstance(inner, Require) else [inner]
                if place in places:
                    total = Variable(
                        f"handed_{len(totals)}", Role.WORK, stations, "sizes of what is handed on"
                    )
                    totals.append(total)
                    body.append(Assign(total.at(), sp.Add(*(sp.Abs(ref) for ref in places[place]))))
            return [replace(statement, body=tuple(body))]
        return [statement]

    sections = tuple(
        Section(s.title, tuple(new for old in s.statements for new in expanded(old)))
        for s in routine.sections
    )
    return Routine(routine.name, routine.doc, sections), records, totals


def _steps(program: Program, box: Box, routine: Routine) -> list[Values]:
    """Return all variables after steps from random states; states from which none can be taken are left out."""
    draw = random.Random(2718)
    variables = (program.step, *program.parameters, *program.state, *program.inputs, *program.given)
    base = allocate(variables, float)
    execute(program.prepare, base)
    found = []
    for _ in range(SAMPLES):
        values = {name: list(held) if isinstance(held, list) else held for name, held in base.items()}
        for variable in (*program.state, *program.inputs, *program.given):
            low, high = box.of(variable)
            numbers = [draw.uniform(low, high) for _ in range(variable.length or 1)]
            values[key(variable)] = numbers[0] if variable.length is None else numbers
        try:
            execute(routine, values)
        except (VanishingPivotError, OverflowError):
            continue
        found.append(values)
    return found
