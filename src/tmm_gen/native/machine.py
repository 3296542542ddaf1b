"""The instructions of this machine, for code that is compiled to run here and nowhere else."""

from __future__ import annotations

import os
import subprocess
from functools import cache


def machine_flags(cc: str) -> tuple[str, ...]:
    """Return what makes a compiler use all instructions of this machine; nothing if it has no such option."""
    return ("-march=native",) if machine(cc) else ()


@cache
def machine(cc: str) -> str:
    """Return the macros that a compiler defines for this machine's instructions; "" if it cannot ask for them."""
    command = [cc, "-march=native", "-dM", "-E", "-x", "c", os.devnull]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError:  # whoever compiles says what is wrong with it
        return ""
    return done.stdout if done.returncode == 0 else ""


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
