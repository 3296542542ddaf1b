"""Bounds on what a sweep keeps: wide enough for every state of the box, and no wider than can be proved."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.box import Box, box_of, complete_box
from tmm_gen.emit.c.fence import MARGIN, fence_of, kept_answers
from tmm_gen.emit.c.lower import lower
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.native.library import OutOfRangeError
from tmm_gen.program.build import build_program
from tmm_gen.program.evaluate import VanishingPivotError
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[3] / "scenes"


@pytest.fixture(scope="module")
def arm() -> Scene:
    return load_scene(SCENES / "arm10.toml")


@pytest.fixture(scope="module")
def program(arm: Scene) -> Program:
    return lower(build_program(arm))


def _box(scene: Scene) -> Box:
    box = box_of(scene)
    assert box is not None
    return box


def test_what_an_arm_keeps_of_its_sweep_is_fenced(program: Program) -> None:
    assert [v.name for v in kept_answers(program.main)] == ["answer_own", "answer_x", "answer_y"]


def test_a_chain_has_nothing_to_fence() -> None:
    scene = load_scene(SCENES / "thesis10.toml")
    program = lower(build_program(scene))
    assert not fence_of(program, _box(scene), program.main)
    assert "OUT_OF_RANGE" not in emit_kernel(program, scene)["c/thesis10.h"]


def test_bounds_are_powers_of_two_and_the_same_every_time(arm: Scene, program: Program) -> None:
    fence = fence_of(program, _box(arm), program.main)
    assert fence == fence_of(program, _box(arm), program.main)
    for bound in (*fence.largest.values(), *fence.least.values()):
        assert np.frexp(bound)[0] == 0.5
    assert all(least > 0.0 for least in fence.least.values())


def test_a_larger_box_has_wider_bounds(arm: Scene, program: Program) -> None:
    box = _box(arm)
    wide = Box({name: (8.0 * low, 8.0 * high) for name, (low, high) in box.bounds.items()}, box.inputs)
    small, large = fence_of(program, box, program.main), fence_of(program, wide, program.main)
    assert large.largest["answer_own"] > small.largest["answer_own"]


@pytest.mark.compiler
@pytest.mark.parametrize("corners", [False, True], ids=["inside", "corners"])
def test_states_of_the_box_are_taken(arm: Scene, corners: bool) -> None:
    """Bounds come from other random states. In the box's corners, which no arm reaches, pivots do vanish."""
    kernel = compile_kernel(build_program(arm), arm)
    kernel.prepare()
    box = _box(arm).bounds
    draw = np.random.default_rng(1)
    taken = 0

    def some(key: str, count: int = 1) -> list[float]:
        low, high = box[key]
        return [
            float(x) for x in (draw.choice([low, high], count) if corners else draw.uniform(low, high, count))
        ]

    for _ in range(300):
        kernel.state = {
            "hub_angle": some("angles")[0],
            "hub_rate": some("rates")[0],
            "hub_acceleration": some("accelerations")[0],
            "angle": some("angles", 10),
            "rate": some("rates", 10),
            "acceleration": some("accelerations", 10),
        }
        with suppress(VanishingPivotError, *([OutOfRangeError] if corners else [])):
            kernel.step({"hub_torque": some("hub_torque")[0], "tip_force": some("tip_force")[0]})
            taken += 1
    assert taken > (50 if corners else 270)


@pytest.mark.compiler
def test_far_outside_the_box_a_step_is_refused_and_changes_nothing(arm: Scene) -> None:
    kernel = compile_kernel(build_program(arm), arm)
    kernel.prepare()
    kernel.initialise()
    kernel.state = {"angle": [1e6 * (-1) ** j for j in range(10)]}
    before = kernel.state
    with pytest.raises(OutOfRangeError):
        kernel.step()
    after = kernel.state
    assert all(np.array_equal(before[name], after[name]) for name in before)


@pytest.mark.compiler
def test_fences_change_no_bit(arm: Scene) -> None:
    runs = []
    for scene in (arm, arm.replace(**{"emit.box": None})):
        _, outputs = compile_kernel(build_program(scene), scene).simulate(0.1, {"hub_torque": 4.0})
        runs.append({name: values.tobytes() for name, values in outputs.items()})
    assert runs[0] == runs[1]


def test_the_guards_are_in_the_text(arm: Scene, program: Program) -> None:
    source = emit_kernel(build_program(arm), arm)["c/arm10.c"]
    fence = fence_of(program, _box(arm), program.main)
    step = source.partition("arm10_status arm10_step(")[2]
    assert f"if (!(fabs(answer_x[j]) < {fence.largest['answer_x']!r}))" in step
    assert re.search(rf"if \(!\(pivot > {re.escape(repr(fence.least['pivot']))}\)", step)
    assert MARGIN > 1.0


def test_a_box_without_all_bounds_fences_nothing(arm: Scene) -> None:
    scene = arm.replace(**{"emit.box": {"angles": [-1.0, 1.0]}})
    program = build_program(scene)
    assert complete_box(scene, program) is None
    assert _box(scene).missing(program) == ["rates", "accelerations", "hub_torque", "tip_force"]
    assert "fabs(answer_x" not in emit_kernel(program, scene)["c/arm10.c"]


def test_a_state_without_a_key_is_named(arm: Scene) -> None:
    scene = arm.replace(**{"model.linearisation": "taylor"})
    with pytest.raises(UserError, match="no key for the state's"):
        _box(scene).missing(build_program(scene))
