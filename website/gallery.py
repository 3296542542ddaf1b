"""The gallery: a card for every scene, from its file."""

from __future__ import annotations

import html
import re
from pathlib import Path

from pictures import gallery_scenes, picture

from tmm_gen.scene import load_scene


def cards(root: Path, playgrounds: set[str], sources: str) -> str:
    """Return all cards as HTML.

    Parameters
    ----------
    root : Path
        Of the repository.
    playgrounds : set of str
        Names of scenes that have a page to play with.
    sources : str
        Folder of the site where scene files are.
    """
    found = []
    for path in gallery_scenes():
        scene = load_scene(path)
        links = [f'<a href="{sources}/{path.relative_to(root).as_posix()}.txt">scene file</a>']
        shown = picture(scene)
        if scene.name in playgrounds:
            page = f'<a href="playground/{scene.name}.html"'
            links.insert(0, f"{page}>play with it</a>")
            shown = f'{page} title="Play with {scene.name}">{shown}</a>'
        found.append(
            f'<section><h3 id="{scene.name}">{scene.name}</h3>{shown}<p>{html.escape(scene.title)}.</p>'
            f"<p>{_summary(path.read_text())}</p><p>{', '.join(links)}</p></section>"
        )
    return f'<div class="cards">{"".join(found)}</div>'


def _summary(text: str) -> str:
    """Return the first sentence of a scene's head that says more than its title."""
    head = re.match(r"(?:#.*\n)+", text)
    words = re.sub(r"^# ?", "", head[0], flags=re.M) if head else ""
    paragraphs = [" ".join(part.split()) for part in words.split("\n\n")]
    told = [part for part in paragraphs if re.match(r"[A-Z]", part) and not part.startswith("Try it")]
    chosen = next((part for part in told if part.startswith("What it is for:")), told[0] if told else "")
    sentence = re.match(r"(?:What it is for: )?(.*?[.?])(?: |$)", chosen)
    said = sentence[1] if sentence else ""
    return re.sub(r"`(.+?)`", r"<code>\1</code>", html.escape(said[:1].upper() + said[1:]))
