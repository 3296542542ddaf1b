"""The loop in real time beside an emitted controller: it compiles as it lies, and moves the arm that Python moves,
whose sensors show the same.

How late it wakes is the machine's: nothing is said of that but that it waits at all.
"""

from __future__ import annotations

import re
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.closed_loop.space_plant import plant_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.space_motors import space_motors
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.goals.target import rest_with
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.scene import Scene, load_scene

pytestmark = pytest.mark.compiler

STRICT = "gcc -std=c99 -O1 -Wall -Wextra -Wpedantic -c"
PROBE = """
#define main loop_main
#include "example/loop.c"
#undef main
int main(void)
{
    NAME_real measured[SENSORS], torque[MOTORS];
    int good = begin();
    for (int k = 0; k < 12; ++k) {
        for (int j = 0; j < MOTORS; ++j) {
            torque[j] = (NAME_real)(start_torque[j] * (1.0 + 0.25 * k) + 0.0078125 * (k % 5));
        }
        write_torques(torque);
        good = good && let_time_pass();
        read_sensors(measured);
        for (int i = 0; i < SENSORS; ++i) {
            printf("%.17g ", (double)measured[i]);
        }
    }
    return !good;
}
"""
"""Moves the arm of the loop by torques that are known, and prints what its sensors show."""
MID_MOTION = 0.26
"""s."""


@pytest.fixture(scope="module")
def arms(swing: Scene, repository: Path) -> dict[str, Bench]:
    """Arms whose many sensors hardly rustle: on a hub, torques late; in a plane; in space, late by 1.5 samples."""
    felt = {"control.sensors.accelerometer": 1e-9, "control.sensors.strain": 1e-9}
    hub = {"control.delay": 0.01}
    two = {"beam.upper.links": 2, "beam.forearm.links": 2, "control.horizon": 12, "control.substeps": 2}
    space = {"beam.upper.links": 1, "beam.forearm.links": 1, "control.horizon": 20, "control.delay": 0.015}
    outer = dict.fromkeys(("shoulder", "elbow"), 1e-9)
    space |= {"control.sensors.accelerometer": 1e-9, "control.sensors.strain": outer}
    return {
        "hub": Bench.of(swing.replace(**felt, **hub)),
        "plane": Bench.of(load_scene(repository / "scenes" / "elbow.toml").replace(**felt, **two)),
        "space": Bench.of(load_scene(repository / "examples" / "space" / "reach3.toml").replace(**space)),
    }


def tips_in_python(bench: Bench, controller: Controller, seconds: float) -> np.ndarray:
    """Return the tips' angles after the same loop in Python, as controllers reckon them, rad."""
    plant = plant_of(bench.scene, bench.problem, CONDITIONS[0])
    samples = round(seconds / bench.problem.sample_time)
    controller.reset()
    if not bench.problem.motors.on_hub:
        controller.aim(0.5 * (bench.problem.start + bench.problem.reference))
    for sample in range(samples):
        torque = controller.command(plant.measured()).torque
        if sample == samples // 2 and not bench.problem.motors.on_hub:
            controller.aim(bench.problem.reference)
        controller.prepare()
        plant.advance(torque)
    flat = plant.scene.spatial is None
    motors = motors_of(plant.scene) if flat else space_motors(plant.scene, bench.problem.reference)
    state = plant.kernel.state
    return motors.tip @ np.array([*([state["hub_angle"]] if plant.scene.hub else []), *state["angle"]])


def shown_in_python(bench: Bench) -> np.ndarray:
    """Return what the sensors of the same arm show along the motion of the probe."""
    plant = plant_of(bench.scene, bench.problem, CONDITIONS[0])
    held = np.zeros(bench.problem.count)
    if not bench.problem.motors.on_hub:
        held = rest_with(plant.scene, bench.problem.start, "initial.angles").goal.torque
    seen = []
    for k in range(12):
        plant.advance(held * (1.0 + 0.25 * k) + 0.0078125 * (k % 5))
        seen.append(plant.measured())
    shown = np.array(seen)
    return shown[:, ~np.isnan(shown[0])].ravel()


@pytest.mark.parametrize(
    ("which", "kind", "real"),
    [("hub", "mpc-modes", "float64"), ("plane", "rti-zero", "float32"), ("space", "mpc-links", "float64")],
)
def test_the_loop_moves_the_arm_as_python_does(
    which: str,
    kind: str,
    real: str,
    arms: dict[str, Bench],
    in_python: Callable[[Bench, str], Controller],
    tmp_path: Path,
) -> None:
    bench = arms[which]
    for path, text in emit_controller(bench, kind, real, real_time=True)[1].items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)

    def shell(command: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, cwd=tmp_path, shell=True, capture_output=True, text=True, check=False)

    name = next(path.stem for path in tmp_path.glob("*.h") if path.stem.endswith(kind.replace("-", "_")))
    (tmp_path / "probe").mkdir()
    (tmp_path / "probe" / "probe.c").write_text(PROBE.replace("NAME", name))
    done = shell(
        f"{STRICT} example/loop.c *.c plant/*.c daqp/*.c && gcc *.o -lm -o loop && rm loop.o && "
        f"{STRICT} -I. probe/probe.c && gcc *.o -lm -o probe/probe"
    )
    assert (done.returncode, done.stderr) == (0, "")

    done = shell("probe/probe")
    assert done.returncode == 0
    seen, expected = np.array(done.stdout.split(), float), shown_in_python(bench)
    assert seen == pytest.approx(expected, abs=1e-7 if real == "float64" else 1e-6, rel=1e-6)

    run = shell("./loop 3 free")
    assert (run.returncode, run.stderr) == (0, ""), run.stdout
    samples = round(3.0 / bench.problem.sample_time)
    assert f"\nstatuses: OK {samples}\n" in run.stdout
    assert "deadline" not in run.stdout

    run = shell(f"./loop {MID_MOTION} free")
    assert run.returncode == 1, run.stdout
    shown = [float(angle) for angle in re.findall(r"^tip of .*: (\S+) rad", run.stdout, re.MULTILINE)]
    expected = tips_in_python(bench, in_python(bench, kind), MID_MOTION)
    assert np.max(np.abs(expected - bench.problem.start)) > 0.05
    assert shown == pytest.approx(expected, abs=1e-4 if real == "float64" else 1e-3)

    begin = time.monotonic()
    run = shell("./loop 0.3")
    assert time.monotonic() - begin >= 0.3
    assert run.returncode & 1, run.stdout
    times = re.findall(
        r"^(woken late|measurement to torque|whole sample) +(\S+) +(\S+) +(\S+)$", run.stdout, re.MULTILINE
    )
    assert len(times) == 3
    assert all(0.0 <= float(median) <= float(most) <= float(longest) for _, median, most, longest in times)
    assert re.search(r"^deadlines missed: \d+, by more than a sample: \d+$", run.stdout, re.MULTILINE)

    assert shell("./loop 0").returncode == shell("./loop 1 fast").returncode == 4
