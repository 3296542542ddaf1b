"""Controllers in Python whose sensors fail for a while: all come back, and the arm arrives."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[2]
SOME = {
    **dict.fromkeys(("pd", "pd-zv", "pd-zvd"), (0, 2, 4)),
    **dict.fromkeys(("lqr", "mpc-links"), (0, 1, 4)),
    **dict.fromkeys(("mpc-modes", "rti-zero"), range(8)),
    "rti": (2,),
}
"""Which kinds of faults a controller is tried with; in C all are, with many more."""
SECOND, LATER = 50, 275


@pytest.fixture(scope="module")
def cases() -> Iterator[Any]:
    """What the benchmark draws."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    from faulty_loops import cases

    yield cases
    sys.path.remove(str(ROOT / "benchmarks"))


def spells(cases: Any) -> list[Any]:
    """One of each kind of fault, as long as may be."""
    nothing = (0, 0, 0)
    return [
        cases.Case(1.5, 5, ()),
        cases.Case(0.0, 20, (cases.Spell(1, (cases.VALUE,) * 3, (0.0, 0.0, 0.0)),)),
        cases.Case(0.0, 20, (cases.Spell(1, (cases.ADDED, 0, 0), (2.0 * np.pi, 0.0, 0.0)),)),
        cases.Case(-1.0, 10, (cases.Spell(50, (cases.STUCK, 0, 0), nothing),)),
        cases.Case(0.0, 0, (cases.Spell(3, (cases.VALUE,) * 3, (1e300, -1e300, 0.0)),)),
        cases.Case(0.5, 0, (cases.Spell(50, (cases.VALUE,) * 3, (np.nan,) * 3),)),
        cases.Case(0.0, 30, (cases.Spell(50, (cases.ADDED, cases.STUCK, 0), (-4.0 * np.pi, 0.0, 0.0)),)),
        cases.Case(0.0, 20, (cases.Spell(50, (cases.INVALID,) * 3, (3.0, 1e6, 0.0)),)),
    ]


def follow(
    bench: Bench, controller: Any, case: Any, cases: Any
) -> tuple[list[Status], np.ndarray, np.ndarray]:
    """Return statuses after the last wrong sample, the tip's angle then, and all torques."""
    plant = Plant(bench.scene, bench.problem, CONDITIONS[0])
    at_rest = {name: np.zeros_like(value) for name, value in plant.kernel.state.items()}
    at_rest["angle"], at_rest["hub_angle"] = np.full(plant.scene.stations, case.start), case.start
    plant.kernel.state = at_rest
    kinds = [each for spell in case.spells for each in [spell] * spell.samples]
    controller.reset()
    held, statuses, tips, torques = np.zeros(3), [], [], []
    for k in range(case.before + len(kinds) + LATER):
        seen = plant.measured()
        at = k - case.before
        held, valid = seen if at <= 0 else held, None
        if 0 <= at < len(kinds):
            value = np.array(kinds[at].values)
            shown = [held, value, seen + value, value]
            valid = np.array(kinds[at].kinds) != cases.INVALID
            seen = np.array([[seen, *shown][kind][i] for i, kind in enumerate(kinds[at].kinds)])
        command = controller.command(seen, valid)
        torques.append(command.torque[0])
        angles = plant.advance(command.torque)
        if at >= len(kinds):
            statuses.append(command.status)
            tips.append(angles[-1, 0])
    return statuses, np.array(tips), np.array(torques)


@pytest.mark.parametrize(
    ("name", "number"), [(name, number) for name, some in SOME.items() for number in some]
)
def test_all_is_well_a_second_after_the_last_wrong_sample(
    name: str, number: int, bench: Bench, cases: Any
) -> None:
    statuses, tips, torques = follow(bench, BY_NAME[name].make(bench), spells(cases)[number], cases)
    assert Status.OK in statuses[:SECOND]
    assert set(statuses[SECOND:]) == {Status.OK}
    turns = np.round((tips[-1] - bench.problem.reference) / (2.0 * np.pi))
    assert turns == 0
    assert tips[-1] == pytest.approx(bench.problem.reference, abs=0.02)
    low, high = bench.problem.torque
    assert np.all((torques >= low) & (torques <= high))


@pytest.mark.parametrize("name", ["lqr", "mpc-links", "mpc-modes", "rti-zero"])
def test_without_an_accelerometer_the_arm_arrives_and_it_is_said(name: str, bench: Bench) -> None:
    controller, plant = BY_NAME[name].make(bench), Plant(bench.scene, bench.problem, CONDITIONS[0])
    statuses = set()
    for _ in range(150):
        seen = plant.measured()
        seen[1] = np.nan
        command = controller.command(seen)
        statuses.add(command.status)
        angles = plant.advance(command.torque)
    assert statuses == {Status.REDUCED}
    assert angles[-1, 0] == pytest.approx(bench.problem.reference, abs=0.01)


def test_pd_that_started_from_nonsense_still_goes_to_its_target(bench: Bench) -> None:
    """The reference begins where the hub was seen first: that must not be carried along for ever."""
    for nonsense in (1e300, 1e6, 60.0):
        controller, plant = BY_NAME["pd-zvd"].make(bench), Plant(bench.scene, bench.problem, CONDITIONS[0])
        controller.command(np.array([nonsense, 0.0, np.nan]))
        for _ in range(150):
            angles = plant.advance(controller.command(plant.measured()).torque)
        assert angles[-1, 0] == pytest.approx(bench.problem.reference, abs=0.02)
