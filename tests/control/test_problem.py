"""The control problem of a scene: its numbers, and what a torque may be."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.control.bench import Bench
from tmm_gen.control.laws.safe import BRAKE_TIME, safe_torque
from tmm_gen.control.task.problem import control_problem
from tmm_gen.control.task.terms import Goal
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene, load_scene


def test_the_tip_is_bounded_beyond_the_reference_whichever_way_it_goes(swing: Scene) -> None:
    goal = Goal(np.ones(1), np.ones(1), np.zeros(1))
    (tip, hub) = control_problem(swing).kinds(goal)
    assert (tip.what, hub.what) == ("tip", "hub")
    assert (tip.low, tip.high) == (-math.inf, pytest.approx(1.005))
    back = swing.replace(**{"control.reference": -0.5, "control.bounds.hub": [-1.0, 1.0]})
    assert control_problem(back).tip == ((pytest.approx(-0.0025), math.inf),)
    assert control_problem(swing.replace(**{"control.bounds.overshoot": None})).tip == (None,)


def test_how_fast_the_hub_of_the_short_form_turns_is_not_bounded(swing: Scene) -> None:
    with pytest.raises(UserError, match="is for arms whose motors are parts by name"):
        swing.replace(**{"control.bounds.hub_rate": 2.0})


def test_a_scene_without_control_is_refused() -> None:
    scene = load_scene(Path(__file__).parents[2] / "scenes" / "arm10.toml")
    with pytest.raises(UserError, match=r"arm10.toml: has no \[control\]"):
        control_problem(scene)


def test_a_torque_keeps_its_bounds(bench: Bench) -> None:
    problem = dataclasses.replace(bench.problem, torque_rate=np.array([50.0]))  # 1 N m a sample
    wanted, last = np.array([9.0, 9.0, -9.0, math.nan, math.inf]), np.array([2.5, 0.0, 0.0, 0.5, 2.9])
    assert_allclose(problem.allowed(wanted, last), [3.0, 1.0, -1.0, 0.0, 3.0])
    told = dataclasses.replace(problem, torque=(np.array([0.5]), np.array([0.8])))  # both sides, at once
    assert_allclose(
        told.allowed(np.array([9.0, -9.0, math.nan]), np.array([2.5, -2.5, -2.5])), [0.8, 0.5, 0.5]
    )


def test_the_safe_law_brakes_the_hub(bench: Bench) -> None:
    inertia, none = np.array([0.2]), np.zeros(1)
    assert safe_torque(bench.problem, inertia, np.ones(1), none) == pytest.approx(-0.2 / BRAKE_TIME)
    assert safe_torque(bench.problem, inertia, np.array([100.0]), none) == -3.0
    slow = dataclasses.replace(bench.problem, torque_rate=np.array([50.0]))
    # to zero, as fast as it may
    assert safe_torque(slow, inertia, np.array([math.nan]), np.array([3.0])) == pytest.approx(2.0)
