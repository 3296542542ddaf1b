"""The test that is generated beside the C, compiled strictly and run."""

from __future__ import annotations

import subprocess
from pathlib import Path, PurePosixPath
from typing import Any

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scratch import scratch_folder

STRICT = (
    *("-std=c99", "-O1", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion"),
    *("-Wfloat-equal", "-Wshadow", "-Werror", "-ffp-contract=off"),
)


def run_host_test(program: Any, scene: Scene, cc: str = "gcc") -> tuple[int, str]:
    """Compile the generated C with its test, warnings being errors, and run it.

    Parameters
    ----------
    program : Program
        Of the scene.
    scene : Scene
        Gives the number type.
    cc : str
        Compiler that understands gcc's options.

    Returns
    -------
    failures : int
        0, or 1 if it does not compile or its test fails.
    said : str
        What compiler or test say, on one line.

    Raises
    ------
    UserError
        If there is no such compiler.
    """
    from tmm_gen.emit.c import emit_c

    with scratch_folder() as here:
        names = []
        for path, text in emit_c(program, scene).items():
            names.append(PurePosixPath(path).name)
            (here / names[-1]).write_text(text, encoding="utf-8")
        sources = sorted(name for name in names if name.endswith(".c"))
        try:
            built = _call([cc, *STRICT, *sources, "-o", "host_test", "-lm"], here)
        except FileNotFoundError:
            raise UserError(
                f"the C compiler '{cc}' was not found; install one "
                "(Debian, Ubuntu: apt-get install gcc libc6-dev)"
            ) from None
        done = _call([str(here / "host_test")], here) if built.returncode == 0 else built
    said = " ".join((done.stdout + done.stderr).split())
    return int(done.returncode != 0), said or "no message"


def _call(command: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
