"""Chains at the extremes, drawn at random: right, refused, or diverged as predicted.

`benchmarks/extremes.py` tries all. Lengths and kernels are few here, so that each is compiled once; ratios, steps,
damping and patterns are drawn freely.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from extremes_of_chains.chains import DIVERGED, REFUSED, RIGHT, judge_all
from extremes_of_chains.endurance import endure
from extremes_of_chains.extreme import ChainExtreme
from extremes_of_chains.recursion import Chains, Recursion
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.program.build import build_program

pytestmark = pytest.mark.compiler

ratios = st.floats(-12, 12).map(lambda x: float(10.0**x))
extremes = st.builds(
    ChainExtreme,
    links=st.sampled_from([1, 2, 7]),
    stiffness_ratio=ratios,
    inertia_ratio=ratios,
    step=st.floats(-9, 1).map(lambda x: float(10.0**x)),
    damping=st.sampled_from([0.0, 1e-2]),
    real=st.sampled_from(["float64", "float32"]),
    unknown=st.sampled_from(["acceleration", "increment"]),
    start=st.sampled_from(["loaded", "released"]),
    pattern=st.sampled_from(["halves", "alternating", "graded"]),
)


@settings(derandomize=True, max_examples=60, deadline=None, database=None)
@given(extremes)
def test_nothing_else_occurs(extreme: ChainExtreme) -> None:
    ((_, verdict),) = judge_all([extreme])
    assert verdict.status in (RIGHT, REFUSED), verdict


@settings(derandomize=True, max_examples=15, deadline=None, database=None)
@given(extremes, st.sampled_from(["zhou", "zhai"]))
def test_nothing_else_occurs_with_integrators_that_grow(extreme: ChainExtreme, name: str) -> None:
    tried = replace(extreme, integrator=name, links=7, unknown="acceleration", start="loaded", damping=0.0)
    ((_, verdict),) = judge_all([tried])
    assert verdict.status in (RIGHT, REFUSED, DIVERGED), verdict


@settings(derandomize=True, max_examples=15, deadline=None, database=None)
@given(extremes)
def test_nothing_else_occurs_with_the_plain_product(extreme: ChainExtreme) -> None:
    tried = replace(extreme, sweep="product", links=2, unknown="acceleration", start="loaded", damping=0.0)
    ((_, verdict),) = judge_all([tried])
    assert verdict.status in (RIGHT, REFUSED), verdict


KNOWN = [
    (ChainExtreme(step=1e-9), RIGHT),
    (ChainExtreme(step=10.0), RIGHT),
    (ChainExtreme(links=7, stiffness_ratio=1e12, inertia_ratio=1e12, unknown="increment", step=10.0), RIGHT),
    (ChainExtreme(links=7, stiffness_ratio=1.0, inertia_ratio=1e-12, step=10.0), REFUSED),
    (ChainExtreme(links=7, real="float32", step=1e-9), REFUSED),
    (ChainExtreme(links=7, sweep="product", step=1e-3), REFUSED),
    (ChainExtreme(links=7, integrator="zhai", step=10.0), DIVERGED),
]


def test_each_outcome_occurs_where_it_is_expected() -> None:
    found = dict(judge_all([extreme for extreme, _ in KNOWN]))
    assert {extreme: found[extreme].status for extreme, _ in KNOWN} == dict(KNOWN)


def test_refusals_name_cause_and_remedy() -> None:
    stiff = ChainExtreme(links=7, inertia_ratio=1e-12, step=10.0)
    with pytest.raises(UserError, match=r'cannot keep 6 digits of the angles. Write unknown = "increment"'):
        build_program(stiff.scene())
    with pytest.raises(UserError, match='an integrator such as newmark with unknown = "increment"'):
        build_program(replace(stiff, integrator="wilson", unknown="increment").scene())
    with pytest.raises(
        UserError, match=r'what it adds is rounded off. Use a step above .* or real = "float64"'
    ):
        build_program(ChainExtreme(real="float32", step=1e-9).scene())


def test_what_is_refused_would_have_been_wrong() -> None:
    """Ratios of 1e12 in float32 with accelerations as unknowns: nothing of the angle is left."""
    from extremes_of_chains.chains import WRONG, compiled, judge, reference

    from tmm_gen.stability.growth import Growth

    method = integrator("newmark")
    extreme = ChainExtreme(links=2, inertia_ratio=1e-12, step=10.0, real="float32")
    (exact,) = reference([extreme], method)
    verdict = judge(extreme, Growth(method), compiled(extreme, method), exact)
    assert verdict.status == WRONG
    assert verdict.error > 0.5
    better = replace(extreme, unknown="increment")
    assert judge(better, Growth(method), compiled(better, method), exact).status == RIGHT


def test_a_whole_period_keeps_its_digits() -> None:
    for real, steps in (("float64", 100_000), ("float32", 100_000)):
        found = endure(ChainExtreme(links=3, step=1.0 / steps, real=real, start="released"))  # type: ignore[arg-type]
        assert found.status == RIGHT, found
    assert endure(ChainExtreme(links=3, step=1e-7, real="float32", start="released")).status == REFUSED


@pytest.mark.parametrize("name", ["newmark", "houbolt", "sdirk4"])
def test_the_reference_is_the_exact_response_at_small_steps(name: str) -> None:
    """One station of inertia 1, stiffness 1: it swings as 1 - cos t."""
    one = np.ones((1, 1))
    step = 0.01
    chains = Chains(one, 0.0 * one, one)
    recursion = Recursion(integrator(name), chains, step * one[0], one[0], 0.0 * one)
    for _ in range(200):
        recursion.advance()
    assert recursion.angle[0, 0] == pytest.approx(1.0 - np.cos(2.0), abs=2e-4)
