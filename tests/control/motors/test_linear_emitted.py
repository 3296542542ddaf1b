"""Linear predictive control of several motors in C: the torques of Python, and recovery whatever sensors show."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import emit_controller, usual_controller
from tmm_gen.onboard.native import EmittedController

pytestmark = pytest.mark.compiler

WARNINGS = ("-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Wundef", "-Werror")
LATE = {
    "control.delay": 0.03,
    "control.bounds.torque_rate": {"shoulder": 10.0, "elbow": 1.0},
}
BOUNDED = {**LATE, "control.bounds.hub_rate": 4.0}
FELT = {"control.sensors.accelerometer": {"elbow": 0.02}, "control.sensors.strain": 0.002}


def compiled(bench: Bench, kind: str, real: str = "float64") -> EmittedController:
    """Return an emitted controller; warnings are errors."""
    name, files = emit_controller(bench, kind, real)
    flags = ("-O1", "-ffp-contract=off", *WARNINGS)
    sensors = present_sensors(bench.problem)
    return EmittedController(name, files, sensors, real, flags=flags, motors=bench.problem.count)


@pytest.mark.parametrize(
    ("kind", "changes"), [("mpc-links", BOUNDED), ("mpc-modes", BOUNDED), ("mpc-modes", FELT)]
)
def test_torques_are_those_of_python(kind: str, changes: dict[str, object], two: Bench) -> None:
    """Flags at random, all encoders lost for long, bounds told at run time, which are kept throughout."""
    bench = Bench.of(two.scene.replace(**changes))
    emitted, python = compiled(bench, kind), BY_NAME[kind].make(bench)
    assert isinstance(python, LinearMpc)
    plant, random = Plant(bench.scene, bench.problem, CONDITIONS[0], seed=1), np.random.default_rng(3)
    last, (low, high) = python.estimator.start, bench.problem.torque
    statuses = []
    for k in range(60):
        seen, valid = plant.measured(), random.random(6) < (0.85 if 5 < k < 40 else 1.0)
        valid[:2] &= not 20 <= k < 28
        if k == 12:
            low, high = np.array([-0.1, -0.05]), np.array([0.12, 0.03])
            assert emitted.limit(low, high) is python.limit(low, high) is Status.OK
            assert emitted.limit(high, low) is python.limit(high, low) is Status.INFEASIBLE
        expected, found = python.command(seen, valid), emitted.command(np.where(valid, seen, 7.0), valid)
        assert_allclose(found.torque, expected.torque, rtol=0.0, atol=1e-10)
        assert found.status is expected.status, k
        assert np.all((found.torque >= low) & (found.torque <= high))
        change = bench.problem.torque_rate * bench.problem.sample_time
        assert k == 12 or np.all(np.abs(found.torque - last) <= change + 1e-12)
        last = found.torque
        statuses.append(found.status)
        plant.advance(expected.torque)
    assert {Status.OK, Status.REDUCED, Status.MEASUREMENT} <= set(statuses)


@pytest.fixture(scope="module")
def firm(firm_bench: Bench) -> tuple[Bench, EmittedController]:
    """An arm that does not tremble, with all sensors, and its controller in single precision."""
    bench = Bench.of(firm_bench.scene.replace(**FELT, **{"control.estimator.strain": 0.3}))
    return bench, compiled(bench, "mpc-modes", "float32")


SPELLS = {
    "all lost": 6 * (np.nan,),
    "elbow lost": (0.0, np.nan, *4 * (0.0,)),
    "shoulder a turn off": (2.0 * np.pi, *5 * (0.0,)),
    "absurd": (1e30, -1e30, 0.0, 1e30, -1e30, np.inf),
    "others off": (0.0, 0.0, 0.0, 500.0, -20.0, 9.0),
}


def test_all_is_well_a_second_after_the_last_wrong_sample(firm: tuple[Bench, EmittedController]) -> None:
    """Whatever sensors showed for 15 samples: OK again within a second, bounds kept, and the arm arrives."""
    bench, controller = firm
    low, high = (np.float32(bound) for bound in bench.problem.torque)
    for spell, added in SPELLS.items():
        controller.reset()
        plant, statuses = Plant(bench.scene, bench.problem, CONDITIONS[0]), []
        for k in range(10 + 15 + 150):
            seen = plant.measured()
            if 10 <= k < 25:
                seen += added
            command = controller.command(seen)
            statuses.append(command.status)
            assert np.all((command.torque >= low) & (command.torque <= high)), spell
            plant.advance(command.torque)
        assert Status.OK in statuses[25:75], spell
        assert set(statuses[75:]) == {Status.OK}, spell
        assert_allclose(plant.angles()[2:], bench.problem.reference, atol=5e-3, err_msg=spell)


def test_the_arm_does_not_sink_while_encoders_are_lost(firm: tuple[Bench, EmittedController]) -> None:
    """In a vertical plane, for a second; a law that only brakes lets it fall by 2 rad."""
    bench, controller = firm
    controller.reset()
    plant = Plant(bench.scene, bench.problem, CONDITIONS[0])
    for k in range(80 + 50):
        if k == 80:
            rested = plant.angles()
        command = controller.command(plant.measured(), np.full(6, k < 80))
        plant.advance(command.torque)
    assert command.status is Status.MEASUREMENT
    assert_allclose(plant.angles(), rested, rtol=0.0, atol=0.01)


def test_the_example_arrives(two: Bench, tmp_path: Path) -> None:
    """The folder as it lies, with an accelerometer that feels torques at once."""
    bench = Bench.of(two.scene.replace(**FELT, **{"control.horizon": 16}))
    _, files = emit_controller(bench, "mpc-modes")
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    built = subprocess.run(
        ["sh", "-c", "gcc -std=c99 -O1 *.c */*.c -lm -o example.out && ./example.out | tail -1"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert built.stderr == ""
    time, tip, _, other, _, status = map(float, built.stdout.split(","))
    assert time > 2.9
    assert status == 0.0
    assert [tip, other] == pytest.approx(bench.modes.goal.tip, abs=0.01)


def test_what_knows_of_no_walls_is_refused_beside_one(two: Bench) -> None:
    floor = {"frame": "payload", "normal": [0.0, 1.0], "offset": -0.5, "margin": 0.01}
    walled = Bench.of(two.scene.replace(**{"control.keep": [floor]}))
    with pytest.raises(UserError, match="'mpc-modes' keeps no walls"):
        emit_controller(walled, "mpc-modes")
    assert usual_controller(two) == "rti-zero"
