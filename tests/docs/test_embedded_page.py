"""The page on microcontrollers: its commands work, and what it says of scenes and rules is what they say."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.c_language.real import DOUBLE, FLOAT
from tmm_gen.cli import main
from tmm_gen.emit.c.circle import ERROR, constants
from tmm_gen.target.lint import SUPPRESSIONS

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "embedded.md").read_text()
TOOLS = {
    "--target": (("arm-none-eabi-gcc", "gcc-arm-none-eabi"), ("qemu-system-arm", "qemu-system-arm")),
    "--prove": (("frama-c", "frama-c-base"),),
    "--lint": (("clang", "clang"), ("cppcheck", "cppcheck")),
}


def _commands() -> list[str]:
    blocks = re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    return [line[2:] for block in blocks for line in block.splitlines() if line.startswith("$ ")]


def test_there_are_commands() -> None:
    assert len(_commands()) >= 4


@pytest.mark.parametrize("command", _commands())
def test_every_command_works(
    command: str, need_tool: Callable[[str, str], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    program, *words = command.split()
    assert program == "tmm-gen"
    for option in words:
        for tool in TOOLS.get(option, ()):
            need_tool(*tool)
    monkeypatch.chdir(ROOT)
    assert main(words) == 0


def test_the_box_shown_is_that_of_the_arm() -> None:
    (shown,) = re.findall(r"```toml\n(\[emit.box\].*?)```", PAGE, re.DOTALL)
    scene = tomllib.loads((ROOT / "scenes" / "arm10.toml").read_text())
    assert tomllib.loads(shown)["emit"]["box"] == scene["emit"]["box"]


def test_the_budget_shown_is_that_of_the_chain() -> None:
    (shown,) = re.findall(r"```toml\n(\[emit.budget\].*?)```", PAGE, re.DOTALL)
    scene = tomllib.loads((ROOT / "scenes" / "thesis10.toml").read_text())
    assert tomllib.loads(shown)["emit"]["budget"] == scene["emit"]["budget"]


def test_errors_and_ranges_of_own_sines_are_those_of_the_code() -> None:
    for real, words in ((FLOAT, "single"), (DOUBLE, "double")):
        (row,) = re.findall(rf"^\| {words} precision \|(.*)\|$", PAGE, re.MULTILINE)
        t = constants(real)
        assert f"{ERROR * 2.0**-t.digits:.1e}".replace("e-0", "e-") in row
        assert f"{t.largest_angle:,.0f} rad".replace(",", " ") in row or f"{t.largest_angle:.0f} rad" in row


def test_rules_that_are_not_kept_are_listed() -> None:
    suppressed = re.findall(r"^misra-c2012-([\d.]+)$", SUPPRESSIONS.read_text(), re.MULTILINE)
    listed = re.findall(r"^\| (\d+\.\d+) ", PAGE, re.MULTILINE)
    assert sorted(suppressed) == sorted(listed)


def test_every_suppressed_rule_has_a_reason() -> None:
    paragraphs = SUPPRESSIONS.read_text().strip().split("\n\n")[1:]
    for paragraph in paragraphs:
        *reason, rule = paragraph.splitlines()
        assert rule.startswith("misra-c2012-")
        assert reason
        assert all(line.startswith("# ") for line in reason)
        assert f"# {rule.removeprefix('misra-c2012-')} " in reason[0]
