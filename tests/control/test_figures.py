"""Figures of closed loops whose tips move as closed forms say."""

from __future__ import annotations

import gc
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.closed_loop.figures import BAND, loop_figures, way_of
from tmm_gen.closed_loop.loop import Loop, run_loop
from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command, Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.scene import load_scene

SCENES = Path(__file__).parents[2] / "scenes"
TIME = np.linspace(0.0, 4.0, 4001)


def loop_of(*tips: np.ndarray, goal: tuple[float, ...]) -> Loop:
    """Return a loop of tips, one for each motor."""
    tip, none = np.stack(tips, axis=1), np.zeros(1)
    return Loop(
        time=TIME,
        tip=tip,
        hub=tip,
        sampled=none,
        torque=np.zeros((1, len(tips))),
        statuses=(Status.OK,),
        seconds=none,
        feedback=none,
        iterations=np.zeros(1, int),
        states=({},),
        goal=np.array(goal),
    )


def approach(way: float) -> np.ndarray:
    """Return what comes to rest without passing."""
    return np.asarray(way * -np.expm1(-5.0 * TIME), float)


def disturbed(height: float) -> np.ndarray:
    """Return what is thrown off, and comes back; at 0.2 s it is farthest off, by the height."""
    return np.asarray(height * 5.0 * TIME * np.exp(1.0 - 5.0 * TIME), float)


@pytest.mark.parametrize("away", [0.0, 1e-12, -1e-12, 1e-3, -1e-3])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_joint_that_stays_is_judged_in_the_band_of_those_that_move(away: float, side: float) -> None:
    """However little it has to move, to whatever side it is thrown."""
    own = away * np.minimum(1.0, TIME) + disturbed(0.05 * side)
    figures = loop_figures(loop_of(approach(1.0), own, goal=(1.0, away)))
    off = np.abs(own - away)
    outside = max(TIME[off > BAND][-1], TIME[np.exp(-5.0 * TIME) > BAND][-1])
    assert figures.settling == pytest.approx(outside + 1e-3, abs=1e-9)
    assert figures.overshoot == pytest.approx(float(np.max(off)), rel=1e-9)


@pytest.mark.parametrize("rounding", [0.0, 1e-11, -1e-11])
def test_where_nothing_is_to_move_there_is_no_overshoot_and_no_settling(rounding: float) -> None:
    """Both are relative to a way; what is left is what it trembles by."""
    loop = loop_of(disturbed(0.1), np.zeros_like(TIME), goal=(rounding, 0.0))
    figures = loop_figures(loop)
    assert way_of(loop) == 0.0
    assert (figures.settling, figures.overshoot) == (None, None)
    assert figures.residual == pytest.approx(float(np.ptp(disturbed(0.1)[TIME >= 1.0])))


def test_what_passes_its_reference_overshoots_and_what_has_not_arrived_does_not() -> None:
    swung = 1.0 - np.exp(-TIME) * np.cos(math.pi * TIME)
    top = TIME[int(np.argmax(swung))]
    figures = loop_figures(loop_of(-2.0 * swung, goal=(-2.0,)))
    assert figures.overshoot == pytest.approx(math.exp(-top) * -math.cos(math.pi * top))
    assert loop_figures(loop_of(approach(1.0), goal=(1.0,))).overshoot == 0.0


def test_what_is_no_number_has_not_settled() -> None:
    lost = approach(1.0)
    lost[-10:] = math.nan
    assert loop_figures(loop_of(lost, goal=(1.0,))).settling is None


def test_no_collection_of_pythons_garbage_is_timed() -> None:
    """It takes 150 ms where SymPy has much in memory, and fell into some sample of nearly every loop."""
    bench = Bench.of(load_scene(SCENES / "swing.toml"))
    seen = []

    class Watching:
        def command(self, *given: Any) -> Command:
            seen.append(gc.isenabled())
            return controller.command(*given)

        def __getattr__(self, name: str) -> Any:
            return getattr(controller, name)

    controller = BY_NAME["pd"].make(bench)
    assert gc.isenabled()
    run_loop(Watching(), plant_of(bench.scene, bench.problem, CONDITIONS[0]), 0.1)
    assert gc.isenabled()
    assert len(seen) > 5
    assert not any(seen[2:])  # the first two are to warm up
