"""What makes a site of pages that GitHub shows as well: links out of docs/, markers, pages made from code.

A marker is a comment, which GitHub does not show: ``<!-- gallery -->``, ``<!-- playground: elbow -->``.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import Any

from gallery import cards
from mkdocs.structure.files import File, Files
from reference import generated_page, python_page

ROOT = Path(__file__).resolve().parents[1]
PLAYGROUNDS = ROOT / "out" / "playground"
SOURCES = "source"
"""Folder of the site for files of the repository that pages link to."""

LINK = re.compile(r"(?<=\]\()(\.\./[^)#\s]+)")
SHIM = re.compile(r'"https://unpkg\.com/iframe-worker/shim[^"]*"')
"""What the plugin `offline` fetches from elsewhere; `search.js` does the same."""

ROLE = re.compile(r":(?:attr|class|data|func|meth|mod):\s*(?=<code)")
"""What docstrings write before names for another tool."""

CODE = re.compile(r"<code[^>]*>.*?</code>", re.S)
WHOLE = re.compile(r"(?<=[\s>])--?[A-Za-z][\w-]*|\d+e-(?:<span[^>]*>)?\d+(?:</span>)?")
"""Options and numbers, which lines may not break at their hyphens."""

MARKER = re.compile(r"<!-- (gallery|playground: (\w+)) -->")


def on_config(config: Any, **_: Any) -> Any:
    """Give pages that may be absent their place: what is not there is left out."""
    reference = next(entry["Reference"] for entry in config.nav if "Reference" in entry)
    if python_page():
        reference.insert(0, {"Python": "reference/python.md"})
    return config


def on_files(files: Files, config: Any, **_: Any) -> Files:
    """Add playgrounds, the style, pages from docstrings, and the sources that pages link to."""
    for path in sorted(PLAYGROUNDS.glob("*.html")):
        files.append(File.generated(config, f"playground/{path.name}", abs_src_path=str(path)))
    for name in ("site.css", "search.js"):
        files.append(File.generated(config, name, abs_src_path=str(ROOT / "website" / name)))
    files.append(File.generated(config, "reference/generated.md", content=generated_page()))
    if text := python_page():
        files.append(File.generated(config, "reference/python.md", content=text))
    wanted = {
        _target(page.src_uri, link)
        for page in files.documentation_pages()
        for link in LINK.findall(page.content_string)
    }
    wanted |= {f"scenes/{path.name}" for path in (ROOT / "scenes").glob("*.toml")}
    wanted |= {f"examples/space/{path.name}" for path in (ROOT / "examples" / "space").glob("*.toml")}
    for path in sorted(wanted):
        files.append(File.generated(config, _shown(path), content=_text(path)))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Turn links out of docs/ to copies on the site, and fill in markers."""
    uri = page.file.src_uri
    up = posixpath.relpath(".", posixpath.dirname(uri) or ".")
    markdown = LINK.sub(lambda found: posixpath.join(up, _shown(_target(uri, found[1]))), markdown)
    return MARKER.sub(lambda found: _filled(found[1], found[2]), markdown)


def on_page_content(html: str, **_: Any) -> str:
    """Keep options and numbers of commands whole where lines end, and roles of docstrings out of sight."""
    html = ROLE.sub("", html)
    return CODE.sub(lambda code: WHOLE.sub(r'<span class="whole">\g<0></span>', code[0]), html)


def on_post_page(output: str, page: Any, **_: Any) -> str:
    """Fetch nothing from elsewhere."""
    return SHIM.sub(
        f'"{posixpath.relpath("search.js", posixpath.dirname(page.file.dest_uri) or ".")}"', output
    )


def on_post_template(output_content: str, **_: Any) -> str:
    """Do the same on the page for addresses that do not exist."""
    return SHIM.sub('"/search.js"', output_content)


def _filled(marker: str, scene: str | None) -> str:
    if marker == "gallery":
        return cards(ROOT, {path.stem for path in PLAYGROUNDS.glob("*.html")}, SOURCES)
    if not (PLAYGROUNDS / f"{scene}.html").exists():
        raise FileNotFoundError(f"no playground of {scene}: `make site` makes it")
    page = f"playground/{scene}.html"
    return (
        f'<iframe class="playground" src="{page}#embed" title="Playground of {scene}"></iframe>\n\n'
        f'<p><a href="{page}">The whole page, with its charts</a></p>'
    )


def _target(page: str, link: str) -> str:
    """Return the path inside the repository that a page's link means."""
    return posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), link))


def _shown(path: str) -> str:
    """Return where the site has a copy; as text, so that a browser shows it."""
    return f"{SOURCES}/{path}.txt"


def _text(path: str) -> str:
    """Return a file, or the list of a folder.

    Raises
    ------
    FileNotFoundError
        If a page links to what is not there.
    """
    place = ROOT / path
    if place.is_dir():
        return "".join(f"{each.relative_to(ROOT)}\n" for each in sorted(place.iterdir()) if each.is_file())
    return place.read_text()
