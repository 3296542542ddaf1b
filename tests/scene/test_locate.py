"""Lines of keys and values, on chosen and on generated documents."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.scene.locate import locate, nearest_line
from tmm_gen.scene.problem import Path

CHOSEN = '''\
# comment = 1
name = "arm"   # [[link]]
[model] # here
"kind" = 'chain'
  gravity.value = 9.81
gravity . 'unit' = "m"

[[link]]
inertia = [
  1.0, # ] one
  2.0,
]
[link.extra]
note = """
[[link]]
inertia = 3
\\""""
[[link]]
inertia = { mass = 1, at = [ { x = 0 }, {} ], "a.b" = '}' }
when = 1979-05-27 07:32:00Z
[[link.hole]]
radius = 1
[[link.hole]]
radius = 2
[deep."x.y".z]
last = \'\'\'
it''s\'\'\'\'
end = true'''


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ((), 1),
        (("name",), 2),
        (("model",), 3),
        (("model", "kind"), 4),
        (("model", "gravity"), 5),
        (("model", "gravity", "value"), 5),
        (("model", "gravity", "unit"), 6),
        (("link",), 8),
        (("link", 0), 8),
        (("link", 0, "inertia"), 9),
        (("link", 0, "inertia", 0), 10),
        (("link", 0, "inertia", 1), 11),
        (("link", 0, "extra"), 13),
        (("link", 0, "extra", "note"), 14),
        (("link", 1), 18),
        (("link", 1, "inertia"), 19),
        (("link", 1, "inertia", "at", 0, "x"), 19),
        (("link", 1, "inertia", "a.b"), 19),
        (("link", 1, "when"), 20),
        (("link", 1, "hole", 0, "radius"), 22),
        (("link", 1, "hole", 1), 23),
        (("link", 1, "hole", 1, "radius"), 24),
        (("deep", "x.y", "z"), 25),
        (("deep", "x.y", "z", "last"), 26),
        (("deep", "x.y", "z", "end"), 28),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_chosen_document(path: Path, line: int, newline: str) -> None:
    text = CHOSEN.replace("\n", newline)
    assert locate(text)[path] == line


def test_a_table_declared_after_its_children_has_the_line_of_its_own_header() -> None:
    assert locate("[a.b]\nx = 1\n[a]\ny = 2\n")[("a",)] == 3


@pytest.mark.parametrize(
    ("path", "line"), [(("a", "missing"), 2), (("a", "x", 7, "y"), 3), (("b",), 1), ((), 1), (("a", "x"), 3)]
)
def test_nearest_line_of_what_is_missing(path: Path, line: int) -> None:
    assert nearest_line(locate("# top\n[a]\nx = [1]\n"), path) == line


BARE = st.text("abcXYZ019_-", min_size=1, max_size=4)
NASTY = st.text(alphabet="a \t\"'\\#=[]{}.,\né€", max_size=6)
KEYS = st.one_of(BARE, NASTY)


class Writer:
    """Writes a document in a drawn style and notes where it put what."""

    def __init__(self, draw: Callable[..., Any]) -> None:
        self.draw = draw
        self.text = ""
        self.lines: dict[Path, int] = {(): 1}

    def document(self) -> None:
        self.body((), ())
        if self.text.endswith("\n") and self.flip():
            self.text = self.text[:-1]

    def flip(self) -> bool:
        return bool(self.draw(st.booleans()))

    def note(self, path: Path) -> None:
        self.lines.setdefault(path, self.text.count("\n") + 1)

    def space(self) -> None:
        self.text += self.draw(st.sampled_from(["", " ", "\t "]))

    def blank(self) -> None:
        """Write space, newlines and comments, as arrays allow between items."""
        self.text += self.draw(st.sampled_from(["", " ", "\n", "# ], [x] = '\n", "\n\n  "]))

    def end_line(self) -> None:
        self.space()
        self.text += self.draw(st.sampled_from(["\n", "# x = [1]\n", "\n\n", '\n# """\n\t\n']))

    def key(self, key: str) -> None:
        styles = [json.dumps(key, ensure_ascii=False)]
        if key and set(key) <= set("abcXYZ019_-"):
            styles.append(key)
        if "'" not in key and "\n" not in key:
            styles.append(f"'{key}'")
        self.text += self.draw(st.sampled_from(styles))

    def body(self, path: Path, header: tuple[str, ...], depth: int = 0) -> None:
        """Write the pairs of a table, then its sub-tables under headers."""
        keys = self.draw(st.lists(KEYS, unique=True, max_size=4))
        split = self.draw(st.integers(0, len(keys))) if depth < 3 else len(keys)
        for key in keys[:split]:
            self.pair(path, key, depth)
            self.end_line()
        for key in keys[split:]:
            self.sub_table(path, header, key, depth)

    def sub_table(self, path: Path, header: tuple[str, ...], key: str, depth: int) -> None:
        below = (*path, key)
        if self.flip():
            self.note(below)
            self.header((*header, key), 1)
            self.body(below, (*header, key), depth + 1)
            return
        for index in range(self.draw(st.integers(1, 3))):
            self.note(below)
            self.note((*below, index))
            self.header((*header, key), 2)
            self.body((*below, index), (*header, key), depth + 1)

    def header(self, keys: tuple[str, ...], brackets: int) -> None:
        self.text += "[" * brackets
        for index, key in enumerate(keys):
            self.text += "." if index else ""
            self.space()
            self.key(key)
            self.space()
        self.text += "]" * brackets
        self.end_line()

    def pair(self, path: Path, key: str, depth: int, inline: bool = False) -> None:
        """Write ``key = value``, or several pairs of a sub-table by dotted keys."""
        path = (*path, key)
        self.note(path)
        self.key(key)
        if depth < 3 and self.flip() and self.flip():
            self.space()
            self.text += "."
            self.space()
            self.pair(path, self.draw(KEYS), depth + 1, inline)
            return
        self.space()
        self.text += "="
        self.space()
        self.value(path, depth, inline)

    def value(self, path: Path, depth: int, inline: bool) -> None:
        kind = self.draw(st.integers(0, 5)) if depth < 3 else 0
        if kind == 1:
            self.array(path, depth, inline)
        elif kind == 2:
            self.inline_table(path, depth)
        elif kind == 3:
            self.string()
        else:
            scalars = ["0", "-1.5e-3", "inf", "true", "1979-05-27 07:32:00", "07:32:00", "0xdead_beef"]
            self.text += self.draw(st.sampled_from(scalars))

    def string(self) -> None:
        content = self.draw(NASTY)
        long = content.replace("\\", "\\\\").replace('"""', '""\\"')
        styles = [json.dumps(content, ensure_ascii=False), '"""' + long.rstrip('"') + '""""']
        if "'" not in content:
            styles.append(f"'''{content}'''''")
            if "\n" not in content:
                styles.append(f"'{content}'")
        self.text += self.draw(st.sampled_from(styles))

    def array(self, path: Path, depth: int, inline: bool) -> None:
        self.text += "["
        count = self.draw(st.integers(0, 3))
        for index in range(count):
            self.blank()
            self.note((*path, index))
            self.value((*path, index), depth + 1, inline)
            self.blank()
            if index < count - 1 or self.flip():
                self.text += ","
        self.blank()
        self.text += "]"

    def inline_table(self, path: Path, depth: int) -> None:
        self.text += "{"
        for index, key in enumerate(self.draw(st.lists(KEYS, unique=True, max_size=3))):
            self.text += "," if index else ""
            self.space()
            self.pair(path, key, depth + 1, inline=True)
            self.space()
        self.text += "}"


@st.composite
def documents(draw: Callable[..., Any]) -> Writer:
    writer = Writer(draw)
    writer.document()
    return writer


def paths_of(value: Any, path: Path = ()) -> Iterator[Path]:
    yield path
    if isinstance(value, dict):
        for key, item in value.items():
            yield from paths_of(item, (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from paths_of(item, (*path, index))


@given(documents())
def test_generated_documents(written: Writer) -> None:
    data = tomllib.loads(written.text)
    found = locate(written.text)
    assert set(found) == set(paths_of(data))
    assert found == written.lines


@given(documents())
def test_line_ends_do_not_matter(written: Writer) -> None:
    assert locate(written.text.replace("\n", "\r\n")) == written.lines
