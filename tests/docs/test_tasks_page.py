"""The page of tasks is run: every command and all its Python in one folder; its C compiles; its links lead on."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.cli import main

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "docs" / "tasks.md").read_text()
TOOLS = {"--target": (("arm-none-eabi-gcc", "gcc-arm-none-eabi"), ("qemu-system-arm", "qemu-system-arm"))}
ELSEWHERE = re.findall(r"^\$ (.*)$", (ROOT / "docs" / "trade.md").read_text(), re.MULTILINE)
"""Long commands that the test of another page runs, word for word."""

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SECTIONS = {part.split("\n", 1)[0]: part for part in TEXT.split("\n## ")[1:]}

pytestmark = pytest.mark.xdist_group("tasks")  # what one builds, the next uses


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("tasks")
    for name in ("scenes", "examples"):
        (made / name).symlink_to(ROOT / name)
    shutil.copytree(ROOT / "generated" / "arm10", made / "generated" / "arm10")
    return made


@pytest.mark.parametrize("title", [title for title, text in SECTIONS.items() if BLOCK.search(text)])
def test_it_works(
    title: str,
    folder: Path,
    need_tool: Callable[[str, str], str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(folder)
    for language, body in BLOCK.findall(SECTIONS[title]):
        if language == "console":
            command, _, shown = body.partition("\n") if "\nerror" in body else (body.strip(), "", "")
            for line in (line.removeprefix("$ ") for line in command.splitlines()):
                program, *words = shlex.split(line)
                assert program == "tmm-gen"
                for tool in (tool for word in words for tool in TOOLS.get(word, ())):
                    need_tool(*tool)
                if line not in ELSEWHERE:
                    assert main(words) == bool(shown), line
                    assert shown in capsys.readouterr().err
        elif language == "python":
            for place in (folder, folder / "out" / "batch"):
                monkeypatch.syspath_prepend(str(place))
            for name in [name for name in sys.modules if name.partition(".")[0] in ("generated", "scatter")]:
                monkeypatch.delitem(sys.modules, name)  # another test's
            exec(body, {})


def test_the_integrator_is_that_of_its_own_page() -> None:
    """Where it is added, and its order and limits are derived (tests/derive/integrators/test_document.py)."""
    made = []
    for text in (SECTIONS["Add an integrator"], (ROOT / "docs" / "integrators.md").read_text()):
        names: dict[str, Any] = {}
        exec(next(body for _, body in BLOCK.findall(text) if "def dirk2" in body), names)
        made.append(names["dirk2"]())
    assert (made[0].main, made[0].tableau) == (made[1].main, made[1].tableau)


ALSO_READ = {"tutorial": "## 2.", "c-project": "## Without CMake", "urdf": "You can edit the resulting"}
"""Where reading another page of the table of times ends."""


def test_times_add_up() -> None:
    """Words are those of the pages, read at 200 a minute; all is done within two minutes, as the page says."""
    table = SECTIONS["How long each took"]
    rows = re.findall(r"^\| ([^|]+) \| (\d+)([^|]*) \| (\d+) \| (\d+) \|", table, re.MULTILINE)
    assert len(rows) == 12
    for task, words, also, seconds, together in rows:
        (section,) = [text for title, text in SECTIONS.items() if task.lower() in title.lower()]
        read = len(section.split())
        for page in re.findall(r"\]\(([\w-]+)\.md\)", also):
            read += len((ROOT / "docs" / f"{page}.md").read_text().split(ALSO_READ[page])[0].split())
        assert (task, int(words)) == (task, read)
        assert abs(read * 60 / 200 + int(seconds) - int(together)) <= 1
        assert int(together) <= 120


def test_no_task_takes_more_than_ten_lines() -> None:
    """Of code at a time, so that nobody has to look for what matters."""
    assert len(SECTIONS) == 15
    for title, text in SECTIONS.items():
        for _, body in BLOCK.findall(text):
            assert body.count("\n") <= 10, title


def test_the_c_compiles_and_cmake_has_the_target(tmp_path: Path) -> None:
    blocks = dict(BLOCK.findall(TEXT))
    source = (
        '#include "arm10.h"\nvoid change(void);\nvoid change(void)\n{\n'
        f"static arm10_params params;\nstatic arm10_model model;\n{blocks['c']}}}\n"
    )
    (tmp_path / "change.c").write_text(source)
    folder = ROOT / "generated" / "arm10" / "c"
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I", str(folder)]
    subprocess.run(["gcc", *flags, "change.c"], cwd=tmp_path, check=True)
    (target,) = re.findall(r"PRIVATE (\w+)\)", blocks["cmake"])
    assert f"add_library({target} " in (folder / "CMakeLists.txt").read_text()


def test_preparing_again_costs_less_than_a_fifth_of_a_step() -> None:
    header = (ROOT / "generated" / "arm10" / "c" / "arm10.h").read_text()
    step, prepare = (
        int(re.search(rf"operations of {what}: (\d+)", header)[1])  # type: ignore[index]
        for what in ("a step", "prepare")
    )
    assert prepare < step / 5
