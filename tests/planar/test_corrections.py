"""Corrections: a sweep's factors kept, forces anew. They find what sweeps find, for less, where one sweep does not."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tmm_gen.control.prediction.prediction import prediction_scene
from tmm_gen.native import NativeKernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, SceneError, parse_scene
from tmm_gen.scene.template import template
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

TIP = {"name": "tip", "at": "tip", "of": "position"}


@pytest.mark.parametrize("base", ["motor", "prescribed"])
def test_they_end_where_sweeps_end(base: str, unlike: Callable[..., Scene]) -> None:
    scene = unlike(base, 2, step=0.01, iterations=1).replace(output=[TIP])
    changes = (
        {"model.iterations": 5},
        {"model.iterations": 2, "model.corrections": 4},
        {"model.corrections": 1},
        {},
    )
    scenes = [scene.replace(**each) for each in changes]
    programs = [build_program(each) for each in scenes]
    modules = [numpy_module(*pair) for pair in zip(scenes, programs, strict=True)]
    vectors = list(reached_vectors(modules[0], programs[0], 3))
    right, *others = (numpy_step(*pair) for pair in zip(modules, programs, strict=True))
    many, once, alone = (largest_difference(right, step, vectors) for step in others)
    assert many < 1e-10
    assert 1e-10 < once < 0.1 * alone


@pytest.mark.compiler
def test_backends_agree(unlike: Callable[..., Scene], compiled: Callable[[Scene], NativeKernel]) -> None:
    scene = unlike("motor", 2, step=0.01, corrections=1).replace(output=[TIP])
    program = build_program(scene)
    module = numpy_module(scene, program)
    vectors = list(reached_vectors(module, program, 3))
    ours = numpy_step(module, program)
    assert largest_difference(ours, native_step(compiled(scene), program), vectors) < 1e-12
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < 1e-12


@pytest.mark.compiler
def test_long_steps_of_fine_arms_come_right(
    falling: Callable[..., Scene], compiled: Callable[[Scene], NativeKernel]
) -> None:
    """A sweep alone is wrong by as much as newest accelerations are; one correction leaves the integrator's error."""
    scene = falling(20, **{"model.gravity": 9.81, "model.iterations": 1})
    exact = tips(compiled(scene), 2e-4)
    off = {
        changes: np.max(np.hypot(*(tips(compiled(scene.replace(**dict([changes]))), 0.05) - exact)))
        for changes in (("model.iterations", 1), ("model.iterations", 6), ("model.corrections", 1))
    }
    alone, right, corrected = off.values()
    assert alone > 2.0 * right
    assert abs(corrected / right - 1.0) < 0.05


def tips(kernel: NativeKernel, step: float) -> np.ndarray:
    """Return where the tip is at each tenth of a second."""
    _, outputs = kernel.simulate(1.0, step=step)
    each = round(0.1 / step)
    return np.array([outputs[name][each::each] for name in ("tip_x", "tip_y")])


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"emit.sensitivities": True}, "model.corrections: and emit.sensitivities exclude each other"),
        ({"model.linearisation": "taylor"}, 'contradicts linearisation = "taylor", which does not iterate'),
    ],
)
def test_what_has_none_says_so(changes: dict[str, Any], said: str, falling: Callable[..., Scene]) -> None:
    with pytest.raises(SceneError, match=re.escape(said)):
        falling(2, **{"model.corrections": 1, **changes})
    instead = {"model.iterations": 2} if "emit.sensitivities" in changes else {}
    falling(2, **changes, **instead)


def test_controllers_predict_by_sweeps_alone() -> None:
    text = template("steered", "planar", control=True).replace(
        'kind = "planar"', 'kind = "planar"\ncorrections = 1', 1
    )
    scene = parse_scene(text)
    predicted = prediction_scene(scene, calibrate=False)
    assert (scene.model.corrections, predicted.model.corrections) == (1, 0)
    assert predicted.emit.sensitivities


def test_runs_that_sweep_as_often_as_it_takes_do_without(falling: Callable[..., Scene]) -> None:
    plain, corrected = falling(2), falling(2, **{"model.corrections": 1})
    assert build_program(plain, auto=True) == build_program(corrected, auto=True)
