"""Who stands in docs/speed.md solves the same arm, and the page says what was measured."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.reference.planar_reference import planar_response

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[2]


def test_peers_fall_as_lagrange_says() -> None:
    pytest.importorskip("casadi")
    pytest.importorskip("mujoco")
    from against_time.contenders import peers
    from peers.joint_arm import joint_arm
    from time_to_error import CHECKPOINTS, arm

    scene = arm("gravity", 2, "newmark")
    response = planar_response(scene, {}, np.concatenate([[0.0], CHECKPOINTS]))
    truth = np.column_stack([response["tip_x"], response["tip_y"]])[1:]
    found = {each.name: each for each in peers(joint_arm(scene), truth)}
    for name in ("articulated bodies in C, RK4", "MuJoCo, RK4"):
        coarse, fine = (found[name].error(count) for count in (32, 64))
        assert 3.7 < np.log2(coarse / fine) < 4.3, name
    for name, order in (("articulated bodies in C, Newmark", 2), ("MuJoCo, implicit", 1)):
        coarse, fine = (found[name].error(count) for count in (128, 256))
        assert order - 0.2 < np.log2(coarse / fine) < order + 0.2, name
    assert found["SciPy, LSODA"].error(1e-9) < 1e-6


def test_times_are_read_between_settings_by_powers() -> None:
    from against_time.picture import curves_of

    rows = [("one", "a", 1, 1e-2, 1.0), ("one", "a", 2, 1e-1, 2.0), ("one", "a", 3, 1e-4, 100.0)]
    (curve,) = curves_of(rows)
    assert curve.front() == ([1.0, 100.0], [1e-2, 1e-4])
    assert curve.time_to(1e-3) == pytest.approx(10.0)
    assert curve.time_to(0.5) == 1.0
    assert curve.time_to(1e-5) is None


def test_the_page_says_what_was_measured() -> None:
    from against_time.page import told
    from against_time.picture import Curve

    data = json.loads((ROOT / "benchmarks" / "error_against_time.json").read_text())
    table = told([Curve(**values) for values in data["curves"]])
    assert table in (ROOT / "docs" / "speed.md").read_text()
