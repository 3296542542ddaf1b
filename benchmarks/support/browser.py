"""Pages as a browser shows them."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

PHONE = 390
"""Pixels: the width of a common phone's screen."""


def excess_on_a_phone(page: str, folder: Path, browse: Callable[..., str]) -> int:
    """Return how many pixels a page is wider than a frame as wide as a phone."""
    (folder / "page.html").write_text(page)
    frame = (
        f'<iframe id="f" src="page.html" style="width:{PHONE}px;height:2000px;border:0"></iframe>'
        "<script>addEventListener('load', () => { const e = f.contentDocument.documentElement;"
        " document.title = 'excess=' + (e.scrollWidth - e.clientWidth) })</script>"
    )
    (folder / "frame.html").write_text(f"<!doctype html><title>-</title>{frame}")
    dom = browse(
        folder / "frame.html", "--allow-file-access-from-files", "--dump-dom", "--window-size=800,2000"
    )
    found = re.search(r"<title>excess=(\d+)</title>", dom)
    assert found, dom[:300]
    return int(found[1])
