from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from tmm_gen.cli import main
from tmm_gen.derive.integrators.declaration import STEP, Integrator, Scheme, Stage, past, stage
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import discrete_coefficients
from tmm_gen.thesis.errata import (
    COEFFICIENTS,
    ErratumRow,
    derived_coefficients,
    errata_rows,
    headline,
    printed_table,
)
from tmm_gen.thesis.response import exact_tip, settling_time, simulate
from tmm_gen.thesis.tables import BETA, PRINTED_B, TABLES, THETA

WRONG = {
    ("3-3", "A"),
    ("3-3", "B"),
    ("3-4", "A"),
    ("3-4", "E"),
    ("3-6", "B"),
    ("3-6", "E"),
    ("3-8", "D"),
    ("3-8", "E"),
}


@cache
def by_name() -> dict[tuple[str, str], ErratumRow]:
    """Return what is found of each coefficient that is printed."""
    return {(row.table, row.coefficient): row for row in errata_rows()}


def test_every_printed_coefficient_has_a_row() -> None:
    assert [t.number for t in TABLES] == ["3-1", "3-3", "3-4", "3-5", "3-6", "3-7", "3-8"]
    assert list(by_name()) == [(t.number, c) for t in TABLES for c in COEFFICIENTS]


def test_which_coefficients_are_misprinted() -> None:
    assert {key for key, row in by_name().items() if not row.agrees} == WRONG


def test_agreement_is_decided_by_numbers_too() -> None:
    """Independent of simplification: random steps, histories and parameters."""
    generator = np.random.default_rng(1)
    for table in TABLES:
        derived = derived_coefficients(table.number)
        for name in COEFFICIENTS:
            printed = printed_table(table.number).coefficients[name].subs(PRINTED_B, derived.B)
            difference = printed - getattr(derived, name)
            symbols = sorted(difference.free_symbols, key=str)
            values = [generator.integers(10, 200, len(symbols)) for _ in range(5)]
            errors = [abs(difference.subs(dict(zip(symbols, v / 97, strict=True))).evalf()) for v in values]
            assert (max(errors, default=0) < 1e-9) == by_name()[table.number, name].agrees


def test_what_the_misprints_are() -> None:
    """Each disagreement in a word: the factor between printed and derived, or the term at fault."""
    h = STEP
    newmark, derived = printed_table("3-3").coefficients, derived_coefficients("3-3")
    assert sp.simplify(newmark["A"] / derived.A) == sp.simplify(newmark["B"] / derived.B) == 2
    wilson, derived = printed_table("3-4").coefficients, derived_coefficients("3-4")
    assert sp.simplify(derived.A / wilson["A"] - 3 / THETA**2) == 0
    assert sp.simplify(wilson["E"] - derived.E + THETA * h / 2 * past("a")) == 0
    # Houbolt's second step: the acceleration's factors in B and E have changed places
    houbolt, derived = printed_table("3-6").coefficients, derived_coefficients("3-6")
    assert sp.expand(houbolt["B"] - derived.B) == -past("a", 1)
    assert sp.expand(houbolt["E"] - derived.E) == h / 6 * past("a", 1)


def test_table_3_8_follows_from_one_slip_in_eq_3_80() -> None:
    """Leave out the step before the newest acceleration of the velocity, and D and E come out as printed."""
    only = integrator("zhou").main.stages[0]
    displacement, velocity = only.relations
    weight = sp.expand(velocity).coeff(stage("a", 1))
    slip = velocity + weight / STEP * (1 - STEP) * stage("a", 1)
    slipped = discrete_coefficients(Scheme((Stage(only.instant, (displacement, slip)),), {}))
    printed = printed_table("3-8").coefficients
    assert all(sp.expand(printed[name] - getattr(slipped, name)) == 0 for name in COEFFICIENTS)


def test_the_headline_of_the_thesis_is_that_misprint() -> None:
    """Settling after 3 s instead of more than ten (Gholampour 2018, chapter 4): table 3-8 as printed."""
    found = headline(0.1)
    assert 2.9 < found.printed.settling_time < 3.5
    assert found.derived.settling_time == pytest.approx(found.exact_settling_time, abs=0.11)
    assert found.exact_settling_time > 13
    assert found.cause == ("D", "E")
    # with the step the "settling" changes: it is no property of the arm
    assert headline(0.2).printed.settling_time > 5
    assert headline(0.05).printed.settling_time < 2
    assert found.printed.rms_error > 0.2
    assert found.derived.rms_error < 1e-4


def test_neither_d_nor_e_alone_gives_the_headline() -> None:
    for name in ("D", "E"):
        assert by_name()["3-8", name].effect.startswith("diverges")
        assert np.isinf(by_name()["3-8", name].rms_error)


def test_effects_are_measured() -> None:
    for row in by_name().values():
        if row.agrees:
            assert row.effect == "none"
            assert row.rms_error == row.derived_rms_error
        else:
            assert row.rms_error > row.derived_rms_error
            assert row.effect.startswith(("RMS error", "diverges"))


def test_the_misprinted_newmark_a_ends_where_its_fixed_point_says() -> None:
    """With 2 A for A, Newmark 1/4 rests where v = 0 and a = A q/2: (A M/2 + K) q = T."""
    misprinted = {"A": printed_table("3-3").coefficients["A"].subs(BETA, sp.S.One / 4)}
    found = simulate(integrator("newmark"), 0.1, {0: misprinted})
    rest = np.linalg.solve(2 / 0.1**2 * 5 * np.eye(2) + [[40, -20], [-20, 20]], [0, 1])
    assert found.final == pytest.approx(rest[1] / 0.1, rel=1e-2)
    assert "does not settle" in by_name()["3-3", "A"].effect


def test_the_yardstick_against_another_integrator() -> None:
    """scipy's DOP853 at tight tolerance on the sample written out by hand."""

    def rate(_: float, s: np.ndarray) -> list[float]:
        one = -20 * s[0] - 5 * s[2] + 20 * (s[1] - s[0]) + 5 * (s[3] - s[2])
        two = 1 - 20 * (s[1] - s[0]) - 5 * (s[3] - s[2])
        return [s[2], s[3], one / 5, two / 5]

    time = 0.1 * np.arange(201)
    solution = solve_ivp(rate, (0, 20), [0, 0, 0, 0], "DOP853", time, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(exact_tip(0.1), solution.y[1], atol=1e-11)


@pytest.mark.parametrize(
    ("method", "bound"),
    [
        (integrator("fox_euler"), 4e-3),
        (integrator("newmark"), 1.6e-5),
        (integrator("newmark", beta=1 / 6), 7.5e-6),
        (integrator("wilson"), 3.5e-5),
        (integrator("houbolt"), 8e-5),
        (integrator("zhou"), 5e-8),
    ],
    ids=lambda value: value.name if isinstance(value, Integrator) else "",
)
def test_derived_coefficients_are_accurate(method: Integrator, bound: float) -> None:
    assert simulate(method, 0.01).rms_error <= bound


def test_settling_time() -> None:
    tip = np.array([0.0, 0.2, 0.11, 0.097, 0.1, 0.102])
    assert settling_time(tip, 0.5) == 1.5
    assert settling_time(tip[:3], 0.5) == float("inf")
    assert settling_time(tip[4:], 0.5) == 0.0


def test_unknown_tables_are_refused() -> None:
    with pytest.raises(ValueError, match=r"'3-2'.*3-1"):
        printed_table("3-2")


def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["errata", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    wanted = {"table", "coefficient", "printed", "derived", "agrees", "effect"}
    assert all(wanted <= set(row) for row in rows)
    rows = [row for row in rows if row["table"].startswith("3-")]
    assert {(row["table"], row["coefficient"]) for row in rows if not row["agrees"]} == WRONG
    assert rows[0]["derived"] == "2/h^2"
    assert rows[3]["printed"] == "-v[i-1] - 2*q[i-1]/h"
    assert main(["errata"]) == 0
    out = capsys.readouterr().out
    assert "3-8" in out
    assert "settles in 3.2 s" in out
