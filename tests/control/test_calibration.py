"""Calibration finds what made a record, says how sure it is, and refuses what a record cannot tell."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.calibration.calibrate import calibrate
from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Table
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene
from tmm_gen.scene.rewrite import rewritten

pytestmark = pytest.mark.compiler

NOISE = 1e-3


def recorded(scene: Scene, until: float = 1.5) -> dict[str, Table]:
    """Let an arm swing under a torque to and fro, and record hub and tip with noise."""
    kernel = compile_kernel(build_program(scene), scene)
    times, outputs = kernel.simulate(until, {"hub_torque": lambda t: np.sin(9.0 * t)})
    random = np.random.default_rng(5)
    noisy = {name: outputs[name] + NOISE * random.standard_normal(len(times)) for name in ("hub", "tip_y")}
    noisy["hub_torque"] = np.sin(9.0 * times)
    return {name: Table(times, values) for name, values in noisy.items()}


def test_stiffness_and_damping_are_found_and_written_back(swing: Scene) -> None:
    made = {"beam.bending_stiffness": 9.0, "beam.damping_time": 2.5e-3}
    done = calibrate(swing, recorded(swing.replace(**made)))
    for found in done.found:
        truth = made[found.key]
        assert abs(found.value - truth) < 4.0 * found.deviation
        assert found.deviation < 0.05 * truth
        assert found.interval[0] < found.value < found.interval[1]
    assert done.misfit < 0.3 * done.misfit_before
    assert done.scene.beam is not None
    assert done.scene.beam.bending_stiffness == done.found[0].value
    text = Path(swing.source.origin).read_text()
    again = rewritten(text, "swing.toml", done.scene, done.changes)
    assert "# EI, N m^2" in again
    assert len(again.splitlines()) == len(text.splitlines())


def test_the_deviation_is_that_of_repeated_fits(swing: Scene) -> None:
    """It grows with the noise as it must: what is left is the noise."""
    done = calibrate(swing, recorded(swing), ["beam.bending_stiffness"])
    scale = np.mean([NOISE / np.std(recorded(swing)[name].values) for name in ("hub", "tip_y")])
    assert done.misfit == pytest.approx(scale, rel=0.2)
    assert done.found[0].value == pytest.approx(12.0, abs=4.0 * done.found[0].deviation)


def test_a_factor_of_all_joints(swing: Scene) -> None:
    """Where there is no beam, stiffness and damping are factors of all joints."""
    joints = [{"stiffness": 20.0, "damping": 0.05, "repeat": 2}]
    links = [{"mass": 0.2, "length": 0.5, "inertia": 0.005, "repeat": 2}]
    scene = swing.replace(beam=None, joint=joints, link=links, control=None)
    truth = scene.replace(**{"joint.1.stiffness": 30.0, "joint.1.damping": 0.08})
    done = calibrate(scene, recorded(truth, 1.0))
    assert [found.value for found in done.found] == pytest.approx([1.5, 1.6], rel=0.02)
    assert done.scene.joints[1].stiffness == pytest.approx(30.0, rel=0.01)


def test_what_cannot_be_fitted_is_refused(swing: Scene) -> None:
    record = recorded(swing, 0.3)
    with pytest.raises(UserError, match=r"no number 'beam\.stiffness'"):
        calibrate(swing, record, ["beam.stiffness"])
    with pytest.raises(UserError, match="only a positive number"):
        calibrate(swing, record, ["base.kind"])
    with pytest.raises(UserError, match="none of the outputs"):
        calibrate(swing, {"hub_torque": record["hub_torque"]})
    still = {name: Table(table.times, 0.0 * table.values) for name, table in record.items()}
    with pytest.raises(UserError, match="does not tell"):
        calibrate(swing, still)


def test_a_record_without_what_moved_the_arm(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What the error says to add lets the same record be fitted."""
    scene, record = str(scenes_dir() / "thesis2.toml"), str(tmp_path / "record.csv")
    assert main(["run", scene, "--input", "tip_torque=1", "--until", "20", "--csv", record]) == 0
    capsys.readouterr()
    assert main(["calibrate", scene, record]) == 2
    said = capsys.readouterr().err
    assert "the record has no column tip_torque" in said
    added = re.search(r"for example (--input \S+=1)\.$", said.strip())
    assert added is not None, said
    assert main(["calibrate", scene, record, *added[1].split()]) == 0
