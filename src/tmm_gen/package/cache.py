"""Remembering what follows from a scene with this tmm-gen and these packages, so that it need not be found again."""

from __future__ import annotations

import hashlib
import json
import os
from contextlib import suppress
from pathlib import Path
from typing import Any

from tmm_gen.files import write_whole
from tmm_gen.package.generator import installed_digest
from tmm_gen.trusted import digest_of, discard, own_content, own_folder

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


def keep(kind: str, digest: str, found: object) -> None:
    """Keep what was found of a scene, as JSON has it; a cache that cannot be written is no error.

    Parameters
    ----------
    kind : str
        Folder of the cache.
    digest : str
        Of the scene, or of the bytes that say it.
    found : object
        Whatever follows from the scene with this tmm-gen and these packages.
    """
    body = json.dumps(found, indent=1, sort_keys=True) + "\n"
    entry = _entry(kind, digest)
    with suppress(OSError):
        own_folder(entry.parent)
        if own_content(entry, _LARGEST) is None:
            discard(entry)
        write_whole(entry, f"{_seal(entry, body)}\n{body}")
        entry.chmod(0o600)


def _entry(kind: str, digest: str) -> Path:
    key = hashlib.sha256(f"{kind}\n{digest}\n{installed_digest()}".encode()).hexdigest()
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
