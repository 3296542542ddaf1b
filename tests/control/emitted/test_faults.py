"""Emitted controllers whose sensors fail for a while: a sample of benchmarks/controller_faults.py."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.onboard.emit import EMITTED

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[3]
FLAGS = ("-O1", "-ffp-contract=off")
COUNTS = {"mpc-links": 30, "mpc-modes": 30, "rti-zero": 20, "rti": 8}


@pytest.fixture(scope="module")
def benchmark_module() -> Iterator[Any]:
    """The benchmark, found as it finds its own parts."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    yield importlib.import_module("controller_faults")
    sys.path.remove(str(ROOT / "benchmarks"))


@pytest.mark.parametrize("real", ["float64", "float32"])
@pytest.mark.parametrize("kind", EMITTED)
def test_all_come_back(kind: str, real: str, bench: Bench, benchmark_module: Any) -> None:
    loop = benchmark_module.FaultyLoop(bench, kind, real, FLAGS)
    found = benchmark_module.outcomes(loop, COUNTS[kind], number=7)
    bad = [each for each in found if benchmark_module.failed(each[1])]
    assert not bad
    shown = benchmark_module.row(kind, real, found)
    assert shown["cases"] >= COUNTS[kind]
    assert shown["latched"] == shown["not_arrived"] == shown["out_of_bounds"] == shown["not_ok_later"] == 0
    assert "reduced" in shown["statuses"]  # so faults were among them


def test_a_controller_that_latches_would_be_seen(bench: Bench, benchmark_module: Any) -> None:
    """The same loop with a gate that is shut: the estimate never starts anew."""
    from tmm_gen.onboard import emit

    loops = importlib.import_module("faulty_loops.loop")
    cases = importlib.import_module("faulty_loops.cases")

    def spoilt(*words: Any) -> tuple[str, dict[str, str]]:
        name, files = emit.emit_controller(*words)
        text = files[f"{name}.c"]
        assert "rest_at(controller, hub, moved" in text
        files[f"{name}.c"] = text.replace("rest_at(controller, hub, moved", "(void)(controller, hub, moved")
        return name, files

    original, loops.emit_controller = loops.emit_controller, spoilt
    try:
        loop = benchmark_module.FaultyLoop(bench, "mpc-modes", "float64", FLAGS)
    finally:
        loops.emit_controller = original
    spell = cases.Spell(30, (cases.STUCK, cases.TRUE, cases.TRUE), (0.0, 0.0, 0.0))
    assert benchmark_module.failed(loop.run(cases.Case(0.0, 5, (spell,))))
