"""A fault planted in emitted C is caught, each kind by the check that is meant to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import pytest

from tmm_gen.emit.c import emit_c, emit_kernel
from tmm_gen.emit.c.box import box_of
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.target.lint import CHECKS, lint
from tmm_gen.target.proof import Alarm, analyse, driver

Emitting = Callable[..., Scene]
SOURCE = "c/thesis10.c"
TOOLS = {
    "gcc_warnings": ("gcc", "gcc"),
    "clang_warnings": ("clang", "clang"),
    "gcc_analyzer": ("gcc", "gcc"),
    "misra": ("cppcheck", "cppcheck"),
    "single_precision": ("arm-none-eabi-gcc", "gcc-arm-none-eabi"),
    "host_test": ("gcc", "gcc"),
}


@dataclass(frozen=True)
class Fault:
    """A change of the source."""

    kind: str
    old: str
    new: str


OUT_OF_BOUNDS = Fault(
    "out of bounds", "j = THESIS10_STATIONS - 1; j >= 0; --j", "j = THESIS10_STATIONS; j >= 0; --j"
)
DIVISION = Fault("division by zero", "admittance = 1.0f / pivot;", "admittance = 1.0f / (pivot - pivot);")
UNINITIALISED = Fault("uninitialised", "    known_rate[0] = 0.0f;\n", "")
OVERFLOW = Fault(
    "overflow", "angle_per_acceleration * unknown;", "angle_per_acceleration * unknown * 1e38f * 1e3f;"
)
WRONG_SIGN = Fault("wrong sign", "(torque - joint_torque);", "(torque + joint_torque);")
DOUBLE = Fault("implicit double", "real unknown = 0.0f;", "real unknown = (real)(0.1 * inputs->tip_torque);")


@pytest.fixture(scope="module")
def scene(emitting: Emitting) -> Scene:
    return emitting("thesis10", real="float32")


@pytest.fixture(scope="module")
def files(scene: Scene) -> dict[str, str]:
    return emit_c(build_program(scene), scene)


@pytest.fixture(scope="module")
def prove_text(
    scene: Scene, need_tool: Callable[[str, str], str]
) -> Callable[[dict[str, str]], tuple[Alarm, ...]]:
    """Run the proof on a changed source."""
    need_tool("frama-c", "frama-c-base")
    box = box_of(scene)
    assert box is not None
    call = driver(Kernel.of(build_program(scene), scene), box)

    def alarms(files: dict[str, str]) -> tuple[Alarm, ...]:
        kernel = {path: files[path] for path in ("c/thesis10.h", SOURCE)}
        return analyse({**kernel, "proof.c": call}, "thesis10")[0]

    return alarms


def _planted(files: dict[str, str], fault: Fault) -> dict[str, str]:
    assert fault.old in files[SOURCE], fault.kind
    before, _, step = files[SOURCE].partition("thesis10_status thesis10_initialise(")
    return {
        **files,
        SOURCE: before + "thesis10_status thesis10_initialise(" + step.replace(fault.old, fault.new),
    }


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        (OUT_OF_BOUNDS, "out of bounds"),
        (DIVISION, "is_finite"),
        (UNINITIALISED, "initialized"),
        (OVERFLOW, "is_finite"),
    ],
    ids=lambda value: value.kind.replace(" ", "_") if isinstance(value, Fault) else "",
)
def test_the_proof_finds(
    files: dict[str, str], prove_text: Callable[[dict[str, str]], tuple[Alarm, ...]], fault: Fault, said: str
) -> None:
    alarms = prove_text(_planted(files, fault))
    assert any(said in alarm.text and alarm.file == "thesis10.c" for alarm in alarms), alarms


def test_the_proof_finds_nothing_where_nothing_is(
    files: dict[str, str], prove_text: Callable[[dict[str, str]], tuple[Alarm, ...]]
) -> None:
    assert prove_text(files) == ()


@pytest.mark.parametrize(
    ("check", "fault", "said"),
    [
        ("host_test", WRONG_SIGN, "tip is"),
        ("gcc_warnings", DOUBLE, "double-promotion"),
        ("clang_warnings", DOUBLE, "double-promotion"),
        ("single_precision", DOUBLE, "__aeabi_dmul"),
        ("host_test", OUT_OF_BOUNDS, "out of bounds"),
        ("host_test", DIVISION, "division by zero"),
        (
            "gcc_warnings",
            Fault("shadowed", "    real torque = ", "    real damping = 0.0f;\n    real torque = "),
            "damping",
        ),
        (
            "misra",
            Fault(
                "no braces",
                "        if ((initial_angle != NULL",
                "        if (bias > 0.0f) bias = 0.0f; if (!isfinite(initial",
            ),
            "15.6",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) and "_" in value else "",
)
def test_a_check_finds(
    files: dict[str, str], need_tool: Callable[[str, str], str], check: str, fault: Fault, said: str
) -> None:
    need_tool(*TOOLS[check])
    found = CHECKS[check](_planted(files, fault))
    assert found.check == check
    assert not found.passed
    assert said in found.said


def test_the_analyser_finds_a_null_pointer(
    files: dict[str, str], need_tool: Callable[[str, str], str]
) -> None:
    need_tool(*TOOLS["gcc_analyzer"])
    fault = Fault(
        "null", "    real torque = inputs->tip_torque;", "    real *none = 0;\n    real torque = *none;"
    )
    found = CHECKS["gcc_analyzer"](_planted(files, fault))
    assert not found.passed
    assert "null" in found.said


@pytest.mark.parametrize(("name", "parameters"), [("arm10", "free"), ("thesis10", "bound")])
def test_emitted_kernels_pass_every_check(
    emitting: Emitting, need_tool: Callable[[str, str], str], name: str, parameters: str
) -> None:
    for tool in TOOLS.values():
        need_tool(*tool)
    scene = emitting(name, real="float32", parameters=parameters)
    rows = lint(emit_c(build_program(scene), scene), "float32")
    assert [row.check for row in rows] == list(CHECKS)
    assert all(row.passed for row in rows), [row for row in rows if not row.passed]


@pytest.mark.parametrize("name", ["drivetrain", "fall10", "arm2", "thesis2"])
def test_single_precision_is_free_of_doubles_in_every_kind_of_arm(
    emitting: Emitting, need_tool: Callable[[str, str], str], name: str
) -> None:
    need_tool(*TOOLS["single_precision"])
    scene = emitting(name, real="float32")
    found = CHECKS["single_precision"](emit_kernel(build_program(scene), scene))
    assert found.passed, found.said


def test_doubles_are_not_asked_to_be_single(
    files: dict[str, str], need_tool: Callable[[str, str], str]
) -> None:
    for tool in TOOLS.values():
        need_tool(*tool)
    assert "single_precision" not in [row.check for row in lint({}, "float64")]


@pytest.mark.parametrize("check", ["gcc_analyzer", "misra", "single_precision"])
def test_analysers_see_one_arm_and_not_the_vectors_of_many(
    emitting: Emitting, need_tool: Callable[[str, str], str], check: str
) -> None:
    scene = emitting("thesis2", real="float32", batch=4)
    files = emit_c(build_program(scene), scene)
    assert "c/thesis2_batch.c" in files
    need_tool(*TOOLS[check])
    row = CHECKS[check](files)
    assert row.passed, row.said


def test_a_file_is_left_out_for_its_vectors_and_not_for_its_name(
    files: dict[str, str], need_tool: Callable[[str, str], str]
) -> None:
    need_tool(*TOOLS["misra"])
    row = CHECKS["misra"]({**files, "c/arm_batch.c": "int f(int x) { if (x) x = 0; return x; }\n"})
    assert not row.passed
    assert "arm_batch.c" in row.said
