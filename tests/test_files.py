"""Files appear whole, and several of them all or none."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.files import write_tree_whole, write_whole


def _tree(folder: Path) -> dict[str, str | None]:
    return {
        path.relative_to(folder).as_posix(): path.read_text() if path.is_file() else None
        for path in folder.rglob("*")
    }


def test_a_file_is_written_with_its_folders_and_over_an_old_one(tmp_path: Path) -> None:
    target = tmp_path / "a" / "b" / "c.txt"
    write_whole(target, "one\n")
    target.chmod(0o755)
    write_whole(target, "zwei ß\n")
    assert target.read_bytes() == "zwei ß\n".encode()
    assert target.stat().st_mode & 0o777 == 0o755
    assert _tree(tmp_path) == {"a": None, "a/b": None, "a/b/c.txt": "zwei ß\n"}


def test_a_new_file_gets_the_usual_permissions(tmp_path: Path) -> None:
    (tmp_path / "usual").write_text("")
    write_whole(tmp_path / "new", b"\x00\xff")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "usual").stat().st_mode
    assert (tmp_path / "new").read_bytes() == b"\x00\xff"


def test_a_symbolic_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_whole(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"


@pytest.mark.parametrize("obstacle", ["a folder in the place of a file", "a file in the place of a folder"])
def test_where_one_cannot_be_written_none_is(tmp_path: Path, obstacle: str) -> None:
    (tmp_path / "old").write_text("old")
    (tmp_path / "blocked").mkdir()
    blocked = tmp_path / "blocked"
    if obstacle == "a file in the place of a folder":
        blocked = tmp_path / "old" / "x"
    before = _tree(tmp_path)
    with pytest.raises(OSError, match=r"directory|folder"):
        write_tree_whole({tmp_path / "old": "new", tmp_path / "n" / "m" / "new": "new", blocked: "new"})
    assert _tree(tmp_path) == before


@pytest.mark.parametrize("failing", [1, 2, 3])
def test_a_rename_that_fails_is_undone(tmp_path: Path, failing: int, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "one").write_text("old one")
    (tmp_path / "three").write_text("old three")
    before = _tree(tmp_path)
    replace = Path.replace
    calls = []

    def fail_once(self: Path, target: Path) -> Path:
        calls.append(target)
        if len(calls) == failing:
            raise OSError(28, "No space left on device", str(target))
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", fail_once)
    with pytest.raises(OSError, match="No space left"):
        write_tree_whole({tmp_path / "one": "1", tmp_path / "d" / "two": "2", tmp_path / "three": "3"})
    assert _tree(tmp_path) == before
