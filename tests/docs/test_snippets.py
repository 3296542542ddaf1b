"""Every block of code on every page is run by a test that is named here: a new one fails until it is run too."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.cli import COMMANDS, main
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[2]
PAGES = {path.stem: path for path in (ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md")))}
FENCE = re.compile(r"^ *```(\w*)[^\n]*\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
HERE = "tests/docs/test_snippets.py"

OUTPUT = ("", "text")
"""Languages of what commands print, formulas and pictures in letters: no code."""

RUN = {
    "tests/docs/test_readme.py": {"README": {"console": 3}},
    "tests/docs/test_readme_code.py": {"README": {"python": 2, "c": 1}},
    "tests/docs/test_arms_page.py": {"arms": {"console": 5, "toml": 3}},
    "tests/docs/test_batch_page.py": {"batch": {"console": 1, "python": 3}},
    "tests/docs/test_howto_pages.py": {
        "c-project": {"console": 3, "cmake": 1, "c": 1},
        "editor": {"console": 1},
        "modes": {"sh": 3},
        "simulink": {"console": 1, "c": 2},
        "stm32-zephyr": {"toml": 1, "console": 2, "c": 1},
    },
    "tests/docs/test_control_arm_page.py": {"control-arm": {"console": 5, "toml": 2, "c": 1}},
    "tests/docs/test_embedded_page.py": {"embedded": {"console": 1}},
    "tests/docs/test_stability_page.py": {"explain": {"console": 2}, "stability": {"console": 2}},
    "tests/docs/test_export_page.py": {"export": {"console": 3, "python": 2}},
    "tests/docs/test_float32_page.py": {"float32": {"console": 1}},
    "tests/docs/test_mpc_page.py": {"mpc": {"console": 7, "python": 2}},
    "tests/docs/test_python_page.py": {"python": {"python": 13}},
    "tests/docs/test_space_page.py": {"space": {"console": 2}},
    "tests/docs/test_tasks_page.py": {"tasks": {"console": 14, "python": 5, "cmake": 1, "c": 1}},
    "tests/docs/test_trade_page.py": {"trade": {"console": 2}},
    "tests/docs/test_tutorial_page.py": {"tutorial": {"console": 5, "python": 1, "c": 1}},
    "tests/docs/test_urdf_page.py": {"urdf": {"console": 4, "python": 2, "toml": 3}},
    "tests/derive/integrators/test_document.py": {"integrators": {"python": 6}},
    "tests/examples/test_jax.py": {
        "jax": {"console": 2, "python": 1},
        "learning": {"console": 1, "python": 1},
    },
    "tests/spatial/test_step_in_vectors.py": {"space": {"toml": 1}},
    "tests/scene/test_reference.py": {"scene": {"toml": 1}},
    HERE: {
        "batch": {"toml": 1},
        "editor": {"toml": 1, "sh": 3},
        "embedded": {"toml": 4, "c": 2},
        "float32": {"toml": 1},
        "index": {"console": 1},
        "integrators": {"toml": 1},
        "jax": {"toml": 1},
        "mpc": {"toml": 4, "c": 2},
        "mpc-speed": {"toml": 1},
        "planar": {"toml": 1},
        "playground": {"console": 1},
        "stm32-zephyr": {"cmake": 1, "ini": 1},
        "tasks": {"toml": 1},
    },
}
"""By the test that runs them: how many blocks of which language a page has."""

PARTS_OF_SCENES = {
    "batch": "arm10",
    "embedded": "arm10",
    "float32": "swing",
    "integrators": "arm10",
    "jax": "thesis2",
    "mpc": "elbow",
    "mpc-speed": "swing",
    "planar": "swing",
    "tasks": "elbow",
}
"""A scene to which what a page shows of one is put."""


def blocks(page: str, language: str) -> list[str]:
    return [body for found, body in FENCE.findall(PAGES[page].read_text()) if found == language]


@pytest.mark.parametrize("page", PAGES)
def test_every_block_is_run_by_a_test(page: str) -> None:
    """A block more or less than the table has: have the test that it names run it, then change the number."""
    found = Counter(
        language for language, _ in FENCE.findall(PAGES[page].read_text()) if language not in OUTPUT
    )
    told: Counter[str] = Counter()
    for test, pages in RUN.items():
        told.update(pages.get(page, {}))
        if page in pages and test != HERE:
            assert f"{page}.md" in (ROOT / test).read_text(), f"{test} does not read {page}.md"
    assert found == told


@pytest.mark.parametrize(
    ("page", "text"), [(page, text) for page in PARTS_OF_SCENES for text in blocks(page, "toml")]
)
def test_parts_of_scenes_are_taken_by_one(page: str, text: str) -> None:
    """What they set is what the scene then has."""
    keys = _leaves(tomllib.loads(text), re.findall(r"^\[+([\w.]+)\]", text, re.MULTILINE))
    scene = load_scene(ROOT / "scenes" / f"{PARTS_OF_SCENES[page]}.toml").replace(**keys)
    for key, value in keys.items():
        held: Any = scene.source.data
        for word in key.split("."):
            held = held[word]
        assert held == value


def _leaves(table: dict[str, Any], tables: list[str], before: str = "") -> dict[str, Any]:
    """Return what a text sets, by key; what has a header of its own is looked into."""
    found: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{before}{name}"
        inside = isinstance(value, dict) and any(f"{header}.".startswith(f"{key}.") for header in tables)
        found |= _leaves(value, tables, f"{key}.") if inside else {key: value}
    return found


def test_c_of_the_page_on_microcontrollers(tmp_path: Path) -> None:
    """What a program calls compiles, and the struct shown is that of the header."""
    program, struct = blocks("embedded", "c")
    folder = ROOT / "generated" / "arm10" / "c"
    (tmp_path / "arm.c").write_text(f"int start(void);\nint tick(double torque, double *tip);\n{program}")
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I", str(folder)]
    subprocess.run(["gcc", *flags, "arm.c"], cwd=tmp_path, check=True)
    header = (folder / "arm10.h").read_text()
    shown = struct.splitlines()
    assert "\n".join(shown[1:-1]) in header


def test_the_loop_that_follows_a_trajectory(tmp_path: Path) -> None:
    """Against a header with what it calls; an emitted controller has functions of these names."""
    (loop,) = (block for block in blocks("mpc", "c") if "follow" in block)
    called = set(re.findall(r"\barm_(\w+)\(", loop))
    templates = (ROOT / "templates" / "control" / "macros.jinja").read_text()
    assert called == {"reset", "follow", "prepare", "command"}
    for name in called:
        assert f"_{name}(" in templates
    (tmp_path / "arm.h").write_text(
        "typedef struct { int sample; } arm_controller;\nenum { ARM_HORIZON = 30, MOTORS = 2 };\n"
        "void arm_reset(arm_controller *);\nint arm_prepare(arm_controller *);\n"
        "int arm_follow(arm_controller *, double (*)[MOTORS]);\n"
        "int arm_command(arm_controller *, const double *, double *);\n"
        "void course(long, double *);\nvoid read_sensors(double *);\nvoid set_torques(const double *);\n"
    )
    arrays = "arm_controller controller;\ndouble measured[MOTORS + 2], torque[MOTORS];\n"
    arrays += "double reference[ARM_HORIZON][MOTORS];\n"
    (tmp_path / "main.c").write_text(f'#include "arm.h"\nint main(void)\n{{\n{arrays}{loop}}}\n')
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]
    subprocess.run(["gcc", *flags, "main.c"], cwd=tmp_path, check=True)


def test_zephyr(tmp_path: Path, need_tool: Callable[[str, str], str]) -> None:
    """The lines for CMakeLists.txt build an application; Zephyr makes the target `app` before them."""
    need_tool("cmake", "cmake")
    (lines,), (configuration,) = blocks("stm32-zephyr", "cmake"), blocks("stm32-zephyr", "ini")
    (source,) = blocks("stm32-zephyr", "c")
    for line in configuration.splitlines():
        assert re.fullmatch(r"CONFIG_[A-Z_]+=y", line)
    (tmp_path / "generated").symlink_to(ROOT / "examples" / "firmware" / "generated")
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "arm.c").write_text(source)
    (tmp_path / "src" / "main.c").write_text(
        "int arm_start(void);\nint arm_tick(float torque, float *tip);\nint main(void)\n{\n"
        "float tip = 1.0f;\nif (arm_start() || arm_tick(0.0f, &tip)) {\nreturn 1;\n}\n"
        "return tip >= 0.0f || tip < -1e-3f; /* it falls */\n}\n"
    )
    around = "cmake_minimum_required(VERSION 3.16)\nproject(firmware C)\nadd_executable(app)\n"
    (tmp_path / "CMakeLists.txt").write_text(f"{around}{lines}target_link_libraries(app PRIVATE m)\n")
    for command in (["cmake", "-S", ".", "-B", "build"], ["cmake", "--build", "build"], ["build/app"]):
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)


@pytest.mark.parametrize("line", blocks("editor", "sh"))
def test_completion(line: str) -> None:
    """Each shell is given a function that asks for words."""
    variable, shell = re.findall(r"(\w+)=(\w+)_source tmm-gen", line)[0]
    environment = {**os.environ, variable: f"{shell}_source"}
    command = [
        sys.executable,
        "-c",
        "import sys; sys.argv[0] = 'tmm-gen'; from tmm_gen.cli import main; sys.exit(main())",
    ]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert f"{variable}={shell}_complete" in done.stdout


def test_what_new_writes_for_editors(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "tmm-gen.schema.json").write_text("{}")
    assert main(["new", "crane", "--kind", "planar"]) == 0
    (directive,) = blocks("editor", "toml")
    assert directive in (tmp_path / "scenes" / "crane.toml").read_text()


def test_commands_that_other_tests_run() -> None:
    """The start page has two of the README's; the playground's is run by its own tests, on smaller arms."""
    (start,), (playground,) = blocks("index", "console"), blocks("playground", "console")
    readme = "".join(blocks("README", "console"))
    assert all(line in readme for line in start.splitlines())
    (words,) = (line.split()[2:] for line in playground.splitlines())
    COMMANDS[words[0]].load().make_context(words[0], words[1:])
