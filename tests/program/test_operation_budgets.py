"""What a station costs in a step, exactly: operations of one more station, for every integrator."""

from __future__ import annotations

import pytest

from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import parse_scene

BUDGETS = {
    "newmark": (22, 115),
    "wilson": (31, 122),
    "houbolt": (26, 123),
    "park": (28, 123),
    "zhai": (17, 82),
    "zhou": (26, 119),
    "mixed": (30, 123),
    "bathe": (46, 234),
    "generalized_alpha": (31, 122),
    "sdirk2": (40, 230),
    "sdirk4": (122, 589),
    "fox_euler": (18, 115),
    "radau2": (48, 369),
    "radau3": (68, 538),
    "gauss2": (50, 377),
    "gauss3": (68, 802),
}
"""Integrator: operations per station and step of a damped chain, and of a damped planar arm (Riccati sweep)."""

CORRECTED = {"newmark": (159, 51), "bathe": (336, 102), "generalized_alpha": (171, 51), "sdirk4": (844, 255)}
"""Integrator: the same of a planar arm with a correction a stage, and of each further one."""

SCENE = """
name = "counted"
[model]
kind = "{kind}"
{more}
[integrator]
name = "{integrator}"
step = 1e-3
[base]
kind = "clamp"
[[joint]]
stiffness = 20.0
damping = 0.5
repeat = {stations}
[[link]]
inertia = 0.1
{body}
repeat = {stations}
[[output]]
name = "tip"
at = "tip"
of = "angle"
"""
BODIES = {"chain": "", "planar": "mass = 0.5\nlength = 0.3"}


def operations(
    kind: str, integrator: str, stations: int, corrections: int = 0, iterations: int | None = None
) -> int:
    more = f"corrections = {corrections}" if corrections else ""
    more += f"iterations = {iterations}" if iterations else ""
    text = SCENE.format(kind=kind, more=more, integrator=integrator, stations=stations, body=BODIES[kind])
    return count_routine(build_program(parse_scene(text)).main).total


@pytest.mark.parametrize("kind", BODIES)
@pytest.mark.parametrize("integrator", BUDGETS)
def test_a_station_costs_what_it_should(kind: str, integrator: str) -> None:
    more = operations(kind, integrator, 4) - operations(kind, integrator, 3)
    assert more == BUDGETS[integrator][list(BODIES).index(kind)]


@pytest.mark.parametrize("integrator", CORRECTED)
def test_a_correction_costs_less_than_half_a_sweep(integrator: str) -> None:
    once, twice = (
        operations("planar", integrator, 4, count) - operations("planar", integrator, 3, count)
        for count in (1, 2)
    )
    assert (once, twice - once) == CORRECTED[integrator]
    assert 2 * (twice - once) < BUDGETS[integrator][1]


def test_a_second_iteration_of_stages_solved_at_once_repeats_forces_alone() -> None:
    twice = operations("planar", "radau3", 4, iterations=2) - operations("planar", "radau3", 3, iterations=2)
    assert twice - BUDGETS["radau3"][1] == 259
