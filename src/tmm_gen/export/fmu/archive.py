"""A zip file that is the same bytes for the same content."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping

_WHEN = (1980, 1, 1, 0, 0, 0)
"""The earliest date a zip file knows: content counts, not the day it was packed."""


def archive(files: Mapping[str, str | bytes]) -> bytes:
    """Pack files, sorted by path.

    Parameters
    ----------
    files : mapping from str to str or bytes
        Content by path inside the archive, text as UTF-8.
    """
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as target:
        for path, content in sorted(files.items()):
            entry = zipfile.ZipInfo(path, _WHEN)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = 3  # Unix, wherever it is packed
            entry.external_attr = 0o644 << 16
            target.writestr(entry, content.encode() if isinstance(content, str) else content)
    return packed.getvalue()
