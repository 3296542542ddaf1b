"""The page of tasks: every command is one that the command line takes, the C compiles, the target of CMake exists."""

from __future__ import annotations

import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tmm_gen.cli import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "tasks.md").read_text()


def blocks(language: str) -> Iterator[str]:
    return iter(re.findall(rf"^```{language}\n(.*?)^```$", TEXT, re.M | re.S))


LINES = [line[2:] for block in blocks("console") for line in block.splitlines()]


@pytest.mark.parametrize("line", LINES)
def test_the_command_line_takes_it(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    program, name, *words = shlex.split(line)
    assert program == "tmm-gen"
    context = COMMANDS[name].load().make_context(name, words)  # which checks words, and runs nothing
    for value in context.params.values():
        if isinstance(value, Path) and str(value).startswith(("scenes/", "examples/")):
            assert value.exists()


def test_the_c_compiles_and_cmake_has_the_target(tmp_path: Path) -> None:
    (body,) = blocks("c")
    source = (
        '#include "arm10.h"\nvoid change(void);\nvoid change(void)\n{\n'
        f"static arm10_params params;\nstatic arm10_model model;\n{body}}}\n"
    )
    (tmp_path / "change.c").write_text(source)
    folder = ROOT / "generated" / "arm10" / "c"
    command = [
        "gcc",
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-fsyntax-only",
        "-I",
        str(folder),
        "change.c",
    ]
    subprocess.run(command, cwd=tmp_path, check=True)
    (cmake,) = blocks("cmake")
    (target,) = re.findall(r"PRIVATE (\w+)\)", cmake)
    assert f"add_library({target} " in (folder / "CMakeLists.txt").read_text()


def test_preparing_again_costs_less_than_a_fifth_of_a_step() -> None:
    header = (ROOT / "generated" / "arm10" / "c" / "arm10.h").read_text()
    step, prepare = (
        int(re.search(rf"operations of {what}: (\d+)", header)[1])  # type: ignore[index]
        for what in ("a step", "prepare")
    )
    assert prepare < step / 5
