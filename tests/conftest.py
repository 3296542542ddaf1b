"""What all tests share: the command line, a borrowed environment, repeatable Hypothesis."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

# Figures are drawn into files; a display is neither needed nor there.
os.environ["MPLBACKEND"] = "Agg"
# Small matrices, and one process a core: threads of the linear algebra would only wait for each other, at length.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# `make test` gives the same answer on the same tree; HYPOTHESIS_PROFILE=explore looks for news.
settings.register_profile("repeatable", derandomize=True, deadline=None, database=None)
settings.register_profile("explore", deadline=None, print_blob=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the source tree."""
    return ROOT


@pytest.fixture
def tmm_gen(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run the command line in a process of its own, in an empty folder unless `cwd` is given."""

    def call(
        *words: str | Path, cwd: Path = tmp_path, env: dict[str, str] | None = None
    ) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "tmm_gen", *map(str, words)],
            cwd=cwd,
            env={**os.environ, **(env or {})},
            capture_output=True,
            text=True,
            check=False,
        )

    return call


@pytest.fixture(scope="session")
def borrow_environment() -> Callable[[Path], Path]:
    """Make a virtual environment that finds this one's packages, but not its tmm-gen.

    The function given takes the folder of the new environment and returns its ``bin``. Packages
    are borrowed by a path file, so nothing is downloaded; path files are not read recursively, so
    an editable install of tmm-gen in this environment is not seen from the new one.
    """

    def make(folder: Path) -> Path:
        venv.create(folder, with_pip=False, symlinks=True)
        variables = {"base": str(folder), "platbase": str(folder)}
        packages = Path(sysconfig.get_path("purelib", vars=variables))
        (packages / "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n")
        bin_folder = Path(sysconfig.get_path("scripts", vars=variables))
        # Without it, a `pip` called here would be some other environment's.
        pip = bin_folder / "pip"
        pip.write_text(f'#!/bin/sh\nexec "{bin_folder / "python"}" -m pip "$@"\n')
        pip.chmod(0o755)
        return bin_folder

    return make


@pytest.fixture(scope="session")
def need_tool() -> Callable[[str, str], str]:
    """Return the path of a program; without it, fail where ``CI`` is set and skip elsewhere.

    The function given takes the program, as called on a command line, and the package of Debian and Ubuntu that holds
    it, which the message names.
    """

    def find(program: str, package: str) -> str:
        found = shutil.which(program)
        if found is not None:
            return found
        message = f"{program} not found: apt-get install {package}"
        if os.environ.get("CI"):
            pytest.fail(message)
        pytest.skip(message)

    return find
