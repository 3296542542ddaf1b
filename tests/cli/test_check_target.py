"""`tmm-gen check` on microcontrollers, as a proof, and before analysers."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.cli.check_target import TARGETS
from tmm_gen.target import BOARDS

SCENES = Path(__file__).resolve().parents[2] / "scenes"
Need = Callable[[str, str], str]


@pytest.fixture
def arm(need_tool: Need) -> None:
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    need_tool("qemu-system-arm", "qemu-system-arm")


@dataclass(frozen=True)
class Done:
    """What a command ended with, and all it printed."""

    exit_code: int
    output: str


@pytest.fixture
def check(capsys: pytest.CaptureFixture[str]) -> Callable[..., Done]:
    """Run `tmm-gen check`."""

    def call(*words: str | Path) -> Done:
        code = main(["check", *map(str, words)])
        said = capsys.readouterr()
        return Done(code, said.out + said.err)

    return call


def _thesis10(folder: Path, *changes: tuple[str, str]) -> Path:
    text = (SCENES / "thesis10.toml").read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    scene = folder / "thesis10.toml"
    scene.write_text(text)
    return scene


def test_targets_are_the_boards() -> None:
    assert tuple(BOARDS) == TARGETS


def test_json_has_the_promised_keys(check: Callable[..., Done], arm: None) -> None:
    done = check(SCENES / "thesis10.toml", "--target", "cortex-m4f", "--real", "float32", "--json")
    assert done.exit_code == 0, done.output
    found = json.loads(done.output)
    assert found["bits_equal"] is True
    assert found["passed"] is True
    for key in ("instructions_per_step", "code_bytes", "ram_bytes", "stack_bytes"):
        assert isinstance(found[key], int)
        assert found[key] > 0
    assert {row["figure"] for row in found["rows"]} == {
        "instructions_per_step",
        "code_bytes",
        "ram_bytes",
        "stack_bytes",
    }


def test_a_budget_that_is_exceeded_fails_and_says_by_how_much(
    check: Callable[..., Done], arm: None, tmp_path: Path
) -> None:
    scene = _thesis10(tmp_path, ("instructions = 700", "instructions = 100"))
    done = check(scene, "--target", "cortex-m4f", "--real", "float32")
    assert done.exit_code == 1
    assert "over budget: instructions_per_step is " in done.output
    assert "more than 100" in done.output
    assert "code_bytes is" not in done.output


def test_numbers_a_processor_has_no_unit_for_are_pointed_out(
    check: Callable[..., Done], arm: None, tmp_path: Path
) -> None:
    scene = _thesis10(
        tmp_path, ("instructions = 700", "instructions = 70000"), ("flash = 1300", "flash = 9000")
    )
    done = check(scene, "--target", "cortex-m4f")
    assert done.exit_code == 0, done.output
    assert "Cortex-M4F computes float64 in software" in done.output
    assert "all 256 steps give the bits" in done.output


def test_sines_of_the_c_library_are_pointed_out(
    check: Callable[..., Done], arm: None, tmp_path: Path
) -> None:
    scene = tmp_path / "arm10.toml"
    text = (SCENES / "arm10.toml").read_text().replace('trigonometry = "own"', 'trigonometry = "libm"')
    scene.write_text(text.partition("[emit.budget]")[0])
    done = check(scene, "--target", "cortex-m7")
    assert done.exit_code == 0, done.output
    assert "cos, sin differ between C libraries" in done.output
    assert 'trigonometry = "own"' in done.output


def test_a_missing_tool_is_named_with_its_package(
    check: Callable[..., Done], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    for words, package in (
        (("--target", "cortex-m4f"), "gcc-arm-none-eabi"),
        (("--target", "rv32imafdc"), "gcc-riscv64-unknown-elf"),
        (("--prove",), "frama-c-base"),
        (("--lint",), "gcc"),
    ):
        done = check(SCENES / "thesis10.toml", *words)
        assert done.exit_code == 2
        assert f"apt-get install {package}" in done.output


def test_a_proof_says_what_holds(check: Callable[..., Done], need_tool: Need) -> None:
    need_tool("frama-c", "frama-c-base")
    done = check(SCENES / "thesis10.toml", "--prove", "--json")
    assert done.exit_code == 0, done.output
    found = json.loads(done.output)
    assert (found["passed"], found["alarms"], found["rows"]) == (True, 0, [])
    assert found["box"]["tip_torque"] == [-100.0, 100.0]


def test_what_cannot_be_proved_fails(check: Callable[..., Done], need_tool: Need, tmp_path: Path) -> None:
    need_tool("frama-c", "frama-c-base")
    scene = _thesis10(tmp_path, ("angles = [-10.0, 10.0]", "angles = [-1e308, 1e308]"))
    done = check(scene, "--prove")
    assert done.exit_code == 1
    assert "is_finite" in done.output
    assert "NOT proved" in done.output


def test_one_check_at_a_time(check: Callable[..., Done]) -> None:
    done = check(SCENES / "thesis10.toml", "--prove", "--target", "cortex-m7")
    assert done.exit_code == 2
    assert "name one" in done.output
