"""Outputs of several frames on one way out are read on one walk, and are what the reference has."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.reference.spatial_reference import outputs
from tmm_gen.scene import Scene, parse_scene

YAW3 = (Path(__file__).parents[2] / "examples/space/yaw3.toml").read_text().partition("[[output]]")[0]


def reading(of: str, *parts: str) -> Scene:
    return parse_scene(YAW3 + "".join(f'[[output]]\nname = "{p}"\nat = "{p}"\nof = "{of}"\n' for p in parts))


def cost(scene: Scene) -> int:
    return count_routine(build_program(scene).output).total


@pytest.mark.parametrize("of", ["position", "velocity", "orientation"])
def test_one_walk_passes_all_frames_on_its_way(of: str) -> None:
    parts = ("elbow", "forearm", "payload", "upper")
    together = reading(of, *parts)
    farthest = max(cost(reading(of, part)) for part in parts)
    apart = sum(cost(reading(of, part)) for part in parts)
    assert farthest <= cost(together) < farthest + 0.1 * (apart - farthest)
    program, arm = build_program(together), together.spatial
    assert arm is not None
    module, rng, n = numpy_module(together, program), np.random.default_rng(4), len(arm.joints)
    state = module.initialise(
        module.Params(), module.Input(), initial_angle=rng.normal(size=n), initial_rate=rng.normal(size=n)
    )
    read = module.output(module.prepare(), state)
    wanted = outputs(arm, *(x[None] for x in (state.angle, state.rate, state.acceleration)), {})
    for column, values in wanted.items():
        assert getattr(read, column) == pytest.approx(values[0], rel=1e-12, abs=1e-12), column
