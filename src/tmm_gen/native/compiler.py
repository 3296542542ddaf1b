"""Compiling emitted C into a shared library, once for each content."""

from __future__ import annotations

import atexit
import hashlib
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path, PurePosixPath

import platformdirs

from tmm_gen.errors import UserError
from tmm_gen.scratch import new_folder, scratch_folder
from tmm_gen.trusted import digest_of, discard, own_content, own_folder

FLAGS = ("-O2", "-ffp-contract=off")
"""Optimised, and without fused multiply-add, so that results are the same bits everywhere."""
_ALWAYS = ("-std=c99", "-fPIC", "-shared", "-x", "c")
"""Told that it is C, a C++ compiler takes it for that too: names would be none that are looked for."""


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
    return _intact(folder) or _compile(files, cc, flags, folder)


def _intact(folder: Path) -> Path | None:
    """Return the library of a folder: a file of this user, whose name is the digest of what it holds.

    What is damaged, or could be somebody else's, is never loaded: a truncated library ends the process.
    """
    try:
        own_folder(folder)
        found = sorted(folder.glob("*.so"))
    except OSError:
        return None
    for library in found:
        content = own_content(library)
        if content is not None and digest_of(content) == library.stem:
            return library
        discard(library)
    return None


def _compile(files: Mapping[str, str], cc: str, flags: Sequence[str], folder: Path) -> Path:
    try:
        own_folder(folder)
        place = folder
    except OSError:  # somebody else's: leave it alone
        place = _own_temporary()
    with scratch_folder(place) as here:
        names = {PurePosixPath(path).name: text for path, text in files.items()}
        for name, text in names.items():
            (here / name).write_text(text)
        sources = sorted(name for name in names if name.endswith(".c"))
        command = [cc, *_ALWAYS, *flags, *sources, "-o", "kernel.so", "-lm"]
        done = subprocess.run(command, cwd=here, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise UserError(f"'{' '.join(command)}' failed: {' '.join(done.stderr.split())}")
        built = here / "kernel.so"
        if not built.is_file():
            raise UserError(
                f"'{' '.join(command)}' left no library: is '{cc}' a C compiler? Name one, such as gcc."
            )
        built.chmod(0o700)
        library = place / f"{digest_of(built.read_bytes())}.so"
        built.replace(library)
    return library


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
        own_folder(folder)
        with scratch_folder(folder):
            return folder
    except OSError:
        return _own_temporary()


@cache
def _own_temporary() -> Path:
    """Return a folder for as long as this process lives."""
    folder = new_folder()
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
