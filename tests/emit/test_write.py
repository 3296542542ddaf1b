"""Packages on disk: whole, and never over what somebody else wrote."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.emit.seal import PLACEHOLDER, sealed
from tmm_gen.errors import UserError
from tmm_gen.package.write import compare_package, write_package, written_files


def file(body: str) -> str:
    return sealed(f"# {PLACEHOLDER}\n{body}\n")


FILES = {"__init__.py": file("one"), "c/arm.h": file("two")}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "generated" / "arm"


def test_a_new_package_is_written_and_an_old_one_left(folder: Path) -> None:
    assert set(write_package(FILES, folder).written) == {folder / "__init__.py", folder / "c" / "arm.h"}
    assert (folder / "c" / "arm.h").read_text() == FILES["c/arm.h"]
    again = write_package(FILES, folder)
    assert (again.written, again.stale) == ({}, ())
    assert set(again.unchanged) == {folder / path for path in FILES}


def test_only_what_differs_is_written(folder: Path) -> None:
    write_package(FILES, folder)
    before = (folder / "__init__.py").stat().st_mtime_ns
    changes = write_package({**FILES, "c/arm.h": file("new")}, folder)
    assert set(changes.written) == {folder / "c" / "arm.h"}
    assert (folder / "__init__.py").stat().st_mtime_ns == before


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (FILES["__init__.py"].replace("one", "mine"), "was edited by hand since tmm-gen wrote it"),
        ("# mine\n", "was not written by tmm-gen"),
        ("", "was not written by tmm-gen"),
    ],
)
def test_what_somebody_else_wrote_is_kept(folder: Path, text: str, fault: str) -> None:
    write_package(FILES, folder)
    (folder / "__init__.py").write_text(text)
    new = {**FILES, "c/arm.h": file("new")}
    with pytest.raises(UserError) as raised:
        write_package(new, folder)
    assert f"{folder / '__init__.py'}: {fault}" in str(raised.value)
    assert "--force" in str(raised.value)
    assert (folder / "__init__.py").read_text() == text
    assert (folder / "c" / "arm.h").read_text() == FILES["c/arm.h"]
    write_package(new, folder, force=True)
    assert (folder / "__init__.py").read_text() == FILES["__init__.py"]


def test_a_folder_in_the_way_is_told(folder: Path) -> None:
    (folder / "__init__.py").mkdir(parents=True)
    with pytest.raises(UserError, match="is a folder where a file is to be written"):
        write_package(FILES, folder)
    assert not (folder / "c").exists()


def test_stale_files_go_and_others_stay(folder: Path) -> None:
    write_package(FILES, folder)
    (folder / "notes.txt").write_text("mine\n")
    (folder / "c" / "build").mkdir()
    (folder / "__pycache__").mkdir()
    (folder / "__pycache__" / "kernel.pyc").write_bytes(b"\x00")
    left = {"__init__.py": FILES["__init__.py"]}
    assert compare_package(left, folder).stale == (folder / "c" / "arm.h",)
    assert (folder / "c" / "arm.h").exists()
    assert write_package(left, folder).stale == (folder / "c" / "arm.h",)
    assert not (folder / "c" / "arm.h").exists()
    assert (folder / "notes.txt").exists()
    assert (folder / "c" / "build").exists()


def test_a_folder_that_became_empty_goes(folder: Path) -> None:
    write_package(FILES, folder)
    write_package({"__init__.py": FILES["__init__.py"]}, folder)
    assert sorted(folder.iterdir()) == [folder / "__init__.py"]


def test_a_stale_file_edited_by_hand_stays(folder: Path) -> None:
    write_package(FILES, folder)
    (folder / "c" / "arm.h").write_text(FILES["c/arm.h"] + "mine\n")
    with pytest.raises(UserError, match=r"arm\.h: was edited by hand"):
        write_package({"__init__.py": file("new")}, folder)
    assert (folder / "__init__.py").read_text() == FILES["__init__.py"]
    write_package({"__init__.py": file("new")}, folder, force=True)
    assert not (folder / "c").exists()


def test_written_files_are_known_by_their_line(folder: Path) -> None:
    assert written_files(folder) == []
    write_package(FILES, folder)
    (folder / "other.py").write_text("x = 1\n")
    (folder / "data.py").write_bytes(b"\xff\xfe")
    assert written_files(folder) == [folder / "__init__.py", folder / "c" / "arm.h"]
