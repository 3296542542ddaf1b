"""The line by which a generated file proves that nobody edited it."""

from __future__ import annotations

import hashlib

import pytest

from tmm_gen.emit.seal import LABEL, PLACEHOLDER, is_intact, is_written_by_tmm_gen, sealed

TEXT = f"# head\n# {PLACEHOLDER}\nbody = 1\n"


def test_the_hash_is_that_of_the_other_lines() -> None:
    expected = hashlib.sha256(b"# head\nbody = 1\n").hexdigest()
    assert sealed(TEXT) == f"# head\n# {LABEL}{expected}\nbody = 1\n"
    assert is_intact(sealed(TEXT))


@pytest.mark.parametrize("comment", ["# {}", " * {}", "/* {} */", "// {}", "{}"])
def test_any_comment_will_do(comment: str) -> None:
    assert is_intact(sealed(f"first\n{comment.format(PLACEHOLDER)}\nlast\n"))


@pytest.mark.parametrize("edit", [("body", "Body"), ("head\n", "head\n\n"), ("1\n", "1")])
def test_an_edit_breaks_it(edit: tuple[str, str]) -> None:
    text = sealed(TEXT).replace(*edit)
    assert is_written_by_tmm_gen(text)
    assert not is_intact(text)


def test_sealing_twice_changes_nothing() -> None:
    assert sealed(sealed(TEXT)) == sealed(TEXT)


def test_other_files_have_none() -> None:
    assert not is_written_by_tmm_gen("body = 1\n")
    assert not is_intact("body = 1\n")
    with pytest.raises(ValueError, match="no line for its hash"):
        sealed("body = 1\n")
