"""A new output, added here alone: how fast a link of a planar arm gains speed, one row of the table of quantities."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.response import frequency_response
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Output, Scene, load_scene
from tmm_gen.scene.columns import output_columns
from tmm_gen.scene.quantity import PLANAR, Quantity
from tmm_gen.simulate.run import simulate

SCENE = Path(__file__).resolve().parents[2] / "scenes" / "arm2.toml"


@pytest.fixture
def scene(monkeypatch: pytest.MonkeyPatch) -> Scene:
    monkeypatch.setitem(PLANAR, "angular_acceleration", Quantity("rad/s^2", "acceleration", "motion", 2))
    gain = Output.model_construct(name="gain", at=1, of="angular_acceleration")
    return replace(load_scene(SCENE), outputs=(Output(name="rate", at=1, of="rate"), gain))


def test_kernels_references_and_the_frequency_domain_know_it(scene: Scene) -> None:
    assert [column.what for column in output_columns(scene)] == [
        "rate at station 1",
        "angular acceleration at station 1",
    ]
    acting = {item.name: Constant(0.2) for item in scene.inputs}
    run = simulate(replace(scene, integrator=replace(scene.integrator, step=1e-3)), acting, 0.1, "numpy")
    exact = exact_response(scene, acting, run.time)
    scale = np.max(np.abs(exact["gain"]))
    assert scale > 1.0
    np.testing.assert_allclose(run.outputs["gain"], exact["gain"], atol=2e-3 * scale)
    slope = np.gradient(exact["rate"], run.time)
    np.testing.assert_allclose(slope[1:-1], exact["gain"][1:-1], atol=2e-3 * scale)

    s = 1j * np.array([0.7, 5.0])
    answer = frequency_response(linear_arm(scene), s)
    np.testing.assert_allclose(answer["gain"], s[:, None] * answer["rate"], rtol=1e-13)
