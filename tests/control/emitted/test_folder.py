"""Folders of emitted controllers as a stranger finds them: they compile as they lie, alone and together."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.onboard.emit import EMITTED, emit_controller
from tmm_gen.onboard.text import macro_prefix

pytestmark = pytest.mark.compiler

REALS = ("float64", "float32")
ALL = "gcc example/example.c *.c daqp/*.c -lm -o all"
"""What a stranger types."""


def write(folder: Path, files: dict[str, str]) -> None:
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)


def shell(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, shell=True, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("real", REALS)
@pytest.mark.parametrize("kind", EMITTED)
def test_a_stranger_compiles_all_there_is_and_the_arm_arrives(
    kind: str, real: str, bench: Bench, tmp_path: Path
) -> None:
    write(tmp_path, emit_controller(bench, kind, real)[1])
    done = shell(ALL, tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    run = shell("./all", tmp_path)
    assert run.returncode == 0, run.stdout[-500:]
    first, *rows = run.stdout.splitlines()
    assert first == "time_s,tip_rad,torque_Nm,status"
    assert float(rows[-1].split(",")[1]) == pytest.approx(bench.problem.reference, abs=0.01)


def test_all_controllers_in_both_precisions_are_in_one_program(bench: Bench, tmp_path: Path) -> None:
    """One source includes all their headers, so that neither macros nor types nor symbols may meet."""
    includes, calls = [], []
    for kind in EMITTED:
        for real in REALS:
            name = f"{kind.replace('-', '_')}_{real}"
            _, files = emit_controller(bench, kind, real, name)
            write(
                tmp_path / name, {path: text for path, text in files.items() if "/example" not in f"/{path}"}
            )
            includes.append(f'#include "{name}/{name}.h"')
            macro = macro_prefix(name)
            calls.append(
                f"{{ static {name}_controller c; {name}_real y[{macro}_SENSORS] = {{0}}, u = 9; {name}_reset(&c); "
                f'printf("%d ", (int){name}_command(&c, y, &u)); printf("%.3f\\n", (double)u); }}'
            )
    text = "\n".join(["#include <stdio.h>", *includes, "int main(void) {", *calls, "return 0; }", ""])
    (tmp_path / "main.c").write_text(text)
    done = shell("gcc -Wall *.c */*.c */daqp/*.c -lm -o all", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    lines = shell("./all", tmp_path).stdout.splitlines()
    assert lines == ["0 3.000"] * len(EMITTED) * len(REALS)


@pytest.mark.parametrize("kind", EMITTED)
def test_every_symbol_has_the_controllers_name(kind: str, bench: Bench, tmp_path: Path) -> None:
    name, files = emit_controller(bench, kind, "float32")
    write(tmp_path, files)
    done = shell("gcc -c *.c daqp/*.c && nm -g --defined-only *.o", tmp_path)
    assert done.returncode == 0, done.stderr
    symbols = [words[-1] for line in done.stdout.splitlines() if len(words := line.split()) == 3]
    assert len(symbols) > 20
    assert not [symbol for symbol in symbols if not symbol.startswith(f"{name}_")]


def test_settings_of_others_change_nothing(bench: Bench, tmp_path: Path) -> None:
    """The solver's macros, set by somebody else for another copy of it."""
    write(tmp_path, emit_controller(bench, "mpc-modes")[1])
    plain, other = (
        shell(f"gcc {flags} *.c */*.c -lm -o all && ./all", tmp_path)
        for flags in ("", "-DDAQP_SINGLE_PRECISION -DDAQP_NO_SOFT_WEIGHTS -DPROFILING")
    )
    assert plain.returncode == other.returncode == 0, other.stderr
    assert plain.stdout == other.stdout


@pytest.mark.parametrize("flag", ["-ffast-math", "-Ofast", "-ffinite-math-only"])
@pytest.mark.parametrize("kind", ["mpc-modes", "rti"])
def test_without_its_guards_it_does_not_compile(kind: str, flag: str, bench: Bench, tmp_path: Path) -> None:
    name, files = emit_controller(bench, kind)
    write(tmp_path, files)
    for source in (f"{name}.c", "daqp/daqp.c"):
        done = shell(f"gcc {flag} -fsyntax-only {source}", tmp_path)
        assert done.returncode != 0
        assert "-fno-finite-math-only" in done.stderr
        guarded = f"gcc {flag} -fno-finite-math-only -fno-fast-math -fsyntax-only {source}"
        assert shell(guarded, tmp_path).returncode == 0


@pytest.mark.parametrize("kind", EMITTED)
def test_null_pointers_give_a_status(kind: str, bench: Bench, tmp_path: Path) -> None:
    name, files = emit_controller(bench, kind)
    write(tmp_path, {path: text for path, text in files.items() if not path.startswith("example")})
    macro = macro_prefix(name)
    (tmp_path / "main.c").write_text(f"""
#include <math.h>
#include "{name}.h"
static {name}_controller c;
int main(void)
{{
    {name}_real y[{macro}_SENSORS] = {{0}}, u = 9;
    const int all[{macro}_SENSORS] = {{1, 1}};
    int good = {name}_reset(0) == {macro}_MISSING && {name}_reset(&c) == {macro}_OK;
    good = good && {name}_prepare(0) == {macro}_MISSING && {name}_prepare(&c) == {macro}_OK;
    good = good && {name}_command_valid(0, y, 0, &u) == {macro}_MISSING && u == 0;
    good = good && {name}_command_valid(&c, y, all, 0) == {macro}_MISSING;
    good = good && {name}_command_valid(0, 0, 0, 0) == {macro}_MISSING;
    good = good && {name}_command_valid(&c, y, 0, &u) == {macro}_OK && u > 1;
    good = good && {name}_command_valid(&c, 0, all, &u) == {macro}_MISSING && u == 0;
    good = good && {name}_reset(&c) == {macro}_OK;
    good = good && {name}_limit(0, -1, 1) == {macro}_MISSING && {name}_limit(&c, -1, 1) == {macro}_OK;
    good = good && {name}_limit(&c, -1, NAN) == {macro}_NOT_FINITE && {name}_limit(&c, 1, -1) == {macro}_INFEASIBLE;
    good = good && {name}_command(&c, y, &u) == {macro}_OK && u > 0.999 && u <= 1;
    good = good && {name}_reset(&c) == {macro}_OK;
    return good && {name}_command_valid(&c, y, all, &u) == {macro}_OK ? 0 : 1;
}}
""")
    done = shell("gcc -Wall -Wno-nonnull *.c */*.c -lm -fsanitize=undefined -o all && ./all", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("name", ["linux", "NAN", "k", "Arm"])
@pytest.mark.parametrize("kind", ["mpc-modes", "rti-zero"])
def test_names_of_scenes_meet_no_macro(kind: str, name: str, small: Bench, tmp_path: Path) -> None:
    """In the dialect with most macros, behind the headers with most of them, and in C++."""
    other = Bench.of(small.scene.replace(name=name))
    prefix, files = emit_controller(other, kind)
    write(tmp_path, files)
    (tmp_path / "all.h").write_text(
        "#include <stdio.h>\n#include <math.h>\n#include <float.h>\n#include <limits.h>\n#include <stdlib.h>\n"
    )
    done = shell(f"gcc -std=gnu17 -Wall -include all.h -fsyntax-only {prefix}.c example/example.c", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    (tmp_path / "a.cpp").write_text(f'#include <cmath>\n#include <cstdio>\n#include "{prefix}.h"\n')
    done = shell("g++ -fsyntax-only a.cpp", tmp_path) if shutil.which("g++") else done
    assert done.returncode == 0, done.stderr


def test_names_that_differ_in_capitals_only_are_two(small: Bench) -> None:
    prefixes = {macro_prefix(name) for name in ("arm_rti", "Arm_rti", "ARM_rti", "aRM_rti")}
    assert len(prefixes) == 4
    assert "ARM_RTI" in prefixes


def test_cmake_builds_it(bench: Bench, tmp_path: Path, need_tool: Callable[[str, str], str]) -> None:
    need_tool("cmake", "cmake")
    write(tmp_path, emit_controller(bench, "rti-zero", real_time=True)[1])
    done = shell("cmake -B build && cmake --build build && ctest --test-dir build", tmp_path)
    assert done.returncode == 0, done.stdout[-800:] + done.stderr[-800:]
    assert re.search(r"^100% tests passed.* out of 2$", done.stdout, re.MULTILINE), done.stdout[-800:]
