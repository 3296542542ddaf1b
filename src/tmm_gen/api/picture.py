"""A picture that notebooks show, that can be written, and whose figure can be drawn on."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from tmm_gen.api.words import path_of
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Picture", "target_of"]

_FORMS = (".png", ".svg", ".pdf")


class Picture:
    """A picture.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What is drawn; not pyplot's, so that nothing has to be closed.
    title : str
        What it shows.
    file : str or path, optional
        Where to write it at once.
    """

    def __init__(self, figure: Figure, title: str, file: str | PathLike[str] | None = None) -> None:
        self.figure, self.title = figure, title
        if file is not None:
            self.save(file)

    def save(self, file: str | PathLike[str]) -> Path:
        """Write it as PNG, SVG or PDF, by the file's ending; return where."""
        target = target_of(file, _FORMS)
        write_whole(target, self._bytes(target.suffix[1:].lower()))
        return target

    def _bytes(self, form: str) -> bytes:
        from tmm_gen.style import picture

        return picture(self.figure, form)

    def _repr_png_(self) -> bytes:
        return self._bytes("png")

    def __repr__(self) -> str:
        """Say what it shows."""
        return f"<Picture: {self.title}>"


def target_of(file: object, endings: tuple[str, ...]) -> Path:
    """Return where something is to be written.

    Raises
    ------
    UserError
        If the name is none, or ends otherwise.
    """
    path = path_of("file", file)
    if path.suffix.lower() not in endings:
        raise UserError(f"{path}: must end in {' or '.join(endings)}.")
    return path
