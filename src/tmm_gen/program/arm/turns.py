"""The turns of a chain that turns on and on, kept apart from the angles between its stations.

What happens in a chain on a motor depends on differences of its angles alone. As it turns, the angles grow, and the
place of their last digit with them: however many digits a number has, the differences lose them. So after each step
the hub's angle is taken out of all angles, an exact subtraction of numbers that are close (Sterbenz, Floating-Point
Computation, 1974), and added to one number, which only outputs read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from tmm_gen.derive.integrators.declaration import Past
from tmm_gen.program.arm.layout import Layout
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable

TURNED = Variable("turned", Role.STATE, doc="angle that is taken out of all others", unit="rad")


def take_turns_out(steps: Sequence[Routine], layout: Layout) -> tuple[Routine, ...]:
    """Return steps that end with the hub's angle taken out of every angle, the older ones of the history too."""
    hub = layout.hub[Past("q", 0)].ref
    links = [v.at() for p, v in layout.state.items() if p.kind == "q"]
    older = [v.ref for p, v in layout.hub.items() if p.kind == "q" and p.lag]
    section = Section(
        "turns are kept apart from the angles between stations",
        (
            Assign(TURNED.ref, TURNED.ref + hub),
            Loop(Order.OUTWARD, 0, layout.stations, tuple(Assign(angle, angle - hub) for angle in links)),
            *(Assign(angle, angle - hub) for angle in older),
            Assign(hub, sp.Integer(0)),
        ),
    )
    return tuple(replace(step, sections=(*step.sections, section)) for step in steps)


def start_unturned(initialise: Routine) -> Routine:
    """Return a start that has not turned."""
    section = Section("no turns yet", (Assign(TURNED.ref, sp.Integer(0)),))
    return replace(initialise, sections=(*initialise.sections, section))
