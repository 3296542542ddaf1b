"""Names that hold in every language at once."""

from __future__ import annotations

import keyword

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.scene.identifier import name_fault, scene_name_fault, title_fault


@pytest.mark.parametrize("name", ["arm10", "tip_torque", "A", "torque", "angle", "load", "hub", "x1"])
def test_good_names(name: str) -> None:
    assert name_fault(name) is None


@pytest.mark.parametrize("name", ["arm10", "Drivetrain", "thesis2", "hundred"])
def test_good_scene_names(name: str) -> None:
    assert scene_name_fault(name) is None


@pytest.mark.parametrize("name", ["numpy", "casadi", "random", "Random", "main", "tmm_gen", "assert", "aux"])
def test_scene_names_that_hide_something(name: str) -> None:
    assert scene_name_fault(name) is not None


@pytest.mark.parametrize("name", ["arm_default", "Arm_INVALID"])
def test_scene_names_whose_c_would_be_that_of_another(name: str) -> None:
    fault = scene_name_fault(name)
    assert fault is not None
    assert scene_name_fault(fault[1].split("'")[1]) is None


@given(st.one_of(st.text(max_size=8), st.from_regex(r"[A-Za-z0-9_. -]{0,12}", fullmatch=True)))
def test_accepted_names_are_identifiers_and_suggestions_are_accepted(name: str) -> None:
    fault = name_fault(name)
    if fault is None:
        assert name.isidentifier()
        assert name.isascii()
        assert not keyword.iskeyword(name)
        assert name[0] != "_"
    else:
        _, remedy = fault
        if "'" in remedy:
            assert name_fault(remedy.split("'")[1]) is None


@pytest.mark.parametrize(
    "title", ["Arm, 10 links: EI = 3.2", "بازوی انعطاف‌پذیر".replace("\u200c", ""), "50 % (β)", ""]
)
def test_good_titles(title: str) -> None:
    assert title_fault(title) is None


@pytest.mark.parametrize("title", ["a\nb", "*/", "/*", '"""', "\\", "\x1b[31m", "a\tb"])
def test_titles_that_break_comments(title: str) -> None:
    assert title_fault(title) is not None
