"""How-to pages are followed: C in a project, firmware, Simulink; what stands there compiles and runs."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.cli import COMMANDS, main

ROOT = Path(__file__).resolve().parents[2]
KERNEL = ROOT / "generated" / "swing" / "c"
FLAGS = ["-std=c99", "-Wall", "-Wextra", "-Werror"]
STEPS, TORQUE = 200, 0.5


def blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", (ROOT / "docs" / page).read_text(), re.M | re.S)


def commands(page: str) -> list[list[str]]:
    lines = "".join(blocks(page, "console")).splitlines()
    return [shlex.split(line.removeprefix("$ ")) for line in lines]


@pytest.fixture(scope="module")
def moved() -> Callable[[float], list[float]]:
    """Where Python has the tip of `swing` after a second, by the torque that acts as it starts."""
    sys.path.insert(0, str(ROOT))
    try:
        from generated.swing import Input, initialise, output, prepare, step
    finally:
        sys.path.remove(str(ROOT))

    def tip(first: float) -> list[float]:
        model, state = prepare(), initialise(input=Input(hub_torque=first))
        for _ in range(STEPS):
            state = step(model, state, Input(hub_torque=TORQUE))
        found = output(model, state)
        return [float(found.tip_x), float(found.tip_y)]

    return tip


def printed(program: str) -> list[float]:
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    return [float(number) for number in done.stdout.split()]


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty project beside what `tmm-gen build` writes for `swing`, which is committed."""
    shutil.copytree(KERNEL, tmp_path / "generated" / "swing" / "c")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_c_in_a_project(
    project: Path, need_tool: Callable[[str], str], moved: Callable[[float], list[float]]
) -> None:
    expected = moved(TORQUE)
    (source,), (cmake,) = blocks("c-project.md", "c"), blocks("c-project.md", "cmake")
    (project / "main.c").write_text(source)
    (project / "CMakeLists.txt").write_text(cmake)
    build, configure, make, run, by_hand = commands("c-project.md")
    assert build == ["tmm-gen", "build", "scenes/swing.toml", "--out", "generated"]
    subprocess.run([*by_hand, *FLAGS[1:]], check=True)
    assert printed("./my_program") == pytest.approx(expected, abs=1e-9)
    need_tool("cmake")
    for command in (configure, make):
        subprocess.run(command, check=True, capture_output=True)
    assert printed(*run) == pytest.approx(expected, abs=1e-9)


def test_firmware(tmp_path: Path, need_tool: Callable[[str, str], str]) -> None:
    need_tool("arm-none-eabi-gcc", "gcc-arm-none-eabi picolibc-arm-none-eabi")
    (source,) = blocks("stm32-zephyr.md", "c")
    (tmp_path / "arm.c").write_text(source)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    compiling, check = commands("stm32-zephyr.md")
    subprocess.run([*compiling, *FLAGS[1:], "--specs=picolibc.specs"], cwd=tmp_path, check=True)
    assert {path.name for path in tmp_path.glob("*.o")} == {"arm.o", "beam5.o"}
    assert check[:3] == ["tmm-gen", "check", "examples/firmware/beam5.toml"]
    emit = (ROOT / check[2]).read_text()
    for line in blocks("stm32-zephyr.md", "toml")[0].splitlines()[1:]:
        assert re.search("^" + re.escape(line.partition("#")[0].strip()) + "$", emit, re.MULTILINE), line


def test_block_of_simulink(project: Path, moved: Callable[[float], list[float]]) -> None:
    header, source = blocks("simulink.md", "c")
    (project / "swing_block.h").write_text(header)
    (project / "swing_block.c").write_text(source)
    (project / "main.c").write_text(
        '#include <stdio.h>\n#include "swing_block.h"\nint main(void)\n{\n'
        f"double x, y;\nswing_block_start();\nfor (int k = 0; k < {STEPS}; ++k)\nswing_block({TORQUE}, &x, &y);\n"
        'printf("%.12f %.12f\\n", x, y);\nreturn 0;\n}\n'
    )
    sources = ["main.c", "swing_block.c", "generated/swing/c/swing.c"]
    subprocess.run(["gcc", *FLAGS, "-O1", "-Igenerated/swing/c", *sources, "-lm", "-o", "block"], check=True)
    assert printed("./block") == pytest.approx(
        moved(0.0), abs=1e-11
    )  # the torque is there from the first step on


def test_modes_and_schema(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands of pages that have no test of their own."""
    (tmp_path / "scenes").mkdir()
    for path in (ROOT / "scenes").glob("*.toml"):
        (tmp_path / "scenes" / path.name).symlink_to(path)
    monkeypatch.chdir(tmp_path)
    lines = "".join(blocks("modes.md", "sh") + blocks("editor.md", "console")).splitlines()
    lines = [line.removeprefix("$ ") for line in lines if "tmm-gen" in line]
    assert len(lines) >= 3
    for line in lines:
        words = shlex.split(line, comments=True)[1:]
        if {"--plot", "--links-for"} & set(words):  # run, of smaller arms, by tests of these options
            COMMANDS[words[0]].load().make_context(words[0], words[1:])
        else:
            assert main(words) == 0, line
    assert (tmp_path / "scenes" / "tmm-gen.schema.json").is_file()
