"""Counts are exact, so they are committed: what grows is noticed, and the page shows what is measured."""

from __future__ import annotations

from collections.abc import Callable
from importlib import util
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tmm_gen.target import Measurement

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.xdist_group("boards")  # one worker measures for all


def _benchmark() -> ModuleType:
    spec = util.spec_from_file_location("embedded", ROOT / "benchmarks" / "embedded.py")
    assert spec is not None
    assert spec.loader is not None
    module = util.module_from_spec(spec)
    import sys

    sys.modules["embedded"] = module  # dataclasses look there
    spec.loader.exec_module(module)
    return module


embedded = _benchmark()


@pytest.mark.parametrize(
    "case",
    [pytest.param(c, marks=[pytest.mark.long] if c.in_space else [], id=str(c)) for c in embedded.CASES],
)
def test_no_figure_exceeds_what_is_committed(
    measured: Callable[..., Measurement], need_tool: Callable[[str], str], case: Any
) -> None:
    budget = embedded.committed()[str(case)]
    if case.in_space:  # no committed scene
        for tool in ("arm-none-eabi-gcc", "qemu-system-arm"):
            need_tool(tool)
        found = embedded.figures(case.measure())
    else:
        found = embedded.figures(
            measured(case.target, case.scene, real=case.real, parameters=case.parameters)
        )
    assert found["bits_equal"]
    for name in embedded.FIGURES:
        assert found[name] <= budget[name] * embedded.TOLERANCE, (
            f"{case}: {name} is {found[name]}, was {budget[name]}; if that is meant, run "
            "`python benchmarks/embedded.py --update`"
        )


def test_a_growth_of_two_percent_would_be_noticed() -> None:
    assert embedded.TOLERANCE == 1.02


def test_the_pages_show_what_is_committed() -> None:
    for page, text in embedded.pages(embedded.committed()).items():
        assert page.read_text() == text, f"renew {page.name} with: python benchmarks/embedded.py --update"
    assert embedded.BEGIN in embedded.PAGE.read_text()
    assert set(embedded.committed()) == {str(case) for case in embedded.CASES}
