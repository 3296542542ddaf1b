"""Turns kept apart: the same motion, from angles that stay small."""

from __future__ import annotations

import numpy as np
import pytest

from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene

SUMS = {"emit.real": "float32", "emit.compensated": True}


def scene(name: str, **changes: object) -> Scene:
    return load_scene(scenes_dir() / f"{name}.toml").replace(**changes)


@pytest.mark.parametrize("method", ["generalized_alpha", "houbolt", "sdirk2"])
def test_outputs_are_those_of_the_chain_that_turns(method: str) -> None:
    found = []
    for changes in ({}, SUMS):
        drive = scene("drivetrain", **{"integrator.name": method}, **changes)
        module = numpy_module(drive, build_program(drive))
        model = module.prepare()
        state = module.initialise(initial_rate=300.0)
        rows = []
        for _ in range(200):
            state = module.step(model, state, module.Input(motor_torque=2.0, load_torque=-3.0))
            outputs = module.output(model, state)
            rows.append([float(getattr(outputs, name)) for name in module.OUTPUT_NAMES])
        found.append(np.array(rows))
    with_turns, without = found
    assert np.max(with_turns[:, -1]) > 5.0  # rad
    assert np.max(np.abs(without - with_turns) / np.max(np.abs(with_turns), axis=0)) < 1e-9
    assert float(state.hub_angle) == 0.0
    assert np.max(np.abs(state.angle)) < 0.1 * float(state.turned)
    assert float(state.turned) > 5.0


def test_nothing_is_kept_apart_where_a_chain_is_held_or_not_compensated() -> None:
    for each in (scene("drivetrain"), scene("thesis10", **SUMS)):
        assert "turned" not in [v.name for v in build_program(each).state]
