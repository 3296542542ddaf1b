"""Remembering what was built, so that a build with nothing to do need not derive anything.

An entry says which files, with which hashes, follow from a scene with this tmm-gen and this SymPy. It holds
no texts: where a file on disk is missing or differs, the package is derived anew.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from tmm_gen.files import write_whole
from tmm_gen.package.write import written_files
from tmm_gen.reading import read_file
from tmm_gen.resources import templates_dir
from tmm_gen.trusted import digest_of, discard, own_content, own_folder
from tmm_gen.version import __version__

_BUILD = "build"
"""Folder of what builds are known by."""

_LARGEST = 2**22
"""Bytes of an entry."""

VARIABLE = "TMM_GEN_CACHE"
"""Environment variable that names another folder for the cache."""


def cache_folder() -> Path:
    """Return the folder of the cache: $TMM_GEN_CACHE, or that of the user's caches."""
    if chosen := os.environ.get(VARIABLE):
        return Path(chosen)
    import platformdirs

    return Path(platformdirs.user_cache_dir("tmm-gen"))


def is_up_to_date(digest: str, folder: Path) -> bool:
    """Return whether a package on disk is known to be what its scene gives.

    Parameters
    ----------
    digest : str
        Of the scene.
    folder : Path
        Of the package.
    """
    known: dict[str, str] | None = kept(_BUILD, digest)
    if not known:
        return False
    wanted = {folder / path: expected for path, expected in known.items()}
    if any(path not in wanted for path in written_files(folder)):
        return False
    return all(_is_file_with(path, expected) for path, expected in wanted.items())


def remember(digest: str, files: Mapping[str, str]) -> None:
    """Record what a scene gives; a cache that cannot be written is no error.

    Parameters
    ----------
    digest : str
        Of the scene.
    files : mapping from str to str
        Text by path inside the package.
    """
    keep(_BUILD, digest, {path: digest_of(text.encode()) for path, text in files.items()})


def keep(kind: str, digest: str, found: object) -> None:
    """Keep what was found of a scene, as JSON has it; a cache that cannot be written is no error.

    Parameters
    ----------
    kind : str
        Folder of the cache.
    digest : str
        Of the scene.
    found : object
        Whatever follows from the scene with this tmm-gen and this SymPy.
    """
    body = json.dumps(found, indent=1, sort_keys=True) + "\n"
    entry = _entry(kind, digest)
    with suppress(OSError):
        own_folder(entry.parent)
        if own_content(entry, _LARGEST) is None:
            discard(entry)
        write_whole(entry, f"{_seal(entry, body)}\n{body}")
        entry.chmod(0o600)


@cache
def generator_digest() -> str:
    """Return the hash of what decides, with the scene, what is generated: tmm-gen's files and SymPy."""
    digest = hashlib.sha256(f"{__version__}\n{version('sympy')}\n".encode())
    sources = Path(__file__).resolve().parents[1]
    for root, pattern in ((sources, "*.py"), (templates_dir(), "*.jinja")):
        for path in sorted(root.rglob(pattern)):
            digest.update(f"{path.relative_to(root).as_posix()}\n".encode())
            digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def _is_file_with(path: Path, expected: str) -> bool:
    try:
        return digest_of(read_file(path)) == expected
    except OSError:
        return False


def _entry(kind: str, digest: str) -> Path:
    key = hashlib.sha256(f"{digest}\n{generator_digest()}".encode()).hexdigest()
    return cache_folder() / kind / f"{key}.json"


def kept(kind: str, digest: str) -> Any:
    """Return what was kept of a scene; None for what is not there, is damaged, or could be somebody else's."""
    entry = _entry(kind, digest)
    content = own_content(entry, _LARGEST)
    if content is None:
        return None
    seal, _, body = content.decode(errors="replace").partition("\n")
    if seal != _seal(entry, body):
        return None
    return json.loads(body)  # as it was written: the seal has told


def _seal(entry: Path, body: str) -> str:
    """Return the first line of an entry: the hash of its name and of the rest."""
    return digest_of(f"{entry.name}\n{body}".encode())
