"""Compiling, and finding what is compiled already."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.errors import UserError
from tmm_gen.native import compile_library, compiler

pytestmark = pytest.mark.compiler
FILES = {
    "c/answer.c": '#include "answer.h"\nint answer(void) { return 42; }\n',
    "c/answer.h": "int answer(void);\n",
}


@pytest.fixture(autouse=True)
def empty_cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    monkeypatch.setattr(compiler, "_cache_folder", lambda: tmp_path)
    return tmp_path


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """Commands that were run."""
    commands: list[list[str]] = []
    run = subprocess.run

    def recorded(words: list[str], **options: Any) -> Any:
        commands.append(words)
        return run(words, **options)

    monkeypatch.setattr(compiler.subprocess, "run", recorded)
    return commands


def test_compiled_once(runs: list[list[str]]) -> None:
    first = compile_library(FILES)
    compilations = [words for words in runs if "-shared" in words]
    assert compile_library(dict(reversed(FILES.items()))) == first
    assert [words for words in runs if "-shared" in words] == compilations
    assert first.is_file()
    assert [path.name for path in first.parent.iterdir()] == [first.name]  # no scratch is left


def test_every_change_is_another_library() -> None:
    other = {**FILES, "c/answer.h": "int answer(void); /* 42 */\n"}
    found = {
        compile_library(FILES),
        compile_library(other),
        compile_library(FILES, flags=("-O0",)),
    }
    assert len(found) == 3


def test_another_compiler_is_another_library(need_tool: Callable[..., str]) -> None:
    need_tool("clang")
    assert compile_library(FILES) != compile_library(FILES, "clang")


def test_a_missing_compiler_is_named() -> None:
    with pytest.raises(UserError, match="'no-such-cc' was not found; install one") as found:
        compile_library(FILES, "no-such-cc")
    assert found.value.exit_code == 2


def test_something_else_than_a_compiler() -> None:
    with pytest.raises(UserError, match=r"'false --version' failed: is it a C compiler\?"):
        compile_library(FILES, "false")


def test_what_compiles_nothing_is_told() -> None:
    with pytest.raises(UserError, match=r"left no library: is 'true' a C compiler\? Name one, such as gcc"):
        compile_library(FILES, "true")


def test_a_compiler_of_another_language_is_told_that_it_is_c(need_tool: Callable[..., str]) -> None:
    """Else names would be those of C++, and nothing found in the library."""
    need_tool("g++")
    assert (
        ctypes.CDLL(str(compile_library(FILES, "g++"))).answer()
        == ctypes.CDLL(str(compile_library(FILES))).answer()
    )


def test_refused_sources_show_the_compilers_words(empty_cache: Path) -> None:
    with pytest.raises(UserError, match=r"(?s)'gcc .*' failed:.*error: "):
        compile_library({"c/answer.c": "int answer(void) { return ; }\n"}, flags=("-Werror",))
    assert not list(empty_cache.glob("**/*.so"))
