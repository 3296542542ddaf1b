"""The control problem of a scene: its numbers, and what a torque may be."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.control.problem import control_problem
from tmm_gen.control.safe import BRAKE_TIME, safe_torque
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene, load_scene


def test_the_tip_is_bounded_beyond_the_reference_whichever_way_it_goes(swing: Scene) -> None:
    assert control_problem(swing).tip == (-math.inf, pytest.approx(1.005))
    back = swing.replace(**{"control.reference": -0.5, "control.bounds.hub": [-1.0, 1.0]})
    assert control_problem(back).tip == (pytest.approx(-0.5025), math.inf)
    assert control_problem(swing.replace(**{"control.bounds.overshoot": None})).tip is None


def test_a_scene_without_control_is_refused() -> None:
    scene = load_scene(Path(__file__).parents[2] / "scenes" / "arm10.toml")
    with pytest.raises(UserError, match=r"arm10.toml: has no \[control\]"):
        control_problem(scene)


def test_a_torque_keeps_its_bounds(bench: Bench) -> None:
    problem = dataclasses.replace(bench.problem, torque_rate=50.0)  # 1 N m a sample
    assert problem.allowed(9.0, 2.5) == 3.0
    assert problem.allowed(9.0, 0.0) == pytest.approx(1.0)
    assert problem.allowed(-9.0, 0.0) == pytest.approx(-1.0)
    assert problem.allowed(math.nan, 0.5) == 0.0
    assert problem.allowed(math.inf, 2.9) == 3.0


def test_the_safe_law_brakes_the_hub(bench: Bench) -> None:
    assert safe_torque(bench.problem, 0.2, 1.0, 0.0) == pytest.approx(-0.2 / BRAKE_TIME)
    assert safe_torque(bench.problem, 0.2, 100.0, 0.0) == -3.0
    slow = dataclasses.replace(bench.problem, torque_rate=50.0)
    assert safe_torque(slow, 0.2, math.nan, 3.0) == pytest.approx(2.0)  # to zero, as fast as it may
