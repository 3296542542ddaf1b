"""Emitted controllers told and shown all that is wrong: a sample of benchmarks/arm_faults.py."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.control.bench import Bench

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def benchmark_module() -> Iterator[Any]:
    """The benchmark, found as it finds its own parts."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    yield importlib.import_module("arm_faults")
    sys.path.remove(str(ROOT / "benchmarks"))


@pytest.mark.parametrize("kind", ["rti", "mpc-links"])
def test_all_come_back_whatever_they_were_told(kind: str, firm_bench: Bench, benchmark_module: Any) -> None:
    """In single precision; each kind of what can be told is taken at times and refused at times."""
    loop = benchmark_module.ArmLoop(firm_bench, kind, "float32", flags=("-O1", "-ffp-contract=off"))
    found = benchmark_module.outcomes(loop, 5, number=1)
    assert not [each for each in found if benchmark_module.failed(each[1], firm_bench.problem.sample_time)]
    shown = benchmark_module.row(kind, "float32", found, firm_bench.problem.sample_time)
    for told in ("limit", "aim", "follow", "carry"):
        assert shown["answers"][f"{told}_ok"] > 0
        assert any(answer.startswith(told) and not answer.endswith("ok") for answer in shown["answers"])
    # and a loop whose bounds are not those in force is seen
    loop.widest = tuple(0.5 * each for each in loop.widest)
    assert benchmark_module.failed(loop.run(found[0][0]), firm_bench.problem.sample_time)
