"""Single precision on a long run: what the choice of unknown is worth."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.reference import exact_response
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import load_scene

pytestmark = pytest.mark.compiler


def error(real: str, unknown: str) -> float:
    """RMS error of the tip angle over its static deflection: thesis10, Newmark 1/4, 1 ms steps, 20 s."""
    changes: dict[str, Any] = {"emit.real": real, "model.unknown": unknown, "integrator.step": 1e-3}
    scene = load_scene(scenes_dir() / "thesis10.toml").replace(**changes)
    times, outputs = compile_kernel(build_program(scene), scene).simulate(20.0, {"tip_torque": 1.0})
    exact = exact_response(scene, {"tip_torque": Constant(1.0)}, times)["tip"]
    static = sum(1.0 / joint.stiffness for joint in scene.joints)
    return float(np.sqrt(np.mean((outputs["tip"] - exact) ** 2)) / static)


def test_accelerations_keep_four_digits() -> None:
    assert error("float32", "acceleration") <= 1e-4


def test_increments_are_worse() -> None:
    assert 1e-4 < error("float32", "increment") <= 1e-3


def test_displacements_lose_nearly_half() -> None:
    """The cancellation of 1/h^2 in the history terms; 0.41 when this was written."""
    assert 0.2 <= error("float32", "displacement") <= 0.5


def test_in_double_precision_all_are_right() -> None:
    """What remains is the integrator's own error."""
    errors = [error("float64", unknown) for unknown in ("acceleration", "increment", "displacement")]
    assert max(errors) <= 1e-6
    assert np.ptp(errors) <= 1e-8
