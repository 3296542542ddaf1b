"""Packages that are known to be what their scenes give, so that a build with nothing to do derives nothing.

Two kinds of entries are kept. One says which files, with which hashes, follow from a scene; it holds no texts: where a
file on disk is missing or differs, the package is derived anew. The other says which scene the bytes of a file are, so
that this need not even be read: the models that check scenes take longer to import than all else of such a build.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from tmm_gen.package.cache import keep, kept
from tmm_gen.package.write import written_files
from tmm_gen.reading import read_file
from tmm_gen.trusted import digest_of

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

_BUILD = "build"
"""Folder of the cache: files by scene."""

_SCENE = "scene"
"""Folder of the cache: scenes by the bytes of their files."""


def known_files(digest: str, folder: Path) -> tuple[Path, ...] | None:
    """Return the files of a package on disk that is known to be what its scene gives, sorted; else None.

    Parameters
    ----------
    digest : str
        Of the scene.
    folder : Path
        Of the package.
    """
    known: dict[str, str] | None = kept(_BUILD, digest)
    if not known:
        return None
    wanted = {folder / path: expected for path, expected in known.items()}
    if not all(_is_file_with(path, expected) for path, expected in wanted.items()):
        return None
    return None if written_files(folder, beside=wanted) else tuple(sorted(wanted))


def known_scene(path: Path) -> tuple[str, str] | None:
    """Return name and digest of the scene that a file holds, if its bytes were read before; else None."""
    try:
        content = read_file(path)
    except (OSError, ValueError):
        return None  # reading the scene says what is wrong
    found: list[str] | None = kept(_SCENE, digest_of(content))
    return (found[0], found[1]) if found else None


def remember(scene: Scene, files: Mapping[str, str] | None = None) -> None:
    """Record what a scene's file holds, and what the scene gives; a cache that cannot be written is no error.

    Parameters
    ----------
    scene : Scene
        That was read.
    files : mapping from str to str, optional
        Text by path inside the package, if it was derived.
    """
    if files is not None:
        keep(_BUILD, scene.digest, {path: digest_of(text.encode()) for path, text in files.items()})
    if written := scene.source.written:
        keep(_SCENE, written, [scene.name, scene.digest])


def is_rememberable(scene: Scene) -> bool:
    """Return whether nothing but what entries are kept by decides: no other package's backend, which may change."""
    from tmm_gen.backends import OWN

    return {each.name for each in OWN}.issuperset(scene.emit.backends)


def _is_file_with(path: Path, expected: str) -> bool:
    try:
        return digest_of(read_file(path)) == expected
    except OSError:
        return False
