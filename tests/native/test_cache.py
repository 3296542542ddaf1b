"""Compiled kernels are used again only if they are whole and nobody else could have written them."""

from __future__ import annotations

import ctypes
import os
import random
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tmm_gen.native import compiler
from tmm_gen.native.compiler import compile_library

SOURCE = {"answer.c": "int answer(void);\nint answer(void)\n{\n    return 42;\n}\n"}


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    compiler._cache_folder.cache_clear()
    yield compile_library(SOURCE)
    compiler._cache_folder.cache_clear()


def _truncate(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:4096])


def _empty(path: Path) -> None:
    path.write_bytes(b"")


def _flip(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[random.Random(path.stat().st_size).randrange(len(content))] ^= 1
    path.write_bytes(content)


def _open_to_all(path: Path) -> None:
    path.chmod(0o777)


def _link(path: Path) -> None:
    elsewhere = path.with_name("elsewhere")
    path.rename(elsewhere)
    path.symlink_to(elsewhere)


def _pipe(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


def _folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _of_another_user(path: Path) -> None:
    if os.geteuid() != 0:
        pytest.skip("only root can give files away")
    os.chown(path, 12345, 12345)


def _renamed(path: Path) -> None:
    path.rename(path.with_name("0" * 64 + ".so"))


@pytest.mark.parametrize(
    "damage",
    [_truncate, _empty, _flip, _open_to_all, _link, _pipe, _folder, _of_another_user, _renamed],
    ids=lambda damage: damage.__name__,
)
def test_what_is_damaged_or_not_ours_is_built_again(library: Path, damage: Callable[[Path], None]) -> None:
    damage(library)
    again = compile_library(SOURCE)
    assert ctypes.CDLL(str(again)).answer() == 42
    status = again.lstat()
    assert (status.st_uid, status.st_mode & 0o22) == (os.geteuid(), 0)


def test_what_is_whole_is_used_again(library: Path) -> None:
    before = library.stat().st_mtime_ns
    assert compile_library(SOURCE) == library
    assert library.stat().st_mtime_ns == before


def test_a_folder_that_others_write_to_is_closed(library: Path) -> None:
    library.parent.chmod(0o777)
    assert compile_library(SOURCE) == library
    assert library.parent.stat().st_mode & 0o22 == 0
