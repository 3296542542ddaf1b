"""The gallery: a card for every scene, from its file."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from tmm_gen.playground.page import refusal
from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.places import node_places, outline
from tmm_gen.simulate.skeleton import Skeleton

FOLDERS = ("scenes", "examples/space")
WIDE, HIGH = 320.0, 120.0


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
    for folder in FOLDERS:
        for path in sorted((root / folder).glob("*.toml")):
            scene = load_scene(path)
            links = [f'<a href="{sources}/{folder}/{path.name}.txt">scene file</a>']
            picture = _drawn(scene)
            if scene.name in playgrounds:
                page = f'<a href="playground/{scene.name}.html"'
                links.insert(0, f"{page}>play with it</a>")
                picture = f'{page} title="Play with {scene.name}">{picture}</a>'
            elif (why := refusal(scene)) is not None:
                links.append(f"no playground: {html.escape(why[0])}")
            found.append(
                f'<section><h3 id="{scene.name}">{scene.name}</h3>{picture}<p>{html.escape(scene.title)}.</p>'
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
    return html.escape(said[:1].upper() + said[1:])


def _drawn(scene: Scene) -> str:
    """Return the arm at its start as SVG."""
    lines = list(_lines(scene))
    points = np.concatenate(lines)
    low, high = points.min(axis=0), points.max(axis=0)
    scale = min((WIDE - 24) / max(high[0] - low[0], 1e-9), (HIGH - 24) / max(high[1] - low[1], 1e-9))
    tall = scale * (high[1] - low[1]) + 24
    middle = (low + high) / 2
    drawn = []
    for each in lines:
        at = (each - middle) * [scale, -scale] + [WIDE / 2, tall / 2]
        drawn.append(f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in at)}"/>')
        drawn += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3"/>' for x, y in at if len(at) < 40]
    told = f'viewBox="0 0 {WIDE:g} {tall:.0f}" role="img" aria-label="{scene.name} at its start"'
    style = 'fill="none" stroke="currentColor" stroke-width="3" stroke-linejoin="round"'
    return f"<svg {told} {style}>{''.join(drawn)}</svg>"


def _lines(scene: Scene) -> Iterator[np.ndarray]:
    angles = np.array([scene.initial.angles])
    if scene.spatial is not None:
        skeleton = Skeleton(scene.spatial)
        base = scene.spatial.base
        if base is not None:
            angles = np.concatenate([[[*base.at, 1.0, 0.0, 0.0, 0.0]], angles], axis=1)
        x, y, z = skeleton.points(angles)[0].T
        seen = np.stack([0.8 * x + 0.6 * y, z + 0.25 * (0.8 * y - 0.6 * x)], axis=1)
        yield from (seen[list(line)] for line in skeleton.lines)
    elif scene.model.linear:
        yield np.stack([np.arange(scene.stations + 1.0), np.zeros(scene.stations + 1)], axis=1)
    else:
        places = np.stack([outline(scene, each)[0] for each in node_places(scene, angles)], axis=1)
        gaps = np.flatnonzero(np.isnan(places[:, 0]))
        for part in np.split(places, gaps):
            yield part[~np.isnan(part[:, 0])]
