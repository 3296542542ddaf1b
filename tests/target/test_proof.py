"""Proof of kernels within their boxes."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tmm_gen.emit.c import emit_kernel
from tmm_gen.errors import UserError
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.target import prove
from tmm_gen.target.proof import analyse

Emitting = Callable[..., Scene]


@pytest.fixture(scope="module", autouse=True)
def frama_c(need_tool: Callable[[str, str], str]) -> None:
    need_tool("frama-c", "frama-c-base")


@pytest.mark.parametrize(
    ("name", "real", "parameters"),
    [
        ("thesis10", "float32", "free"),
        ("thesis10", "float64", "bound"),
        ("arm10", "float32", "free"),
        ("arm10", "float64", "bound"),
    ],
)
def test_no_fault_is_possible_within_the_box(
    emitting: Emitting, name: str, real: str, parameters: str
) -> None:
    found = prove(emitting(name, real=real, parameters=parameters))
    assert found.proved, found.alarms
    assert found.box == emitting(name).emit.box


def test_the_step_may_be_part_of_the_box(emitting: Emitting) -> None:
    scene = emitting("thesis10")
    box = {**(scene.emit.box or {}), "step": [0.0099, 0.0101]}
    assert prove(scene.replace(**{"emit.box": {k: list(v) for k, v in box.items()}})).proved


def test_start_up_steps_are_proved_too(emitting: Emitting) -> None:
    assert prove(emitting("thesis10").replace(**{"integrator.name": "houbolt"})).proved


def test_without_its_bounds_the_sweep_of_an_arm_is_not_proved(emitting: Emitting) -> None:
    """What the kernel checks on its way is needed: intervals alone do not know that an arm is passive."""
    scene = emitting("arm10")
    unguarded = emit_kernel(build_program(scene), emitting("arm10", box=None))
    from tmm_gen.emit.c.box import box_of
    from tmm_gen.emit.c.kernel import Kernel
    from tmm_gen.target.proof import driver

    box = box_of(scene)
    assert box is not None
    call = driver(Kernel.of(build_program(scene), scene), box)
    alarms, _ = analyse({**unguarded, "proof.c": call}, "arm10")
    assert alarms
    assert all("is_finite" in alarm.text for alarm in alarms)


def test_a_missing_box_is_asked_for(emitting: Emitting) -> None:
    with pytest.raises(UserError, match=r"arm10.toml.*\[emit.box\]: is missing.*angles = "):
        prove(emitting("arm10", box=None))


def test_missing_bounds_are_named(emitting: Emitting) -> None:
    with pytest.raises(UserError, match="bounds of rates, accelerations, tip_torque are missing"):
        prove(emitting("thesis10").replace(**{"emit.box": {"angles": [-1.0, 1.0]}}))


def test_a_missing_analyser_is_named_with_its_package(
    emitting: Emitting, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(UserError, match="apt-get install frama-c-base"):
        prove(emitting("thesis10"))
