"""The check of the site finds what is wrong with a page: links, places, what is fetched, width, the console."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]

GOOD = '<!doctype html><title>a</title><link rel="icon" href="data:,"><h1 id="one">A</h1><a href="b.html#two">b</a>'
OTHER = '<!doctype html><title>b</title><h1 id="two">B</h1><a href="index.html">a</a><a href="https://example.org">c</a>'


@pytest.fixture(scope="module")
def check() -> ModuleType:
    spec = importlib.util.spec_from_file_location("site_check", ROOT / "website" / "check.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def site(tmp_path: Path) -> Path:
    (tmp_path / "index.html").write_text(GOOD)
    (tmp_path / "b.html").write_text(OTHER)
    return tmp_path


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ('<a href="c.html">', "b.html: c.html leads nowhere"),
        ('<a href="../secret">', "b.html: ../secret leads nowhere"),
        ('<a href="index.html#three">', "b.html: index.html#three: no such place on that page"),
        ('<img src="https://example.org/a.png">', "b.html: fetches https://example.org/a.png"),
        ('<link rel="stylesheet" href="//example.org/a.css">', "b.html: fetches //example.org/a.css"),
    ],
)
def test_broken_links_and_foreign_resources_are_found(
    more: str, said: str, check: ModuleType, site: Path
) -> None:
    assert list(check.broken(site)) == []
    (site / "b.html").write_text(OTHER + more)
    assert list(check.broken(site)) == [said]


def test_what_a_style_fetches_is_found(check: ModuleType, site: Path) -> None:
    (site / "a.css").write_text("@font-face { src: url('https://example.org/f.woff') }")
    assert list(check.broken(site)) == ["a.css: fetches https://example.org/f.woff"]


def test_a_browser_finds_wide_pages_and_messages(
    check: ModuleType, site: Path, need_tool: Callable[..., str]
) -> None:
    program = need_tool("chromium")
    wide = '<div style="position:absolute;left:0;width:700px">wide</div><script>console.error("a fault")</script>'
    (site / "b.html").write_text(OTHER + wide)
    found = list(check.misshapen(site, program))
    assert any("a fault" in line for line in found)
    assert [line.rpartition("/")[2] for line in found if "too wide" in line] == [
        "b.html: 310 px too wide at 390"
    ]
    (site / "b.html").write_text(OTHER)
    assert list(check.misshapen(site, program)) == []
