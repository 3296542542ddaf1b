"""Finding and calling the programs of other packages."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from tmm_gen.errors import UserError

TIMEOUT = 60.0
"""Seconds after which a program is given up."""


def need(program: str, package: str) -> str:
    """Return the path of a program.

    Raises
    ------
    UserError
        If it is not installed, naming the package of Debian and Ubuntu that holds it.
    """
    found = shutil.which(program)
    if found is None:
        raise UserError(f"'{program}' was not found; install it (Debian, Ubuntu: apt-get install {package})")
    return found


def call(command: Sequence[str | Path], folder: Path) -> str:
    """Run a program in a folder and return what it prints.

    Raises
    ------
    UserError
        If it fails or does not end, with what it says.
    """
    said = attempt(command, folder)
    if said.returncode != 0:
        words = " ".join(map(str, command))
        raise UserError(
            f"'{words}' failed ({said.returncode}):\n{(said.stderr or said.stdout).strip()[-2000:]}"
        )
    return said.stdout


def attempt(
    command: Sequence[str | Path], folder: Path, within: float = TIMEOUT
) -> subprocess.CompletedProcess[str]:
    """Run a program in a folder, whether it succeeds or not.

    Parameters
    ----------
    within : float
        How long it may take, s.

    Raises
    ------
    UserError
        If it does not end.
    """
    try:
        return subprocess.run(
            [str(word) for word in command],
            cwd=folder,
            env={**os.environ, "PWD": str(folder)},  # Frama-C believes it
            capture_output=True,
            text=True,
            errors="replace",
            check=False,
            timeout=within,
        )
    except subprocess.TimeoutExpired:
        raise UserError(f"'{' '.join(map(str, command))}' did not end within {within:.0f} s") from None
