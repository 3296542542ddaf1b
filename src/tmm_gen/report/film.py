"""Frames of a motion as an endless GIF, or as a page of HTML that needs nothing else.

What stands still is drawn once, and what moves over it in each frame: laying out and drawing a whole figure two hundred
times takes several times as long.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Sequence
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from tmm_gen.emit.templates import render

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure
    from PIL.Image import Image

__all__ = ["FRAMES_PER_SECOND", "film"]

FRAMES_PER_SECOND = 25

_DPI = 80
_COLOURS = 128
"""Of all frames together: lines in a few colours, and their edges."""


def film(
    made: Figure, moving: Sequence[Artist], draw: Callable[[int], object], count: int, form: str, title: str
) -> bytes:
    """Return frames as a file's bytes.

    Parameters
    ----------
    made : Figure
        With everything in it; to be called inside a block of :func:`tmm_gen.style.style`.
    moving : sequence of Artist
        What is drawn anew in each frame, from the back to the front.
    draw : callable
        Moves these to where they are in a frame, counted from 0.
    count : int
        Frames.
    form : {"gif", "html"}
        Format.
    title : str
        Of the page.
    """
    frames = _frames(made, moving, draw, count)
    return _gif(frames) if form == "gif" else _page(frames, title)


def _frames(made: Figure, moving: Sequence[Artist], draw: Callable[[int], object], count: int) -> list[Image]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    canvas: Any = FigureCanvasAgg(made)
    made.set_dpi(_DPI)
    for artist in moving:
        artist.set_animated(True)
    canvas.draw()
    still = canvas.copy_from_bbox(made.bbox)

    def drawn(frame: int) -> Image.Image:
        canvas.restore_region(still)
        draw(frame)
        for artist in moving:
            made.draw_artist(artist)
        return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy())

    palette = drawn(count - 1).quantize(_COLOURS)  # the last has all that there is to be seen
    return [drawn(k).quantize(palette=palette, dither=Image.Dither.NONE) for k in range(count)]


def _gif(frames: Sequence[Image]) -> bytes:
    with BytesIO() as buffer:
        frames[0].save(
            buffer,
            "GIF",
            save_all=True,
            append_images=frames[1:],
            duration=1000 // FRAMES_PER_SECOND,
            loop=0,
        )
        return buffer.getvalue()


def _page(frames: Sequence[Image], title: str) -> bytes:
    pictures = []
    for frame in frames:
        with BytesIO() as buffer:
            frame.save(buffer, "PNG")
            pictures.append(base64.b64encode(buffer.getvalue()).decode())
    width, height = frames[0].size
    page = render(
        "report/film.html.jinja",
        title=title,
        width=width,
        height=height,
        first=pictures[0],
        frames=json.dumps(pictures, separators=(",", ":")),
        pause=1000 // FRAMES_PER_SECOND,
    )
    return page.encode()
