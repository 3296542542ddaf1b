"""Check a built site: links lead somewhere, nothing is fetched from elsewhere, pages fit a telephone and a desktop.

``python website/check.py out/site`` ends with 1 and a line for each fault. How pages look needs chromium; where that is
absent it is left out and said, and with ``CI`` set it is a fault.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

WIDTHS = (390, 1280)
"""Pixels: a common telephone, a common desktop."""

WORD = "gripper"
"""What a search finds on several pages."""

LOADING = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("object", "data")}
"""What a browser fetches by itself; of links, those of :data:`FETCHED`."""

FETCHED = {"stylesheet", "icon", "preload", "prefetch", "modulepreload"}


class Page(HTMLParser):
    """What a page links to, what it fetches, and the places in it."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: set[str] = set()
        self.fetched: set[str] = set()
        self.places: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take in one element."""
        known = {name: value for name, value in attrs if value is not None}
        self.places |= {known[name] for name in ("id", "name") if name in known}
        for name, value in known.items():
            if (tag, name) in LOADING or (tag == "link" and FETCHED & set(known.get("rel", "").split())):
                if name in ("src", "href", "data"):
                    self.fetched.add(value)
            elif tag == "a" and name == "href":
                self.links.add(value)


def broken(site: Path) -> Iterator[str]:
    """Yield a line for every link that leads nowhere and all that is fetched from elsewhere."""
    pages = {path: Page(path.read_text()) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        where = path.relative_to(site)
        for link in sorted(page.links | page.fetched):
            parts = urlsplit(link)
            if parts.scheme == "data":
                continue
            if parts.scheme or parts.netloc:
                if link in page.fetched:
                    yield f"{where}: fetches {link}"
                continue
            # 404.html is shown at any address, so that its links begin at the root
            base = site if parts.path.startswith("/") or where.name == "404.html" else path.parent
            target = (base / unquote(parts.path).lstrip("/")).resolve() if parts.path else path.resolve()
            if target.is_dir():
                target /= "index.html"
            if not target.is_file():
                yield f"{where}: {link} leads nowhere"
            elif (
                parts.fragment
                and target in pages
                # what stands behind a playground's # are choices
                and "playground" not in target.parts
                and unquote(parts.fragment) not in pages[target].places
            ):
                yield f"{where}: {link}: no such place on that page"
    for style in site.rglob("*.css"):
        for address in re.findall(r"(?:url\(|@import\s+)['\"]?((?:https?:)?//[^'\")\s]+)", style.read_text()):
            yield f"{style.relative_to(site)}: fetches {address}"


HARNESS = """<!doctype html><title>-</title><body style="margin:0"><script>
(async () => {
  const found = [];
  for (const page of PAGES) for (const width of WIDTHS) {
    const frame = document.createElement("iframe");
    frame.style = `width:${width}px;height:900px;border:0`;
    frame.src = page;
    document.body.replaceChildren(frame);
    await new Promise((done) => { frame.onload = done; });
    await new Promise((done) => setTimeout(done, 60));
    const root = frame.contentDocument.documentElement;
    const excess = root.scrollWidth - root.clientWidth;
    if (excess > 0) found.push(`${page}: ${excess} px too wide at ${width}`);
    if (!frame.contentDocument.body.innerText.trim()) found.push(`${page}: empty at ${width}`);
  }
  // the first page again, to look for a word in all of them
  const frame = document.createElement("iframe");
  frame.style = "width:1280px;height:900px";
  frame.src = START;
  document.body.replaceChildren(frame);
  await new Promise((done) => { frame.onload = done; });
  const query = frame.contentDocument.querySelector(".md-search__input");
  for (let k = 0; query && k < 50 && !frame.contentDocument.querySelector(".md-search-result__item"); k++) {
    query.focus();
    query.value = "WORD";
    query.dispatchEvent(new Event("keyup"));
    await new Promise((done) => setTimeout(done, 200));
  }
  if (query && !frame.contentDocument.querySelector(".md-search-result__item")) found.push("the search finds nothing");
  document.title = `done ${found.join("; ")}`;
})();
</script>"""


def misshapen(site: Path, program: str) -> Iterator[str]:
    """Yield a line for every page that is too wide, empty, or writes to the console."""
    pages = sorted(path.as_uri() for path in site.rglob("*.html") if path.name != "404.html")
    with tempfile.TemporaryDirectory() as folder:
        harness = Path(folder, "harness.html")
        given = {"PAGES": pages, "WIDTHS": WIDTHS, "START": (site / "index.html").as_uri()}
        text = HARNESS.replace('"WORD"', json.dumps(WORD))
        for name, value in given.items():
            text = text.replace(name, json.dumps(value))
        harness.write_text(text)
        quiet = ("--no-first-run", "--disable-background-networking", "--disable-component-update")
        command = [program, "--headless", "--no-sandbox", "--disable-gpu", *quiet, "--disable-sync"]
        command += [f"--user-data-dir={folder}/profile", "--proxy-server=127.0.0.1:9"]
        command += ["--allow-file-access-from-files", "--enable-logging=stderr", "--window-size=1300,900"]
        command += ["--virtual-time-budget=600000", "--dump-dom", harness.as_uri()]
        done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    for line in done.stderr.splitlines():
        if "CONSOLE" in line:
            yield line.partition("CONSOLE")[2]
    title = re.search(r"<title>done ([^<]*)</title>", done.stdout)
    if title is None:
        yield "the browser did not come to the end of all pages"
    else:
        yield from filter(None, title[1].split("; "))


def main(site: Path) -> int:
    """Check a site and say what is wrong with it."""
    faults = list(broken(site))
    program = shutil.which("chromium")
    if program is not None:
        faults += misshapen(site, program)
    elif os.environ.get("CI"):
        faults.append("chromium not found: apt-get install chromium")
    else:
        print("chromium not found: how pages look was not checked")
    for fault in faults:
        print(f"error: {fault}", file=sys.stderr)
    count = len(list(site.rglob("*.html")))
    print(f"{count} pages: {len(faults) or 'no'} fault{'s' * (len(faults) != 1)}")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
