"""What the thesis prints of the frequency domain."""

from __future__ import annotations

import json
from functools import cache

import pytest
import sympy as sp

from tmm_gen.cli import main
from tmm_gen.thesis.errata import ErratumRow
from tmm_gen.thesis.errata_frequency import RATIOS, frequency_errata_rows
from tmm_gen.thesis.transfer_functions import numbered_chain, transfer_functions

WRONG = {("2-90", "U_21"), ("2-90", "U_31"), ("2-90", "U_32"), ("2-99", "theta_2/T")}


@cache
def rows() -> dict[tuple[str, str], ErratumRow]:
    """Return what is found of each formula that is printed."""
    return {(row.table, row.coefficient): row for row in frequency_errata_rows()}


def test_which_formulas_are_misprinted() -> None:
    assert {key for key, row in rows().items() if not row.agrees} == WRONG
    assert rows()["2-98", "theta_1/T"].agrees


def test_the_torque_left_in_equation_2_99() -> None:
    """Printed over derived, with the derived polynomial put in, is the torque itself."""
    row = rows()["2-99", "theta_2/T"]
    derived = transfer_functions(numbered_chain(2), 1)
    ratio = row.printed.subs(sp.Symbol("P"), derived.denominator.as_expr()) / row.derived
    assert sp.simplify(ratio) == sp.Symbol("T", real=True)
    assert row.rms_error == pytest.approx(1.0, abs=0.1)
    assert RATIOS[1].note in row.note


def test_the_command_lists_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["errata", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)["rows"]
    found = {(row["table"], row["coefficient"]) for row in listed if row["table"].startswith("2-")}
    assert found == set(rows())
