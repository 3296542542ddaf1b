"""Bytes of emitted C as compiled for this machine."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from tmm_gen.errors import UserError
from tmm_gen.scratch import scratch_folder


def code_size(files: Mapping[str, str]) -> int | None:
    """Return bytes of instructions and constants of a kernel, by `size` (its text and data).

    Parameters
    ----------
    files : mapping from str to str
        Texts by path, of one kernel; those that end in ``.c`` are compiled with the options of `native`.

    Returns
    -------
    int or None
        None where there is no program `size` (Debian, Ubuntu: binutils, which gcc needs too).

    Raises
    ------
    UserError
        If the compiler refuses the sources.
    """
    from tmm_gen.native import FLAGS

    size = shutil.which("size")
    if size is None:
        return None
    with scratch_folder() as folder:
        names = {PurePosixPath(path).name: text for path, text in files.items()}
        for name, text in names.items():
            (Path(folder) / name).write_text(text)
        made = sorted(name for name in names if name.endswith(".c"))
        command = ["gcc", "-std=c99", *FLAGS, "-c", *made]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise UserError(f"'{' '.join(command)}' failed:\n{done.stderr.strip()}")
        objects = [f"{name[:-2]}.o" for name in made]
        told = subprocess.run([size, *objects], cwd=folder, capture_output=True, text=True, check=True)
    # Berkeley's columns text, data, bss: one line for each object below a line of headings
    return sum(sum(map(int, line.split()[:2])) for line in told.stdout.splitlines()[1:])
