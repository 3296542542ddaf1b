"""Packages that only some commands need: an error that says how to have them, instead of a traceback."""

from __future__ import annotations

import re
import shlex
import sys
from importlib import import_module, metadata
from typing import Any

from tmm_gen.errors import UserError

_EXTRAS = {
    "study": ("distributed", "Dask", ("dask", "distributed")),
    "fmu": ("fmpy", "FMPy", ("fmpy",)),
    "mpc": ("daqp", "DAQP", ("cma", "daqp")),
    "jax": ("jax", "JAX", ("jax>=0.10",)),
    "playground": ("ziglang", "Zig", ("ziglang>=0.13",)),
    "cuda": ("nvidia.cuda_nvrtc", "NVRTC", ("nvidia-cuda-nvrtc-cu12>=12.4",)),
}
"""By extra: a module of it, its name in words, and its packages where tmm-gen's own metadata is not at hand."""


def extra(name: str, what: str, module: str | None = None) -> Any:
    """Import a module of an optional extra.

    Parameters
    ----------
    name : str
        Of the extra.
    what : str
        What needs it, in words.
    module : str, optional
        Which module, where the extra has several.

    Returns
    -------
    module
        As imported.

    Raises
    ------
    UserError
        If it is not installed.
    """
    usual, title, _ = _EXTRAS[name]
    try:
        return import_module(module or usual)
    except ImportError:
        wanted = title if module is None else module
        raise UserError(
            f"{what} needs {wanted}, which is not installed: {install(*packages(name))}"
        ) from None


def packages(name: str) -> tuple[str, ...]:
    """Return the requirements of an extra."""
    try:
        listed = metadata.requires("tmm-gen") or []
    except metadata.PackageNotFoundError:
        listed = []
    marked = re.compile(rf"""\s*;\s*extra\s*==\s*['"]{name}['"]\s*$""")
    found = tuple(marked.sub("", line) for line in listed if marked.search(line))
    return found or _EXTRAS[name][2]


def install(*requirements: str) -> str:
    """Return the command that installs packages where this program runs."""
    return shlex.join([sys.executable, "-m", "pip", "install", *requirements])
