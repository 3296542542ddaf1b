"""What the interpreter computes, to the last bit, does not depend on what the process did before."""

from __future__ import annotations

import pytest
import sympy as sp

from tmm_gen.program import evaluate
from tmm_gen.program.statements import Assign, Routine, Section
from tmm_gen.program.variables import Role, Variable

A, B, C, D = (Variable(name, Role.STATE) for name in "abcd")
SUM = Variable("sum", Role.OUTPUT)


def total(monkeypatch: pytest.MonkeyPatch, dummies_before: int) -> float:
    """Add up four numbers whose sum depends on the order, after so many Dummies of SymPy's."""
    monkeypatch.setattr(sp.Dummy, "_count", dummies_before)
    monkeypatch.setattr(evaluate, "_FUNCTIONS", {})
    routine = Routine("step", "", (Section("", (Assign(SUM.ref, A.ref + B.ref + C.ref + D.ref),)),))
    values = {"a": 1.0, "b": 1e16, "c": -1e16, "d": 1.0}
    evaluate.execute(routine, values)
    return float(values[evaluate.key(SUM)])


def test_sums_are_taken_in_one_order(monkeypatch: pytest.MonkeyPatch) -> None:
    # names of Dummies carry a running number, and sort otherwise where it gains a digit
    found = {total(monkeypatch, 10**12 - k) for k in range(6)}
    assert len(found) == 1
