"""Tables, JSON and progress."""

from __future__ import annotations

import io
import json
import math
import os
import re
import sys
import threading
from enum import Enum
from pathlib import PurePosixPath

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.cli import console
from tmm_gen.cli.console import Column, plain, print_json, progress, table

JSON_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["a", "b_c", "d2"]), inner),
    max_leaves=10,
)


class Unit(Enum):
    METRE = "m"


@given(JSON_VALUES)
def test_json_never_has_a_number_that_is_not_finite(value: object) -> None:
    text = json.dumps(plain(value))

    def refuse(word: str) -> None:
        raise AssertionError(word)

    json.loads(text, parse_constant=refuse)


def test_values_become_what_json_knows() -> None:
    values = {
        "array": np.array([[1.0, np.nan], [np.inf, 2.0]]),
        "scalar": np.float32(0.5),
        "whole": np.int64(3),
        "truth": np.bool_(True),
        "path": PurePosixPath("a/b"),
        "unit": Unit.METRE,
        "pair": (1, -math.inf),
    }
    assert plain(values) == {
        "array": [[1.0, None], [None, 2.0]],
        "scalar": 0.5,
        "whole": 3,
        "truth": True,
        "path": "a/b",
        "unit": "m",
        "pair": [1, None],
    }


@pytest.mark.parametrize("bad", [{"camelCase": 1}, {"with space": 1}, {3: 1}, {"set": {1}}, {"z": 1j}])
def test_what_json_cannot_say_is_refused(bad: dict[str, object]) -> None:
    with pytest.raises(TypeError):
        print_json(bad)


def test_a_table_as_json_is_one_object_with_whole_rows(capsys: pytest.CaptureFixture[str]) -> None:
    table([{"name": "a", "error": math.nan, "hidden": 1}], ["name", "error"], True, more={"step": 1e-3})
    shown = json.loads(capsys.readouterr().out)
    assert shown == {"step": 0.001, "rows": [{"name": "a", "error": None, "hidden": 1}]}


def test_a_table_shows_its_columns_in_their_form(capsys: pytest.CaptureFixture[str]) -> None:
    rows = [
        {"name": "[red]x[/red]", "peak_value": 1234.5678, "stable": True, "order": None},
        {"name": "y" * 300, "peak_value": 1.0, "stable": False, "order": 2},
    ]
    table(rows, ["name", Column("peak_value", "peak", ".3g"), "stable", Column("order")], title="T")
    shown = capsys.readouterr().out
    lines = shown.splitlines()
    assert lines[0].strip() == "T"
    cells = [
        [cell.strip() for cell in line.strip("┃│").replace("┃", "│").split("│")]
        for line in lines
        if "│" in line
    ]
    assert cells == [["[red]x[/red]", "1.23e+03", "yes", "-"], ["y" * 300, "1", "no", "2"]]
    assert [cell.strip() for cell in lines[2].strip("┃").split("┃")] == ["name", "peak", "stable", "order"]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_table_too_wide_for_the_terminal_becomes_records(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = Terminal()
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setattr("shutil.get_terminal_size", lambda *_, **__: os.terminal_size((60, 24)))
    columns: list[Column | str] = ["name", Column("peak", "largest angle (rad)", ".3g"), "a_remark"]
    rows = [{"name": name, "peak": 1.0, "a_remark": "of some length " * 3} for name in ("first", "second")]
    table(rows, columns, title="T")
    lines = stream.getvalue().splitlines()
    assert lines[:5] == [
        "T",
        "",
        "name                 first",
        "largest angle (rad)  1",
        "a remark             " + "of some length " * 3,
    ]
    assert "name                 second" in lines
    stream.truncate(0)
    table(rows, columns[:2], title="T")
    assert "┃" in stream.getvalue()


def test_progress_is_silent_where_nobody_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    with progress("measuring", 2, after=0.0) as advance:
        advance()
        advance(1, "still measuring")
    assert stream.getvalue() == ""


def test_long_work_says_so_in_lines_where_nobody_sees_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    stream, told = io.StringIO(), threading.Event()
    write = stream.write

    def watch(text: str) -> int:
        if "refining" in text:
            told.set()
        return write(text)

    monkeypatch.setattr(stream, "write", watch)
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(console, "_QUIET", 0.01)
    before = threading.active_count()
    with progress("checking arm", 1.0) as advance:
        advance(0.4, "refining the step")
        assert told.wait(timeout=60)
    assert re.search(r"^checking arm: refining the step \(40 %\), \d+ s so far$", stream.getvalue(), re.M)
    assert threading.active_count() == before


def test_progress_does_not_show_for_short_work(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    before = threading.active_count()
    with progress("measuring", 1, after=3600.0) as advance:
        advance()
    assert stream.getvalue() == ""
    assert threading.active_count() == before


def test_progress_shows_on_a_terminal_and_goes_when_the_work_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    shown = threading.Event()
    write = stream.write

    def watch(text: str) -> int:
        if "measuring" in text:
            shown.set()
        return write(text)

    monkeypatch.setattr(stream, "write", watch)
    before = set(threading.enumerate())

    def work() -> None:
        with progress("measuring", 4, after=0.0) as advance:
            advance()
            assert shown.wait(timeout=60)
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        work()
    for thread in set(threading.enumerate()) - before:
        thread.join(timeout=60)
        assert not thread.is_alive()
