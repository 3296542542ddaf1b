"""Compiling emitted C into a shared library, once for each content."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path, PurePosixPath

import platformdirs

from tmm_gen.errors import UserError

FLAGS = ("-O2", "-ffp-contract=off")
"""Optimised, and without fused multiply-add, so that results are the same bits everywhere."""
_ALWAYS = ("-std=c99", "-fPIC", "-shared")


def compile_library(files: Mapping[str, str], cc: str = "gcc", flags: Sequence[str] = FLAGS) -> Path:
    """Compile sources into a shared library, or find it compiled already.

    Parameters
    ----------
    files : mapping from str to str
        Texts by path; those that end in ``.c`` are compiled, all in one folder.
    cc : str
        Compiler that understands gcc's options.
    flags : sequence of str
        Options besides ``-std=c99``.

    Returns
    -------
    Path
        The library, in the user's cache folder, under a name that changes with texts, compiler and flags.

    Raises
    ------
    UserError
        If there is no such compiler, or it refuses the sources.
    """
    version = _version(cc)
    content = repr((sorted(files.items()), version, tuple(flags), _ALWAYS))
    folder = _cache_folder() / hashlib.sha256(content.encode()).hexdigest()[:32]
    library = folder / "kernel.so"
    if not library.exists():
        _compile(files, cc, flags, library)
    return library


def _compile(files: Mapping[str, str], cc: str, flags: Sequence[str], library: Path) -> None:
    library.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=library.parent) as scratch:
        here = Path(scratch)
        names = {PurePosixPath(path).name: text for path, text in files.items()}
        for name, text in names.items():
            (here / name).write_text(text)
        sources = sorted(name for name in names if name.endswith(".c"))
        command = [cc, *_ALWAYS, *flags, *sources, "-o", "kernel.so", "-lm"]
        done = subprocess.run(command, cwd=here, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise UserError(f"'{' '.join(command)}' failed:\n{done.stderr.strip()}")
        (here / "kernel.so").replace(library)


@cache
def _version(cc: str) -> str:
    """Return what identifies a compiler."""
    found = shutil.which(cc)
    if found is None:
        raise UserError(
            f"the C compiler '{cc}' was not found; install one (Debian, Ubuntu: apt-get install gcc), "
            "or name another"
        )
    done = subprocess.run([found, "--version"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise UserError(f"'{cc} --version' failed: is it a C compiler? {done.stderr.strip()}")
    return f"{found}\n{done.stdout}"


@cache
def _cache_folder() -> Path:
    """Return a folder that can be written: the user's cache, or a temporary one."""
    folder = platformdirs.user_cache_path("tmm-gen") / "native"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return Path(tempfile.mkdtemp(prefix="tmm-gen-"))
