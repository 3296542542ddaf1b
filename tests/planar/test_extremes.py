"""Arms far from the usual: each is right or refused. `benchmarks/extremes_planar.py` tries many more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from extremes_of_arms.arms import MOST_LINKS, Extreme, judge
from extremes_of_arms.verdict import SAYS

pytestmark = pytest.mark.compiler

RIGHT = [
    Extreme(),
    Extreme(links=1),
    Extreme(links=30),
    Extreme(links=1000, iterations=2),
    Extreme(stiffness=1e-5),
    Extreme(stiffness=1e5),
    Extreme(slenderness=1e-3),
    Extreme(slenderness=100.0),
    Extreme(tip_ratio=1e4),
    Extreme(tip_ratio=1e4, links=1000, slenderness=0.01, iterations=2),
    Extreme(step=1e-6),
    Extreme(step=0.04, iterations=2),
    Extreme(step=0.1, integrator="sdirk4", iterations=2),
    Extreme(revolutions=0.1),
    Extreme(revolutions=100.0, step=1e-4),
    Extreme(revolutions=100.0, stiffness=1e5, step=1e-3),
]
REFUSED = [
    Extreme(revolutions=100.0, step=0.01),
    Extreme(revolutions=100.0, step=0.1, links=50),
    Extreme(links=100_001),
]


def right(extreme: Extreme) -> str:
    """Return what a right motion is called: beyond the reach of the reference it is energies that tell."""
    return "right" if extreme.links <= MOST_LINKS else "right by energies"


@pytest.mark.parametrize("extreme", RIGHT, ids=str)
def test_the_motion_is_right(extreme: Extreme) -> None:
    verdict = judge(extreme)
    assert verdict.status == right(extreme), verdict
    assert verdict.error <= verdict.bound


@pytest.mark.parametrize("extreme", REFUSED, ids=str)
def test_what_a_step_cannot_follow_is_refused(extreme: Extreme) -> None:
    verdict = judge(extreme, substeps=False)
    assert verdict.status == "refused", verdict
    assert "Use a step below" in verdict.said or "must be at most" in verdict.said


NEEDS_MORE = [
    Extreme(links=1000),
    Extreme(links=20, stiffness=10.0, tip_ratio=0.01, step=0.01, revolutions=0.1),
    Extreme(links=20, stiffness=1e4, slenderness=1e-3, tip_ratio=1.0, revolutions=0.1),
    # more than their fine steps explain, though less than 1e-4
    Extreme(links=50, stiffness=1e-3, slenderness=1e-2, tip_ratio=1.0, step=1e-4),
    Extreme(links=20, stiffness=1e5, slenderness=1e-3, tip_ratio=100.0, step=1e-5, revolutions=1.0),
    Extreme(links=20, stiffness=1e4, slenderness=100.0, tip_ratio=1e4, step=1e-5, revolutions=0.1),
    Extreme(links=50, stiffness=1e-5, slenderness=1e-3, tip_ratio=0.01, step=1e-6, revolutions=1.0),
]


def test_a_blow_at_the_start_is_followed_as_well_as_it_says() -> None:
    """The arm turns a hundred times a second, the hub rests."""
    extreme = Extreme(stiffness=0.1, slenderness=1e-3, step=1e-5, revolutions=100.0)
    verdict = judge(extreme)
    assert verdict.status == "right", verdict
    assert 1e-6 < verdict.error <= SAYS * verdict.accuracy < 1e-2


def test_a_tenth_of_the_period_is_too_long_however_well_it_is_solved() -> None:
    for sweeps in (None, 2, 3):
        verdict = judge(Extreme(step=0.1, iterations=sweeps), substeps=False)
        assert verdict.status == "refused"
        assert "of the motion, more than the 5 % that a run may have" in verdict.said


@pytest.mark.parametrize("extreme", NEEDS_MORE, ids=str)
def test_where_one_sweep_leaves_too_much_a_run_sweeps_again(extreme: Extreme) -> None:
    """Very many links, and blows (the arm in motion, the hub at rest) whose echoes are short beside the step."""
    verdict = judge(replace(extreme, iterations=1))
    assert verdict.status == "refused", verdict
    assert "--iterations auto" in verdict.said
    verdict = judge(extreme)
    assert verdict.status == right(extreme), verdict
    assert verdict.unsolved < 1e-5
    assert verdict.sweeps > 1.0


@pytest.mark.parametrize("times", [1.0, 10.0, 100.0])
def test_arms_drawn_at_random_are_as_right_as_they_say_or_refused(times: float) -> None:
    random = np.random.default_rng(int(times))
    for _ in range(6):
        drawn = Extreme(
            links=5,
            stiffness=float(10.0 ** random.uniform(-2, 2)),
            tip_ratio=float(random.choice([0.0, 1.0, 10.0])),
            step=times * float(10.0 ** random.uniform(-2.7, -2.2)),
            revolutions=float(random.choice([0.0, 0.0, 0.1])),
        )
        verdict = judge(drawn)
        assert verdict.status != "wrong", verdict
        if times == 100.0:
            assert judge(drawn, substeps=False).status == "refused"
