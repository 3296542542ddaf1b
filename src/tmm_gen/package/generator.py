"""What decides, beside the scene, what is read from it and generated: tmm-gen's own files, packages and Python."""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from tmm_gen.resources import templates_dir
from tmm_gen.version import __version__

PACKAGES = ("jinja2", "mpmath", "numpy", "pydantic", "sympy")
"""Those that a scene goes through on its way to the texts of its package."""

_RECORDS = (".dist-info", ".egg-info")
"""What the names end on under which installers keep what they know of a package; its version stands before."""


@cache
def generator_digest() -> str:
    """Return the hash of what decides, with the scene, what is derived: tmm-gen's files and SymPy."""
    digest = hashlib.sha256(f"{__version__}\n{release('sympy')}\n".encode())
    sources = Path(__file__).resolve().parents[1]
    for root, ending in ((sources, ".py"), (templates_dir(), ".jinja")):
        for name in sorted(_files(str(root), ending)):
            with open(name, "rb", buffering=0) as file:  # noqa: PTH123 (a Path for each takes as long as reading)
                content = file.read()
            digest.update(f"{name[len(str(root)) :]}\n{len(content)}\n".encode())
            digest.update(content)
    return digest.hexdigest()


@cache
def installed_digest() -> str:
    """Return the hash of :func:`generator_digest`, of Python's release and of those of all packages on the way."""
    said = [generator_digest(), sys.version, *(f"{name} {release(name)}" for name in PACKAGES)]
    return hashlib.sha256("\n".join(said).encode()).hexdigest()


def release(name: str) -> str:
    """Return what tells the installed version of a package from others, without importing it.

    It is read off the name of what the installer keeps beside it; `importlib.metadata`, which reads that too, takes as
    long to import as everything else that a build with nothing to do imports.
    """
    spec = find_spec(name)
    if spec is not None and spec.origin is not None:
        beside = (each.name.lower() for each in os.scandir(Path(spec.origin).parents[1]))
        kept = [each for each in beside if each.startswith(f"{name}-")]
        if found := [each for each in sorted(kept) if each.endswith(_RECORDS)]:
            return " ".join(found)
    from importlib.metadata import version

    return version(name)


def _files(root: str, ending: str) -> Iterator[str]:
    """Yield the files below a folder whose name ends so."""
    for folder, _, names in os.walk(root):
        yield from (os.path.join(folder, name) for name in names if name.endswith(ending))  # noqa: PTH118
